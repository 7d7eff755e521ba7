// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/check.hpp>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <initializer_list>
#include <string>
#include <string_view>
#include <type_traits>

namespace talus {

namespace detail {

// Texts are put together here, not in templates, where each instance would compile them again, and
// out of the way of what goes right.

/// All parts one after the other.
[[gnu::cold]] inline std::string joined(std::initializer_list<std::string_view> parts) {
    std::string text;
    for (const std::string_view part : parts) text.append(part);
    return text;
}

[[gnu::cold]] inline std::string text_of(double x) {
    char buffer[40];
    const int n = std::snprintf(buffer, sizeof buffer, "%.9g", x);
    return std::string(buffer, static_cast<std::size_t>(n));
}
/// A whole number, all its digits.
[[gnu::cold]] inline std::string digits_of(long long k) {
    char buffer[24];
    const int n = std::snprintf(buffer, sizeof buffer, "%lld", k);
    return std::string(buffer, static_cast<std::size_t>(n));
}

[[noreturn, gnu::cold]] inline void reject(std::string_view item, double value,
                                           std::string_view range) {
    throw input_error(joined({item, " is ", text_of(value), ", but must be ", range}));
}

[[noreturn, gnu::cold]] inline void reject_entry(std::string_view item, std::size_t i,
                                                 double value) {
    reject(joined({item, "[", digits_of(static_cast<long long>(i)), "]"}), value, "finite");
}

/// "before k after".
[[gnu::cold]] inline std::string numbered(std::string_view before, std::size_t k,
                                          std::string_view after = {}) {
    return joined({before, " ", digits_of(static_cast<long long>(k)), after});
}

[[noreturn, gnu::cold]] inline void reject_count(std::string_view items, std::size_t count,
                                                 std::string_view of, std::size_t expected) {
    throw input_error(
        joined({"number of ", items, " is ", digits_of(static_cast<long long>(count)),
                ", but must be that of ", of, ", ", digits_of(static_cast<long long>(expected))}));
}

[[noreturn, gnu::cold]] inline void reject_range(std::string_view item, double value, double low,
                                                 double high) {
    reject(item, value, joined({"in [", text_of(low), ", ", text_of(high), "]"}));
}

/// Throws input_error naming `item` and the first of n numbers that is not finite.
inline void require_finite_numbers(std::string_view item, const double* x, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i)
        if (!std::isfinite(x[i])) reject_entry(item, i, x[i]);
}

}  // namespace detail

/// Throws input_error unless there are as many `items` (say "impulses") as `of` ("contacts").
inline void require_count(std::string_view items, std::size_t count, std::string_view of,
                          std::size_t expected) {
    if (count != expected) detail::reject_count(items, count, of, expected);
}

/// Returns `value`; throws input_error naming `item` unless it is finite and positive.
inline double require_positive(std::string_view item, double value) {
    if (!(std::isfinite(value) && value > 0.0)) detail::reject(item, value, "finite and positive");
    return value;
}

/// Returns `value`; throws input_error naming `item` unless it is finite and not negative.
inline double require_non_negative(std::string_view item, double value) {
    if (!(std::isfinite(value) && value >= 0.0))
        detail::reject(item, value, "finite and not negative");
    return value;
}
/// The same of a part (say ".mu") of an item. The two are put together only to be told: nothing is
/// allocated for what is right.
inline double require_non_negative(std::string_view item, std::string_view part, double value) {
    if (!(std::isfinite(value) && value >= 0.0))
        require_non_negative(detail::joined({item, part}), value);
    return value;
}

/// Returns `value`; throws input_error naming `item` unless it lies in [low, high].
inline double require_in(std::string_view item, double value, double low, double high) {
    if (!(value >= low && value <= high)) detail::reject_range(item, value, low, high);
    return value;
}
/// The same of a part of an item, as of require_non_negative.
inline double require_in(std::string_view item, std::string_view part, double value, double low,
                         double high) {
    if (!(value >= low && value <= high))
        require_in(detail::joined({item, part}), value, low, high);
    return value;
}

/// Throws input_error naming `item` unless a length is 1 to rounding.
inline void require_unit(std::string_view item, double length) {
    constexpr double rounding = 1e-9;
    if (!(std::abs(length - 1.0) <= rounding))
        detail::reject(detail::joined({"length of the ", item}), length, "1");
}

/// Returns `value` (a vector or a matrix); throws input_error naming `item` and the first entry
/// that is not finite.
template <class Array>
const Array& require_finite(std::string_view item, const Array& value) {
    using Number = std::remove_cvref_t<decltype(*value.data())>;
    if constexpr (std::is_same_v<Number, double>)
        detail::require_finite_numbers(item, value.data(), static_cast<std::size_t>(value.size()));
    else
        for (decltype(value.size()) i = 0; i < value.size(); ++i)
            if (!std::isfinite(value.data()[i]))
                detail::reject_entry(item, static_cast<std::size_t>(i), value.data()[i]);
    return value;
}

}  // namespace talus
