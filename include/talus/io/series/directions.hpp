// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/types.hpp>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace talus::detail {

/// Directions all around, and the faces of what has one point for each of them, counter-clockwise
/// seen from outside: in the plane sides. Of `count` in the plane, in space along as many
/// meridians, an even number.
template <int Dim>
struct Directions {
    std::vector<Vector<Dim>> unit;
    std::vector<std::vector<std::size_t>> faces;

    explicit Directions(std::size_t count) { look_around(*this, count); }
};

inline void look_around(Directions<2>& around, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        const double angle =
            2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
        around.unit.emplace_back(std::cos(angle), std::sin(angle));
        around.faces.push_back({i, (i + 1) % count});
    }
}

inline void look_around(Directions<3>& around, std::size_t count) {
    const std::size_t rings = count / 2 - 1;  // between the poles, which come last
    const std::size_t south = rings * count, north = south + 1;
    for (std::size_t k = 0; k < rings; ++k)
        for (std::size_t i = 0; i < count; ++i) {
            const double polar = std::numbers::pi * static_cast<double>(k + 1) /
                                 static_cast<double>(rings + 1),
                         angle = 2.0 * std::numbers::pi * static_cast<double>(i) /
                                 static_cast<double>(count);
            around.unit.emplace_back(std::sin(polar) * std::cos(angle),
                                     std::sin(polar) * std::sin(angle), -std::cos(polar));
            const std::size_t here = k * count + i, next = k * count + (i + 1) % count;
            if (k == 0) around.faces.push_back({south, next, here});
            if (k + 1 < rings)
                around.faces.push_back({here, next, next + count, here + count});
            else
                around.faces.push_back({here, next, north});
        }
    around.unit.emplace_back(0.0, 0.0, -1.0);
    around.unit.emplace_back(0.0, 0.0, 1.0);
}

}  // namespace talus::detail
