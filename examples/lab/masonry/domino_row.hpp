// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/geometry/box.hpp>
#include <talus/measure/rings.hpp>
#include <talus/stepping/system.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "upright.hpp"

namespace lab {

/// A row of upright dominoes on the floor, along axis 0.
struct DominoRow {
    double height, thickness, spacing;  ///< [m]
    double begin;                       ///< where it does [m]
    std::size_t count, first = 0;       ///< which bodies it is

    double pitch() const { return spacing + thickness; }
    std::size_t last() const { return first + count - 1; }
    /// Adds it; the first domino turns about its lower edge in front, with that spin [rad/s].
    template <int Dim>
    void add_to(talus::System<Dim>& system, double spin, talus::MaterialIndex material) {
        first = system.bodies.count();
        const double h = height, d = thickness;
        const talus::Box<Dim> domino(upright_half<Dim>(d, h, 0.5 * h));
        for (std::size_t k = 0; k < count; ++k) {
            talus::Twist<Dim> twist;
            if (k == 0)
                twist = {upright_point<Dim>(-0.5 * h * spin, -0.5 * d * spin),
                         upright_turn<Dim>(spin)};
            const double x = begin + static_cast<double>(k) * pitch();
            system.add(domino, 600.0, upright_pose<Dim>(x, 0.5 * h), twist, material);
        }
    }
    /// Speed of the wave over the second half, where it has become steady, from when each body was
    /// hit [s]; NaN if the last one was not. [m/s]
    double speed(const std::vector<double>& times) const {
        if (!std::isfinite(times[last()])) return std::numeric_limits<double>::quiet_NaN();
        std::vector<double> place, time;
        for (std::size_t k = (count - 1) / 2; k + 2 < count; ++k) {
            place.push_back(static_cast<double>(k) * pitch());
            time.push_back(times[first + k]);
        }
        return 1.0 / talus::fit_line(place, time).slope;
    }
};

}  // namespace lab
