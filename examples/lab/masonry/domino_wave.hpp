// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>

namespace lab {

/// Speed, over sqrt(g h), of the steady wave in an endless row of upright plates of height h that
/// are `thickness` h thick and stand `spacing` h apart: each turns about its lower edge in front,
/// leans on the next without friction, and hits without bouncing (J. M. J. van Leeuwen, The domino
/// effect, Am. J. Phys. 78 (2010) 721, for mu = 0). The angle of the foremost plate decides those
/// of all behind it:
///
///     sin(b - a) = (s + d) cos a - d        a: of a plate, b: of the one behind, s, d: over h.
///
/// Energy is kept while the foremost falls; where it hits, momentum along the motion of all is.
inline double domino_wave(double spacing, double thickness) {
    const double s = spacing, d = thickness, hit = std::asin(s);
    const double inertia = (1.0 + d * d) / 3.0;  // about the edge, over m h^2
    // Sum of the squares of all angular velocities, over that of the foremost.
    const auto together = [&](double foremost) {
        double sum = 0.0, rate = 1.0, a = foremost;
        for (int k = 0; k < 300 && std::abs(rate) > 1e-12; ++k) {
            sum += rate * rate;
            const double lean = std::asin((s + d) * std::cos(a) - d);  // b - a
            rate *= 1.0 - (s + d) * std::sin(a) / std::cos(lean);
            a += lean;
        }
        return sum;
    };
    const auto height = [&](double a) { return 0.5 * (std::cos(a) + d * std::sin(a)); };
    const auto potential = [&](double foremost) {  // of so many that the last ones lie still
        double sum = 0.0, a = foremost;
        for (int k = 0; k < 300; ++k) {
            sum += height(a) - height(std::acos(d / (s + d)));
            a += std::asin((s + d) * std::cos(a) - d);
        }
        return sum;
    };
    const double first = together(0.0), last = together(hit), top = potential(0.0);
    // inertia / 2 (w^2 together) + potential is kept, in units of m, g, h; at the hit
    // w' first = w last, as first = 1 + last and the plate that is hit begins as fast as its
    // pusher.
    const double slowed = last / first;
    const double released = 2.0 / inertia * (top - potential(hit));
    const double square = released / (last - slowed * slowed * first);  // of w just before a hit
    const double begin = slowed * slowed * square * first;
    // The time between two hits, by the midpoint rule.
    double time = 0.0;
    constexpr int parts = 400;
    for (int k = 0; k < parts; ++k) {
        const double a = hit * (k + 0.5) / parts;
        const double w2 = (begin + 2.0 / inertia * (top - potential(a))) / together(a);
        time += hit / parts / std::sqrt(w2);
    }
    return (s + d) / time;
}

}  // namespace lab
