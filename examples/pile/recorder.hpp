// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/measure/energy_ledger.hpp>
#include <talus/measure/grain_load.hpp>
#include <talus/measure/penetration.hpp>
#include <talus/stepping/run_summary.hpp>

#include <cmath>
#include <cstddef>
#include <string>

#include "figures.hpp"

namespace pile {

/// What people call a body: obstacles come first, the floor and two walls per horizontal axis, and
/// then the grains, counted as in a scene file.
inline std::string name_of(talus::BodyIndex body, int dim) {
    if (body == talus::RunSummary::no_body) return "";
    if (body == 0) return "the floor";
    const int walls = 2 * (dim - 1);
    if (body > walls) return "grain " + std::to_string(body - walls);
    return std::string("the wall ") + (body % 2 == 1 ? "at " : "opposite ") +
           (body <= 2 ? "x = 0" : "y = 0");
}

/// Watches a run and notes its figures.
template <int Dim>
class Recorder {
  public:
    template <class System>
    explicit Recorder(const System& system, Figures start)
        : figures_(std::move(start)), ledger_(system.bodies, system.gravity) {
        const auto& bodies = system.bodies;
        for (std::size_t i = 0; i < bodies.count(); ++i)
            if (!bodies.is_obstacle(i)) {
                figures_.mass += bodies.mass(i);
                ++figures_.grains;
            }
        figures_.dim = Dim;
        figures_.weight = figures_.mass * system.gravity.norm();
        figures_.kinetic_start = ledger_.kinetic_start();
        figures_.potential_start = ledger_.potential_start();
        figures_.momentum_up_start = momentum_up(bodies);
    }

    template <class Simulation>
    void record(const Simulation& sim) {
        const auto& data = sim.data();
        const auto& bodies = sim.system().bodies;
        ledger_.record(data, bodies);
        summary_.record(sim.system(), data);
        const auto overlap = talus::penetration(
            data.contacts, [&](std::size_t c) { return data.impulse[c][0] > 0.0; });
        const talus::Vector<Dim> support =
            talus::impulse_from<Dim>(data.problem.jacobian, data.impulse,
                                     [&](std::size_t i) { return bodies.is_obstacle(i); });
        const double weight = figures_.weight * data.h;
        figures_.steps.push_back(
            {sim.time(), data.contact_count(), data.report.iterations, data.report.residual,
             ledger_.kinetic(), ledger_.potential(), ledger_.flows().friction,
             ledger_.flows().restitution, overlap.max, overlap.mean,
             weight > 0.0 ? support[Dim - 1] / weight : 0.0, momentum_up(bodies)});
    }

    const StepFigures& last() const { return figures_.steps.back(); }
    bool empty() const { return figures_.steps.empty(); }

    Figures figures() const {
        Figures f = figures_;
        f.missed = summary_.missed;
        f.residual = worst(summary_.residual);
        f.velocity_error = worst(summary_.velocity_error);
        f.overlap = worst(summary_.overlap);
        f.drift = summary_.drift;
        const talus::EnergyFlows& flows = ledger_.flows();
        f.given = {flows.friction, flows.restitution, flows.walls, flows.gyroscopic,
                   flows.correction};
        f.energy_missing = ledger_.missing();
        f.energy_closure = ledger_.closure();
        return f;
    }

  private:
    static double momentum_up(const talus::Bodies<Dim>& bodies) {
        double sum = 0.0;
        for (std::size_t i = 0; i < bodies.count(); ++i)
            if (!bodies.is_obstacle(i)) sum += bodies.mass(i) * bodies.velocity[i][Dim - 1];
        return sum;
    }
    WorstFigure worst(const talus::RunSummary::Worst& w) const {
        return {w.value, w.time, std::llround(w.time / figures_.h), name_of(w.a, Dim),
                name_of(w.b, Dim)};
    }

    Figures figures_;
    talus::EnergyLedger<Dim> ledger_;
    talus::RunSummary summary_;
};

}  // namespace pile
