// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/types.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace talus {
namespace detail {

/// A number as decimal digits, its first at 10^exponent, trailing zeros left out. Fifteen digits
/// are looked at, so that 3 * 0.1 has one although its last bit is off.
struct DecimalDigits {
    int count;
    int exponent;
    int last() const { return exponent - count + 1; }  ///< exponent of the last digit
};

inline DecimalDigits decimal_digits(double x) {
    constexpr int looked_at = 15;
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, std::abs(x),
                                   std::chars_format::scientific, looked_at - 1)
                         .ptr;
    const char* const e = std::find(text, end, 'e');
    const char* last = e;
    while (last - 1 > text && (last[-1] == '0' || last[-1] == '.')) --last;
    DecimalDigits d{static_cast<int>(last - text) - (last - text > 1 ? 1 : 0), 0};
    std::from_chars(e + (e[1] == '+' ? 2 : 1), end, d.exponent);
    return d;
}

}  // namespace detail

/// How far coordinates may be from what was meant [m]: half the unit of the coarsest grid that all
/// of them lie on, read off their digits. Three kinds of grid are recognised: a fixed number of
/// decimals; a fixed number of significant digits, whose unit is that of the largest numbers; and
/// single precision, also written out as decimals. Numbers without a common end have some 1e-16 of
/// the largest. Few digits may be exact: the answer is an upper bound. Where digits can be counted
/// in two ways, one giving more than `believed` [m], it is the other. O(points log points).
template <int Dim>
double coordinate_rounding(std::span<const Vector<Dim>> points,
                           double believed = std::numeric_limits<double>::infinity()) {
    std::vector<double> numbers;
    for (const auto& p : points)
        for (const double x : p)
            if (x != 0.0) numbers.push_back(std::abs(x));
    if (numbers.empty()) return 0.0;
    std::ranges::sort(numbers);
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    std::vector<detail::DecimalDigits> digits;
    int most = 0, decimals = std::numeric_limits<int>::max();
    for (const double x : numbers) {
        const auto d = digits.emplace_back(detail::decimal_digits(x));
        most = std::max(most, d.count);
        decimals = std::min(decimals, d.last());
    }
    // Small numbers that do not use all the digits of the longest: it is decimals that are counted.
    const auto shorter = std::ranges::count_if(
        digits, [&](const auto& d) { return d.exponent - most + 1 < decimals; });
    int last = decimals;
    if (shorter < 3)
        // Numbers of few digits, such as 1, say nothing.
        for (const auto& d : digits)
            if (d.count + 1 >= most) last = std::max(last, d.exponent - most + 1);
    if (0.5 * std::pow(10.0, last) > believed) last = decimals;
    double unit = std::pow(10.0, last);
    bool single = true;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const double nearest = static_cast<double>(static_cast<float>(numbers[i]));
        // Half a unit and the last bits of a number written with `most` digits.
        const double written = most < 15 ? 0.51 * std::pow(10.0, digits[i].exponent - most + 1) : 0;
        single = single && std::abs(numbers[i] - nearest) <= written;
    }
    if (single) unit = std::max(unit, std::ldexp(1.0, std::ilogb(numbers.back()) - 23));
    return 0.5 * unit;
}

}  // namespace talus
