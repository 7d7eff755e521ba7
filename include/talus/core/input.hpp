// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/check.hpp>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>

namespace talus {

namespace detail {

inline std::string text_of(double x) {
    char buffer[40];
    const int n = std::snprintf(buffer, sizeof buffer, "%.9g", x);
    return std::string(buffer, static_cast<std::size_t>(n));
}

[[noreturn]] inline void reject(std::string_view item, double value, std::string_view range) {
    throw input_error(std::string(item) + " is " + text_of(value) + ", but must be " +
                      std::string(range));
}

[[noreturn]] inline void reject_entry(std::string_view item, std::size_t i, double value) {
    reject(std::string(item) + "[" + std::to_string(i) + "]", value, "finite");
}

/// "before k after". Texts are put together here, not in templates, where each instance would
/// compile them again.
inline std::string numbered(std::string_view before, std::size_t k, std::string_view after = {}) {
    return std::string(before) + " " + std::to_string(k) + std::string(after);
}

}  // namespace detail

/// Throws input_error unless there are as many `items` (say "impulses") as `of` ("contacts").
inline void require_count(std::string_view items, std::size_t count, std::string_view of,
                          std::size_t expected) {
    if (count != expected)
        throw input_error("number of " + std::string(items) + " is " + std::to_string(count) +
                          ", but must be that of " + std::string(of) + ", " +
                          std::to_string(expected));
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
        require_non_negative(std::string(item).append(part), value);
    return value;
}

/// Returns `value`; throws input_error naming `item` unless it lies in [low, high].
inline double require_in(std::string_view item, double value, double low, double high) {
    if (!(value >= low && value <= high))
        detail::reject(item, value,
                       "in [" + detail::text_of(low) + ", " + detail::text_of(high) + "]");
    return value;
}
/// The same of a part of an item, as of require_non_negative.
inline double require_in(std::string_view item, std::string_view part, double value, double low,
                         double high) {
    if (!(value >= low && value <= high))
        require_in(std::string(item).append(part), value, low, high);
    return value;
}

/// Throws input_error naming `item` unless a length is 1 to rounding.
inline void require_unit(std::string_view item, double length) {
    constexpr double rounding = 1e-9;
    if (!(std::abs(length - 1.0) <= rounding))
        detail::reject("length of the " + std::string(item), length, "1");
}

/// Returns `value` (a vector or a matrix); throws input_error naming `item` and the first entry
/// that is not finite.
template <class Array>
const Array& require_finite(std::string_view item, const Array& value) {
    for (decltype(value.size()) i = 0; i < value.size(); ++i)
        if (!std::isfinite(value.data()[i]))
            detail::reject_entry(item, static_cast<std::size_t>(i), value.data()[i]);
    return value;
}

}  // namespace talus
