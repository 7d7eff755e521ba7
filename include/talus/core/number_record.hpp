// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace talus {

/// What it takes to make something again, bit for bit: real numbers and integers, each in the order
/// in which they were written. What checkpoints are made of (io/checkpoint).
struct NumberRecord {
    std::vector<double> reals;
    std::vector<std::int64_t> integers;

    [[gnu::noinline]] void real(double x) { reals.push_back(x); }
    /// Of any integer type; numbers from 2^63 come back as such.
    void integer(std::integral auto k) { integers.push_back(static_cast<std::int64_t>(k)); }
    /// All entries of a vector or a matrix.
    template <class Array>
    void array(const Array& x) {
        const auto* entries = x.data();
        for (decltype(x.size()) k = 0; k < x.size(); ++k) real(entries[k]);
    }
    void text(std::string_view words) {
        integer(words.size());
        for (const char c : words) integer(static_cast<unsigned char>(c));
    }

    friend bool operator==(const NumberRecord&, const NumberRecord&) = default;
};

/// Reads a record in the order in which it was written. Throws input_error where it ends too early,
/// and for integers out of range.
class NumberRecordReader {
  public:
    explicit NumberRecordReader(const NumberRecord& record) : record_(&record) {}

    bool has_real() const { return real_ < record_->reals.size(); }  ///< not read yet
    double real() {
        require_more("real numbers", 1, record_->reals.size() - real_);
        return record_->reals[real_++];
    }
    /// An integer in [low, high].
    template <std::integral Integer = std::int64_t>
    Integer integer(std::int64_t low = std::numeric_limits<std::int64_t>::min(),
                    std::int64_t high = std::numeric_limits<std::int64_t>::max()) {
        require_more("integers", 1, record_->integers.size() - integer_);
        const std::int64_t k = record_->integers[integer_];
        if (k < low || k > high)
            throw input_error(detail::numbered("integer", integer_, " of the record is ") +
                              std::to_string(k) + ", but must be in [" + std::to_string(low) +
                              ", " + std::to_string(high) + "]");
        ++integer_;
        return static_cast<Integer>(k);
    }
    /// How many of something follow, of which each takes `reals` and `integers` or more: not more
    /// than are there.
    std::size_t count(std::size_t reals, std::size_t integers) {
        const auto n = integer<std::size_t>(0);
        if (reals > 0 && n > (record_->reals.size() - real_) / reals)
            require_more("real numbers", n * reals, record_->reals.size() - real_);
        if (integers > 0 && n > (record_->integers.size() - integer_) / integers)
            require_more("integers", n * integers, record_->integers.size() - integer_);
        return n;
    }
    /// A vector or a matrix.
    template <class Array>
    Array array() {
        Array x;
        for (decltype(x.size()) i = 0; i < x.size(); ++i) x.data()[i] = real();
        return x;
    }
    std::string text() {
        std::string words(count(0, 1), '\0');
        for (char& c : words) c = static_cast<char>(integer(0, 255));
        return words;
    }

    /// Throws input_error unless everything was read.
    void require_end() const {
        const std::size_t left =
            record_->reals.size() - real_ + (record_->integers.size() - integer_);
        if (left > 0)
            throw input_error(detail::numbered("record has", left,
                                               " numbers more than were read, but must end there"));
    }

  private:
    static void require_more(std::string_view kind, std::size_t wanted, std::size_t left) {
        if (left < wanted)
            throw input_error("record has " + std::to_string(left) + " more " + std::string(kind) +
                              ", but must have " + std::to_string(wanted));
    }

    const NumberRecord* record_;
    std::size_t real_ = 0, integer_ = 0;
};

/// What can be written to a record and made from it again, bit for bit. What a type of one's own
/// needs to be part of a checkpoint.
template <class T>
concept Recordable = requires(const T& x, NumberRecord& out, NumberRecordReader& in) {
    x.write(out);
    { T::read(in) } -> std::same_as<T>;  // throws input_error where the record is not of a T
};

/// The record of x, which must at least have `write`.
template <class T>
requires requires(const T& x, NumberRecord& out) { x.write(out); }
NumberRecord record_of(const T& x) {
    NumberRecord record;
    x.write(record);
    return record;
}
/// What a record is of. Throws input_error if it is not that of a T.
template <Recordable T>
T from_record(const NumberRecord& record) {
    NumberRecordReader in(record);
    T x = T::read(in);
    in.require_end();
    return x;
}

}  // namespace talus
