// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/measure/energy_ledger.hpp>
#include <talus/measure/grain_load.hpp>
#include <talus/measure/penetration.hpp>
#include <talus/solver/report.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

namespace pile {

/// Figures of one step.
struct StepFigures {
    double time;
    std::size_t contacts;
    int sweeps;
    double residual;
    double kinetic, potential;
    double max_penetration, mean_penetration;
    double reaction_over_weight;
};

/// Watches a run and says at the end what its answer is worth.
template <int Dim>
class Certificate {
  public:
    template <class Simulation>
    Certificate(const Simulation& sim, double tolerance, double mean_radius)
        : tolerance_(tolerance),
          mean_radius_(mean_radius),
          ledger_(sim.system().bodies, sim.system().gravity) {
        const auto& bodies = sim.system().bodies;
        for (std::size_t i = 0; i < bodies.count(); ++i)
            if (!bodies.is_obstacle(i)) {
                mass_ += bodies.mass(i);
                ++grains_;
            }
        gravity_ = sim.system().gravity.norm();
    }

    template <class Simulation>
    void record(const Simulation& sim) {
        const auto& data = sim.data();
        const auto& bodies = sim.system().bodies;
        ledger_.record(data, bodies);
        const auto overlap = talus::penetration(
            data.contacts, [&](std::size_t c) { return data.impulse[c][0] > 0.0; });
        const talus::Vector<Dim> support =
            talus::impulse_from<Dim>(data.problem.jacobian, data.impulse,
                                     [&](std::size_t i) { return bodies.is_obstacle(i); });
        const double weight = mass_ * gravity_ * data.h;
        steps_.push_back({sim.time(), data.contact_count(), data.report.iterations,
                          data.report.residual, ledger_.kinetic(), ledger_.potential(), overlap.max,
                          overlap.mean, weight > 0.0 ? support[Dim - 1] / weight : 0.0});
        if (data.report.status != talus::SolveStatus::converged) ++missed_;
        worst_residual_ = std::max(worst_residual_, data.report.residual);
        deepest_ = std::max(deepest_, overlap.max);
        sweeps_ += data.report.iterations;
        updates_ +=
            static_cast<double>(data.report.iterations) * static_cast<double>(data.contact_count());
    }

    const StepFigures& last() const { return steps_.back(); }
    double weight() const { return mass_ * gravity_; }
    double mean_grain_weight() const { return weight() / static_cast<double>(grains_); }

    /// Floor force over weight, mean over the last tenth of the run.
    double reaction_over_weight() const {
        return late_mean([](const StepFigures& s) { return s.reaction_over_weight; });
    }
    /// Mean overlap of loaded contacts over the last tenth of the run [m].
    double mean_penetration() const {
        return late_mean([](const StepFigures& s) { return s.mean_penetration; });
    }
    /// Root mean square speed of the mass at the end [m/s].
    double speed() const { return mass_ > 0.0 ? std::sqrt(2 * ledger_.kinetic() / mass_) : 0.0; }

    /// The certificate in words and figures.
    std::string text(double seconds) const {
        std::string t;
        const auto line = [&t](const char* format, auto... values) {
            char buffer[240];
            std::snprintf(buffer, sizeof buffer, format, values...);
            t += buffer;
            t += '\n';
        };
        const auto& f = ledger_.flows();
        line("  steps                %zu, of which %d missed the tolerance of %.0e", steps_.size(),
             missed_, tolerance_);
        line("  residual             worst %.2e (relative natural map of the exact law)",
             worst_residual_);
        line(
            "  overlap              mean %.3f %% of the mean radius at the end, deepest ever %.2f "
            "%%",
            100 * mean_penetration() / mean_radius_, 100 * deepest_ / mean_radius_);
        line("  floor force / weight %.6f over the last tenth, %.6f in the last step",
             reaction_over_weight(), last().reaction_over_weight);
        line("  energy               gravity gave %.4e J; friction took %.4e, impacts %.4e",
             ledger_.potential_start() - ledger_.potential(), -f.friction, -f.restitution);
        line("                       left in motion %.2e J (rms speed %.1e m/s)", ledger_.kinetic(),
             speed());
        if (f.gyroscopic != 0.0 || f.correction != 0.0)
            line("                       gyroscopic term %.1e, position correction %.1e",
                 f.gyroscopic, f.correction);
        line("  energy books         close to %.1e", ledger_.closure());
        line(
            "  work                 %zu contacts at the end, %.1f sweeps per step, %.1f s (%.2g "
            "million contact updates/s)",
            last().contacts, static_cast<double>(sweeps_) / static_cast<double>(steps_.size()),
            seconds, updates_ / seconds * 1e-6);
        return t;
    }

    nlohmann::json json() const {
        const auto& f = ledger_.flows();
        nlohmann::json j;
        j["dim"] = Dim;
        j["grains"] = grains_;
        j["tolerance"] = tolerance_;
        j["steps"] = steps_.size();
        j["steps_missed"] = missed_;
        j["worst_residual"] = worst_residual_;
        j["mean_radius_m"] = mean_radius_;
        j["deepest_penetration_m"] = deepest_;
        j["mean_penetration_m"] = mean_penetration();
        j["reaction_over_weight"] = reaction_over_weight();
        j["rms_speed_m_per_s"] = speed();
        j["energy_J"] = {{"kinetic_start", ledger_.kinetic_start()},
                         {"kinetic_end", ledger_.kinetic()},
                         {"potential_start", ledger_.potential_start()},
                         {"potential_end", ledger_.potential()},
                         {"friction", f.friction},
                         {"restitution", f.restitution},
                         {"walls", f.walls},
                         {"gyroscopic", f.gyroscopic},
                         {"correction", f.correction},
                         {"missing", ledger_.missing()}};
        j["energy_closure"] = ledger_.closure();
        nlohmann::json& rows = j["per_step"] = nlohmann::json::array();
        for (const StepFigures& s : steps_)
            rows.push_back({{"time_s", s.time},
                            {"contacts", s.contacts},
                            {"sweeps", s.sweeps},
                            {"residual", s.residual},
                            {"kinetic_J", s.kinetic},
                            {"potential_J", s.potential},
                            {"max_penetration_m", s.max_penetration},
                            {"mean_penetration_m", s.mean_penetration},
                            {"reaction_over_weight", s.reaction_over_weight}});
        return j;
    }
    bool met_every_tolerance() const { return missed_ == 0; }

  private:
    template <class Figure>
    double late_mean(Figure&& figure) const {
        const std::size_t n = std::max<std::size_t>(1, steps_.size() / 10);
        double sum = 0.0;
        for (std::size_t k = steps_.size() - n; k < steps_.size(); ++k) sum += figure(steps_[k]);
        return sum / static_cast<double>(n);
    }

    double tolerance_, mean_radius_;
    talus::EnergyLedger<Dim> ledger_;
    std::vector<StepFigures> steps_;
    double mass_ = 0.0, gravity_ = 0.0;
    std::size_t grains_ = 0;
    int missed_ = 0;
    std::int64_t sweeps_ = 0;
    double updates_ = 0.0, worst_residual_ = 0.0, deepest_ = 0.0;
};

}  // namespace pile
