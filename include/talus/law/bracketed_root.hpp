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

/// Two samples whose values differ in sign.
struct Bracket {
    Sample a, b;

    const Sample& negative() const { return a.f < b.f ? a : b; }
    const Sample& positive() const { return a.f < b.f ? b : a; }
    const Sample& best() const { return std::abs(a.f) < std::abs(b.f) ? a : b; }
};

/// Closes a bracket around a sign change of a function, to an ulp or two of x or until a value is
/// 0, by inverse quadratic interpolation [Chandrupatla1997]. Where the function is continuous
/// either end is a root; the values tell. The first point is that of the secant, at once the answer
/// for a linear function.
template <class Function>
Bracket bracketed_root(Function&& function, Sample a, Sample b) {
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    constexpr int enough = 200;  // bisection of ten decades would need some 90
    double t = a.f / (a.f - b.f);
    for (int k = 0; k < enough; ++k) {
        Sample x{a.x + t * (b.x - a.x), 0.0};
        x.f = function(x.x);
        const bool same_side = (x.f > 0.0) == (a.f > 0.0);
        const Sample c = same_side ? a : b;
        if (!same_side) b = a;
        a = x;
        const Sample best = Bracket{a, b}.best();
        const double least = 2.0 * epsilon * std::abs(best.x) / std::abs(b.x - a.x);
        if (best.f == 0.0 || !(least < 0.5)) break;
        const double xi = (a.x - b.x) / (c.x - b.x), phi = (a.f - b.f) / (c.f - b.f);
        t = 0.5;
        if (phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi)
            t = a.f / (b.f - a.f) * (c.f / (b.f - c.f)) +
                (c.x - a.x) / (b.x - a.x) * (a.f / (c.f - a.f)) * (b.f / (c.f - b.f));
        t = std::clamp(t, least, 1.0 - least);
    }
    return {a, b};
}

}  // namespace talus
