// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/types.hpp>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace talus::detail {

/// Directions all around, and the faces of what has one point for each of them, counter-clockwise
/// seen from outside: in the plane sides.
template <int Dim>
struct Directions;

template <>
struct Directions<2> {
    std::vector<Vector<2>> unit;
    std::vector<std::vector<std::size_t>> faces;

    explicit Directions(std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            const double angle =
                2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
            unit.emplace_back(std::cos(angle), std::sin(angle));
            faces.push_back({i, (i + 1) % count});
        }
    }
};

/// Along parallels and meridians, of which there are `count`, even.
template <>
struct Directions<3> {
    std::vector<Vector<3>> unit;
    std::vector<std::vector<std::size_t>> faces;

    explicit Directions(std::size_t count) {
        const std::size_t rings = count / 2 - 1;  // between the poles, which come last
        const std::size_t south = rings * count, north = south + 1;
        for (std::size_t k = 0; k < rings; ++k)
            for (std::size_t i = 0; i < count; ++i) {
                const double polar = std::numbers::pi * static_cast<double>(k + 1) /
                                     static_cast<double>(rings + 1),
                             angle = 2.0 * std::numbers::pi * static_cast<double>(i) /
                                     static_cast<double>(count);
                unit.emplace_back(std::sin(polar) * std::cos(angle),
                                  std::sin(polar) * std::sin(angle), -std::cos(polar));
                const std::size_t here = k * count + i, next = k * count + (i + 1) % count;
                if (k == 0) faces.push_back({south, next, here});
                if (k + 1 < rings)
                    faces.push_back({here, next, next + count, here + count});
                else
                    faces.push_back({here, next, north});
            }
        unit.emplace_back(0.0, 0.0, -1.0);
        unit.emplace_back(0.0, 0.0, 1.0);
    }
};

}  // namespace talus::detail
