// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus {

/// An argument and the value of a function there.
struct Sample {
    double x = 0.0;
    double f = 0.0;
};

/// Zero of a continuous function between two samples whose values differ in sign, to an ulp or two
/// of x, by inverse quadratic interpolation kept in the bracket [Chandrupatla1997]. The first point
/// is that of the secant, at once the answer for a linear function.
template <class Function>
double bracketed_root(Function&& function, Sample a, Sample b) {
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    constexpr int enough = 200;  // bisection of ten decades would need some 90
    double t = a.f / (a.f - b.f);
    for (int k = 0; k < enough; ++k) {
        Sample x{a.x + t * (b.x - a.x), 0.0};
        x.f = function(x.x);
        Sample c = b;
        if ((x.f > 0.0) == (a.f > 0.0)) {
            c = a;
        } else {
            c = b;
            b = a;
        }
        a = x;
        const Sample& best = std::abs(a.f) < std::abs(b.f) ? a : b;
        const double least = 2.0 * epsilon * std::abs(best.x) / std::abs(b.x - a.x);
        if (best.f == 0.0 || !(least < 0.5)) return best.x;
        const double xi = (a.x - b.x) / (c.x - b.x), phi = (a.f - b.f) / (c.f - b.f);
        t = 0.5;
        if (phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi)
            t = a.f / (b.f - a.f) * (c.f / (b.f - c.f)) +
                (c.x - a.x) / (b.x - a.x) * (a.f / (c.f - a.f)) * (b.f / (c.f - b.f));
        t = std::clamp(t, least, 1.0 - least);
    }
    return a.x;
}

}  // namespace talus
