// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "harness/case.hpp"

/// The protocol of all statics cases: bodies exactly in place, zero velocity, one step solved to
/// 1e-12; at rest if no point is faster than 1e-9 g h, moving if one is faster than 1e-4 g h; at
/// two step sizes; from zero impulses and from the solution just found.
namespace validation {

inline constexpr double statics_tolerance = 1e-12;

template <int Dim>
WorldParams<Dim> statics_params(double h, double mu = 0.0) {
    return {.h = h,
            .contact = law<Dim>(mu),
            .solver = {.max_sweeps = 1000000, .tolerance = statics_tolerance}};
}

/// Impulses that a solve begins from, made from a report that shows the contacts: none.
struct FromZero {
    template <int Dim>
    talus::ImpulseCache<Dim> operator()(const Equilibrium<Dim>&) const {
        return {};
    }
};

/// Tests the worlds that `make(h)` returns: do they stand? Returns the report at the first step
/// size. The first solve begins from `start(report of a solve from zero)`.
template <int Dim, class Make, class Start = FromZero>
Equilibrium<Dim> expect(Trial<Dim>& trial, const std::string& situation, bool stands,
                        const Make& make, const Start& start = {}) {
    std::vector<Equilibrium<Dim>> reports;
    for (const double h : {1e-2, 1e-4}) {
        World<Dim> world = make(h);
        const auto verdict_on = [&](const std::string& warm, const Equilibrium<Dim>& report) {
            const double unit = g * h;
            Check check;
            check.label = situation + (stands ? " stands" : " moves") + warm;
            check.kind = Class::T;
            check.measured = report.speed / unit;
            check.bound = stands ? 1e-9 : 0.0;
            check.error = stands ? check.measured : (check.measured >= 1e-4 ? 0.0 : 1.0);
            if (stands) check.expected = 0.0;
            check.h = h;
            check.unit = "g h";
            check.note = stands ? "at rest: below 1e-9 g h" : "moving: above 1e-4 g h";
            trial.add(check);
            trial.holds(
                situation + ": verdict" + warm,
                report.verdict == (stands ? talus::Verdict::equilibrium : talus::Verdict::moving),
                "of the library", h);
        };
        Equilibrium<Dim> first = world.equilibrium();
        if constexpr (!std::is_same_v<Start, FromZero>) first = world.equilibrium(start(first));
        verdict_on("", first);
        talus::ImpulseCache<Dim> cache;
        cache.store(first.data.contacts, first.data.problem.jacobian, first.data.impulse);
        verdict_on(" (warm start)", world.equilibrium(cache));
        reports.push_back(std::move(first));
    }
    return reports.front();
}

/// Both sides of a threshold: `make(h, parameter)` stands at one value and moves at the other.
template <int Dim, class Make, class Start = FromZero>
void expect_threshold(Trial<Dim>& trial, const std::string& what, double stands_at, double moves_at,
                      const Make& make, const Start& start = {}) {
    for (const auto& [value, stands] : {std::pair{stands_at, true}, std::pair{moves_at, false}})
        expect<Dim>(
            trial, what + " = " + std::to_string(value), stands,
            [&, value = value](double h) { return make(h, value); }, start);
}

/// Force that `body` receives from contact c [N], world axes.
template <int Dim>
V<Dim> force_on(const Equilibrium<Dim>& report, talus::BodyIndex body, std::size_t c) {
    return impulse_on<Dim>(report.data, body, c) / report.data.h;
}

/// Force and moment (about `point`) that body `to` receives from body `from`.
template <int Dim>
talus::Wrench<Dim> resultant(const Equilibrium<Dim>& report, talus::BodyIndex from,
                             talus::BodyIndex to, const V<Dim>& point) {
    talus::Wrench<Dim> sum;
    const auto& keys = report.data.contacts.key;
    for (std::size_t c = 0; c < keys.size(); ++c) {
        const talus::BodyIndex a = keys[c].a, b = keys[c].b;
        if (!((a == from && b == to) || (a == to && b == from))) continue;
        sum += talus::Wrench<Dim>::at(report.data.contacts.point[c] - point,
                                      force_on<Dim>(report, to, c));
    }
    return sum;
}

/// Adds a constant wrench on a body to a world, its force acting at `arm` from the body's centre.
template <int Dim>
void push(World<Dim>& world, talus::BodyIndex body, const V<Dim>& arm, const V<Dim>& force) {
    const auto wrench = talus::Wrench<Dim>::at(arm, force);
    world.system().forces.push_back(
        [body, wrench](double, const talus::Bodies<Dim>&, std::span<talus::Wrench<Dim>> wrenches) {
            wrenches[static_cast<std::size_t>(body)] += wrench;
        });
}

/// Half extents of a block: first axis, last axis, and in space the middle one.
template <int Dim>
V<Dim> half_extents(double first, double last, double middle) {
    V<Dim> half = V<Dim>::Constant(middle);
    half[0] = first;
    half[Dim - 1] = last;
    return half;
}

/// A block of mass 1 on the floor, in gravity that is tilted by `slope`, which makes the floor an
/// incline that descends along the first axis.
template <int Dim>
World<Dim> block_on_incline(Trial<Dim>& trial, const V<Dim>& half, double slope, double mu,
                            double h) {
    auto params = statics_params<Dim>(h, mu);
    params.gravity = in_plane<Dim>(g * std::sin(slope), -g * std::cos(slope));
    auto world = trial.world(params);
    world.add_floor();
    world.add(talus::Box<Dim>(half), box_inertia<Dim>(1.0, half), {half[Dim - 1] * up<Dim>(), {}});
    return world;
}

}  // namespace validation
