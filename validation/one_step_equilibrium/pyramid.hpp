// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "statics.hpp"

namespace validation {

/// n touching balls of unit weight on the floor in a ring (two discs in the plane), one more on top
/// of them. Body 0 is the floor, n + 1 the one on top.
template <int Dim>
World<Dim> pyramid(Trial<Dim>& trial, int n, double mu_grain, double mu_floor, double h) {
    constexpr talus::MaterialIndex grain = 0, floor = 1;
    talus::MaterialTable<Law<Dim>> laws(2, law<Dim>(0.0));
    laws.set(grain, grain, law<Dim>(mu_grain));
    laws.set(grain, floor, law<Dim>(mu_floor));
    auto world = trial.world(statics_params<Dim>(h), laws);
    world.add_floor(floor);
    const double r = 0.5;
    const double ring = r / std::sin(pi / n);  // of the centres
    const auto add = [&](const V<Dim>& centre) {
        world.add(talus::Ball<Dim>{r}, round_inertia<Dim>(1.0 / g, r), {centre, {}}, {}, grain);
    };
    for (int k = 0; k < n; ++k) {
        V<Dim> centre = r * up<Dim>();
        centre[0] = ring * std::cos(2 * pi * k / n);
        if constexpr (Dim == 3) centre[1] = ring * std::sin(2 * pi * k / n);
        add(centre);
    }
    add((r + std::sqrt(4 * r * r - ring * ring)) * up<Dim>());
    return world;
}

/// Both thresholds of a pyramid, each with plenty of friction at the other place, and the shares of
/// the weight, which equilibrium determines.
template <int Dim>
void test_pyramid(Trial<Dim>& trial, int n, double mu_grain, double mu_floor) {
    const double enough = 1.0;
    const std::string number = std::to_string(n) + " below, ";
    expect_threshold<Dim>(
        trial, number + "mu between bodies", 1.01 * mu_grain, 0.99 * mu_grain,
        [&](double h, double mu) { return pyramid<Dim>(trial, n, mu, enough, h); });
    expect_threshold<Dim>(
        trial, number + "mu of the floor", 1.01 * mu_floor, 0.99 * mu_floor,
        [&](double h, double mu) { return pyramid<Dim>(trial, n, enough, mu, h); });

    const auto report = pyramid<Dim>(trial, n, enough, enough, 1e-3).equilibrium();
    double on_floor = 0.0, on_top = 0.0;
    const auto top = static_cast<talus::BodyIndex>(n + 1);
    Worst shares;
    for (std::size_t c = 0; c < report.data.contact_count(); ++c) {
        const auto& key = report.data.contacts.key[c];
        if (key.a == 0) on_floor += force_on<Dim>(report, key.b, c)[Dim - 1];
        if (key.b == top) {
            on_top += force_on<Dim>(report, top, c)[Dim - 1];
            shares.see(force_on<Dim>(report, top, c)[Dim - 1], 1.0 / n);
        }
    }
    trial.solver(number + "force of the floor / weight of one", on_floor, n + 1.0, n + 1.0,
                 statics_tolerance);
    trial.solver(number + "weight of the one on top", on_top, 1.0, n, statics_tolerance);
    // On four points the weight may be shared in more than one way.
    if (n == Dim)
        trial.solver(number + "share of the weight on top", shares, 1.0, statics_tolerance);
}

}  // namespace validation
