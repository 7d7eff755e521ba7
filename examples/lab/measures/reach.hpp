// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/stepping/system.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace lab {

/// How far a heap about the last axis reaches, in the mean over 2 or 12 directions, at least 0.9 of
/// `least` [m]: as far as grains follow each other by less than two diameters; what ran ahead is
/// not of it. [m]
template <int Dim>
double reach(const talus::System<Dim>& system, double least, double diameter) {
    constexpr std::size_t sectors = Dim == 2 ? 2 : 12;
    std::array<std::vector<double>, sectors> far;
    for (std::size_t i = 0; i < system.bodies.count(); ++i) {
        if (system.bodies.is_obstacle(i)) continue;
        talus::Vector<Dim> x = system.bodies.position[i];
        x[Dim - 1] = 0.0;
        const double turn = std::atan2(x[Dim - 2], x[0]) / (2.0 * std::numbers::pi) + 0.5;
        const double sector = Dim == 2 ? (x[0] < 0.0 ? 0.0 : 1.0) : turn * sectors;
        far[std::min(static_cast<std::size_t>(sector), sectors - 1)].push_back(x.norm());
    }
    double sum = 0.0;
    for (auto& distances : far) {
        double at = 0.9 * least;
        std::sort(distances.begin(), distances.end());
        for (const double d : distances)
            if (d > at && d < at + 2.0 * diameter) at = d;
        sum += at + 0.5 * diameter;
    }
    return sum / sectors;
}

/// How far the mass centre of the grains is turned out of the vertical below the origin, towards
/// the first axis: what the surface leans by in a round drum about the origin. (A line through the
/// highest grains jumps as they pass from bin to bin, with no grain moving against another.) [rad]
template <int Dim>
double lean(const talus::System<Dim>& system) {
    talus::Vector<Dim> centre = talus::Vector<Dim>::Zero();
    for (std::size_t i = 0; i < system.bodies.count(); ++i)
        if (!system.bodies.is_obstacle(i))
            centre += system.bodies.mass(i) * system.bodies.position[i];
    return std::atan2(centre[0], -centre[Dim - 1]);
}

}  // namespace lab
