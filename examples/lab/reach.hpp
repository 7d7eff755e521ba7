// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/measure/rings.hpp>
#include <talus/stepping/system.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
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

/// How the surface of grains rises along the first axis, as far as `far` from the origin: a line
/// through the highest centres of bins of a width [m]. [rad]
template <int Dim>
double surface_angle(const talus::System<Dim>& system, double far, double width) {
    const auto bins = static_cast<std::size_t>(2.0 * far / width);
    std::vector<double> x(bins), top(bins, std::numeric_limits<double>::quiet_NaN());
    for (std::size_t k = 0; k < bins; ++k) x[k] = (static_cast<double>(k) + 0.5) * width - far;
    for (std::size_t i = 0; i < system.bodies.count(); ++i) {
        const auto& at = system.bodies.position[i];
        const double k = std::floor((at[0] + far) / width);
        if (system.bodies.is_obstacle(i) || !(k >= 0.0 && k < static_cast<double>(bins))) continue;
        double& height = top[static_cast<std::size_t>(k)];
        if (!(height >= at[Dim - 1])) height = at[Dim - 1];
    }
    return -talus::fit_line(x, top).angle();
}

}  // namespace lab
