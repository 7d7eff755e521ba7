// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/check.hpp>
#include <talus/core/input.hpp>
#include <talus/core/printable.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <vector>

namespace talus {

namespace detail {

/// A word of a file as complaints show it: of a very long one the beginning.
inline std::string shown(std::string_view word, std::size_t longest = 80) {
    return printable(word, longest);
}

/// Opens a file that must be `kind`. Looks before: opening a pipe would wait for who writes it.
inline std::ifstream open_file(const std::filesystem::path& path, std::string_view kind) {
    std::error_code error;
    std::ifstream file;
    if (std::filesystem::is_regular_file(path, error)) file.open(path, std::ios::binary);
    if (!file.is_open())
        throw input_error(shown(path.string(), 4096) + ": the file cannot be read, but must be " +
                          std::string(kind));
    return file;
}

/// The number that a word of a file is, as a whole: what std::from_chars reads, which no locale
/// changes, also after a plus sign. Numbers too near to zero to be told from it are zero.
template <class Number>
std::optional<Number> parsed_number(std::string_view text) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (end != text.data() + text.size()) return std::nullopt;
    if (error == std::errc{}) return value;
    const bool tiny =
        std::is_floating_point_v<Number> &&
        (text.find("e-") != std::string_view::npos || text.find("E-") != std::string_view::npos);
    if (error == std::errc::result_out_of_range && tiny) return Number{};
    return std::nullopt;
}

}  // namespace detail

/// Reads a text of words line by line and knows where it is: every complaint is one sentence naming
/// the file, the line, the item, its value and the accepted range. Lines end as on any system. A
/// byte order mark of UTF-8 is passed over, others are refused.
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
    /// Forgets what follows a # in the line.
    void drop_comment() {
        for (std::size_t k = used_; k < words_.size(); ++k) {
            const std::size_t mark = words_[k].find('#');
            if (mark == std::string::npos) continue;
            words_[k].resize(mark);
            words_.resize(mark > 0 ? k + 1 : k);
        }
    }
    /// Appends the next line as long as this one, without its comment, ends with a backslash.
    void join_continued_lines() {
        drop_comment();
        while (!words_.empty() && words_.back().ends_with('\\')) {
            words_.back().pop_back();
            if (words_.back().empty()) words_.pop_back();
            ++line_;
            std::vector<std::string> words = std::move(words_);
            const std::size_t used = used_;
            read();
            words.insert(words.end(), words_.begin(), words_.end());
            words_ = std::move(words);
            used_ = used;
            drop_comment();
        }
    }

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
        const std::optional<Number> value = detail::parsed_number<Number>(text);
        // A NaN fails the comparison, and so is refused like anything else that is out of range.
        if (!value || !(*value >= low && *value <= high))
            fail(item, "is '" + detail::shown(text) + "', but must be " + std::string(kind) +
                           " in [" + detail::text_of(static_cast<double>(low)) + ", " +
                           detail::text_of(static_cast<double>(high)) + "]");
        return *value;
    }

    /// The next line up to \n, \r or both; false if there is none.
    bool get_line(std::string& line) {
        line.clear();
        std::streambuf& text = *text_.rdbuf();
        int c = text.sbumpc();
        if (c == std::char_traits<char>::eof()) return false;
        for (; c != std::char_traits<char>::eof() && c != '\n' && c != '\r'; c = text.sbumpc())
            line.push_back(static_cast<char>(c));
        if (c == '\r' && text.sgetc() == '\n') text.sbumpc();
        return true;
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
        if (!get_line(line)) return false;
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
