// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/check.hpp>
#include <talus/core/input.hpp>
#include <talus/core/printable.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

namespace talus {

namespace detail {

/// A word of a file as complaints show it: of a very long one the beginning.
inline std::string shown(std::string_view word, std::size_t longest = 80) {
    return printable(word, longest);
}

}  // namespace detail

/// Reads a text of words line by line and knows where it is: every complaint is one sentence naming
/// the file, the line, the item, its value and the accepted range. A byte order mark of UTF-8 is
/// passed over, others are refused.
class LineReader {
  public:
    LineReader(std::istream& text, const std::string& file)
        : text_(text), file_(detail::shown(file, 4096)) {}

    /// Goes to the next line, which must exist; `what` says what it should hold.
    void next_line(std::string_view what) {
        ++line_;
        if (!read()) fail("the file", "ends, but must hold " + std::string(what) + " here");
    }

    /// Goes to the next line that has words; returns whether there is one.
    bool next_words() {
        do ++line_;
        while (read() && words_.empty());
        return !words_.empty();
    }
    /// Words of the line that are not yet used.
    std::size_t words_left() const { return words_.size() - used_; }
    /// Whether the next word begins with #.
    bool starts_comment() const { return words_left() > 0 && words_[used_].starts_with('#'); }

    /// Demands that nothing but white space follows.
    void expect_end_of_text() {
        for (++line_; read(); ++line_)
            if (!words_.empty())
                fail("the text after the last grain",
                     "is '" + detail::shown(words_[0]) + "', but must be empty");
    }

    /// Demands that the line is used up.
    void expect_end_of_line() const {
        if (used_ < words_.size())
            fail("column " + std::to_string(used_ + 1), "is '" + detail::shown(words_[used_]) +
                                                            "', but the line must end after " +
                                                            std::to_string(used_) + " columns");
    }

    /// The next word of the line.
    const std::string& word(std::string_view item) {
        if (used_ == words_.size())
            fail(item,
                 "is missing: the line has only " + std::to_string(words_.size()) + " columns");
        return words_[used_++];
    }

    /// Demands the word `key`.
    void keyword(std::string_view key) {
        const std::string& found = word("the key '" + std::string(key) + "'");
        if (found != key)
            fail("a key",
                 "is '" + detail::shown(found) + "', but must be '" + std::string(key) + "'");
    }

    /// A finite number in [low, high].
    double number(std::string_view item, double low, double high) {
        return parsed<double>(item, low, high, "a number");
    }

    /// An integer in [low, high].
    long integer(std::string_view item, long low, long high) {
        return parsed<long>(item, low, high, "an integer");
    }

    [[noreturn]] void fail(std::string_view item, std::string_view complaint) const {
        fail_at(line_, item, complaint);
    }
    [[noreturn]] void fail_at(std::size_t line, std::string_view item,
                              std::string_view complaint) const {
        throw input_error(file_ + ", line " + std::to_string(line) + ": " + std::string(item) +
                          " " + std::string(complaint));
    }

    std::size_t line() const { return line_; }

  private:
    template <class Number>
    Number parsed(std::string_view item, Number low, Number high, std::string_view kind) {
        const std::string& text = word(item);
        Number value{};
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool whole = error == std::errc{} && end == text.data() + text.size();
        // A NaN fails the comparison, and so is refused like anything else that is out of range.
        if (!whole || !(value >= low && value <= high))
            fail(item, "is '" + detail::shown(text) + "', but must be " + std::string(kind) +
                           " in [" + detail::text_of(static_cast<double>(low)) + ", " +
                           detail::text_of(static_cast<double>(high)) + "]");
        return value;
    }

    void pass_byte_order_mark(std::string& line) const {
        if (line.starts_with("\xef\xbb\xbf")) line.erase(0, 3);
        for (const std::string_view mark : {"\xff\xfe", "\xfe\xff"})
            if (line.starts_with(mark))
                fail("the byte order mark", "is '" + detail::shown(mark) +
                                                "', that of UTF-16, but the text must be UTF-8");
    }

    bool read() {
        std::string line;
        words_.clear();
        used_ = 0;
        if (!std::getline(text_, line)) return false;
        if (line_ == 1) pass_byte_order_mark(line);
        constexpr std::string_view space = " \t\r\v\f";
        for (std::size_t at = line.find_first_not_of(space); at != std::string::npos;) {
            const std::size_t end = std::min(line.find_first_of(space, at), line.size());
            words_.push_back(line.substr(at, end - at));
            at = line.find_first_not_of(space, end);
        }
        return true;
    }

    std::istream& text_;
    std::string file_;
    std::size_t line_ = 0;
    std::vector<std::string> words_;
    std::size_t used_ = 0;
};

}  // namespace talus
