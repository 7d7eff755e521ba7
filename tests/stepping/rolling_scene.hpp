// SPDX-License-Identifier: BSL-1.0
// Simulations with rolling friction, for its tests.
#pragma once

#include <talus/law/cohesive.hpp>
#include <talus/law/rolling_coulomb.hpp>
#include <talus/measure/energy_ledger.hpp>
#include <talus/stepping/step_queries.hpp>

#include "experiment.hpp"

namespace experiment {

template <int Dim, class L = talus::RollingFriction<Dim>>
struct RollingTypes : talus::SimulationTypes<Dim> {
    using Law = L;
};
template <int Dim, class L>
using RollingSimulation = talus::Simulation<Dim, RollingTypes<Dim, L>>;

/// With a tight solver and gravity; nothing in it.
template <int Dim, class L>
RollingSimulation<Dim, L> rolling_simulation(const L& contact_law, double h,
                                             const V<Dim>& gravity) {
    talus::SimulationParams params{.h = h};
    params.step.contact_tolerance = touching;
    RollingSimulation<Dim, L> sim(contact_law, params);
    sim.solver().params.tolerance = solver_tolerance;
    sim.solver().params.aim = solver_tolerance;
    sim.system().gravity = gravity;
    return sim;
}

/// The length of the rolling rows of a ball on a floor.
inline constexpr double R = 0.25;  // [m]

/// A ball at rest on a floor, body 1 on body 0, with gravity down a slope of that tangent.
template <int Dim, class L>
RollingSimulation<Dim, L> ball_on_a_slope(const L& contact_law, double slope, double h) {
    const double cosine = 1.0 / std::hypot(1.0, slope);
    auto sim = rolling_simulation<Dim>(contact_law, h,
                                       V<Dim>(g * cosine * (slope * V<Dim>::Unit(0) - up<Dim>())));
    sim.system().add_obstacle(talus::HalfSpace<Dim>{up<Dim>(), 0.0});
    sim.system().add(talus::Ball<Dim>{R}, 1000.0, {R * up<Dim>(), {}});
    return sim;
}

/// Largest difference between the velocities of all rows that a step ended with and W r + u_free.
template <int Dim, class Law>
double mismatch(const talus::StepData<Dim, Law>& data) {
    constexpr int rows = talus::law_rows<Law, Dim>;
    const talus::DelassusProduct<Dim, talus::AngularMatrix<Dim>, rows> w(data.problem.jacobian,
                                                                         data.problem.inverse_mass);
    std::vector<talus::Vector<rows>> u(data.contact_count());
    w.multiply(data.solution(), u);
    double most = 0.0;
    for (std::size_t c = 0; c < u.size(); ++c) {
        const auto end = talus::relative_velocity<Dim, rows>(
            data.problem.jacobian, c, std::span<const talus::Twist<Dim>>(data.end));
        const auto free = talus::relative_velocity<Dim, rows>(
            data.problem.jacobian, c, std::span<const talus::Twist<Dim>>(data.free));
        most = std::max(most, largest(talus::Vector<rows>(end - free - u[c])));
    }
    return most;
}

}  // namespace experiment
