// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>

#include <random>
#include <stdexcept>
#include <string>

#include "harness/case.hpp"
#include "harness/enumeration.hpp"

/// The protocol of jamming: a body between two frictional contacts is first pushed in, hard, and
/// then pulled out gently by the impulse `pull` in one step, from zero impulses ("cold") and from
/// those of the push ("warm").
namespace validation {

inline constexpr double pull = 1e-2;  // [N s]
inline constexpr double jam_tolerance = 1e-14;
/// The push over the pull: beside a threshold by one part in a hundred, the impulses of the jammed
/// state have to be some hundred times the pull.
inline constexpr double push_ratio = 1e4;

template <int Dim>
struct JamOutcome {
    Equilibrium<Dim> push, cold, warm;
};

/// `make(impulse)` makes the world with the load `impulse` in the step, positive outwards.
template <int Dim, class Make>
JamOutcome<Dim> try_to_jam(const Make& make) {
    const auto remembered = [](const Equilibrium<Dim>& report) {
        talus::ImpulseCache<Dim> cache;
        cache.store(report.data.contacts, report.data.problem.jacobian, report.data.impulse);
        return cache;
    };
    JamOutcome<Dim> outcome;
    outcome.push = make(-push_ratio * pull).equilibrium();
    World<Dim> world = make(pull);
    outcome.cold = world.equilibrium();
    outcome.warm = world.equilibrium(remembered(outcome.push));
    return outcome;
}

/// Cold the body leaves; warm it stays if and only if `jams`.
template <int Dim>
void judge(Trial<Dim>& trial, const JamOutcome<Dim>& outcome, bool jams, const std::string& name) {
    for (const auto& [report, stays, which] : {std::tuple{&outcome.cold, false, ", cold start"},
                                               std::tuple{&outcome.warm, jams, ", warm start"}}) {
        trial.holds(
            name + which + (stays ? ": stays" : ": leaves"),
            report->verdict == (stays ? talus::Verdict::equilibrium : talus::Verdict::moving),
            "speed over that without contacts: " +
                std::to_string(report->speed / report->load_speed));
        trial.within("residual, " + name + which, report->residual, 0.0, 1e-12,
                     "catalogue: below 1e-12");
    }
    trial.holds("both begin with two contacts, " + name, outcome.cold.data.contact_count() == 2);
}

/// Starts at random, up to `push_ratio` times the pull.
template <int Dim>
talus::ImpulseCache<Dim> random_start(const Equilibrium<Dim>& shown, double mu,
                                      std::mt19937_64& rng) {
    std::uniform_real_distribution<double> push(0.0, push_ratio * pull), friction(-mu, mu);
    std::vector<V<Dim>> r;
    for (std::size_t c = 0; c < shown.data.contact_count(); ++c) {
        V<Dim> impulse = V<Dim>::Zero();
        impulse[0] = push(rng);
        impulse[Dim - 1] = friction(rng) * impulse[0];
        r.push_back(impulse);
    }
    talus::ImpulseCache<Dim> cache;
    cache.store(shown.data.contacts, shown.data.problem.jacobian, r);
    return cache;
}

/// Friction that impulses at zero load need: those with G^T r = 0, which two contacts of a planar
/// body have one of.
inline double self_stress_friction(const PlanarBody& body) {
    const Eigen::Matrix<double, 4, 3> g = body.g();
    V<3> row[4];
    for (int i = 0; i < 4; ++i) row[i] = g.row(i).transpose();
    // Cramer's rule: the minors of three rows, with alternating signs.
    const auto minor = [&](int i, int j, int k) { return row[i].dot(row[j].cross(row[k])); };
    const double r[] = {minor(1, 2, 3), -minor(0, 2, 3), minor(0, 1, 3), -minor(0, 1, 2)};
    // Both contacts push, or (with the other sign of r) the self-stress would be tension.
    if (!(r[0] * r[2] > 0.0)) throw std::logic_error("no self-stress in compression");
    return std::max(std::abs(r[1] / r[0]), std::abs(r[3] / r[2]));
}

}  // namespace validation
