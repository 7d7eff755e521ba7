// SPDX-License-Identifier: BSL-1.0
#include <numeric>

#include "bouncing/rod_impact.hpp"

namespace validation {
namespace B16 {

constexpr int sample_count = 40000;

/// Random impacts. In the plane a body and its arm give any symmetric positive definite matrix: 1/m
/// is the smaller eigenvalue, and 1/I and the arm set the other one and its axis. The ranges below
/// make it up to 26 times the smaller.
template <int Dim>
RodImpact<Dim> random_impact(std::mt19937_64& rng) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const auto between = [&](double low, double high) { return low + (high - low) * unit(rng); };
    const double mass = std::pow(10.0, between(-1.0, 1.0));
    // No distribution of mass needs to have made them but for the triangle inequality in space.
    W<Dim> moments;
    for (int k = 0; k < moments.size(); ++k) moments[k] = mass * std::pow(10.0, between(-2.0, 1.0));
    if constexpr (Dim == 3) moments = W<3>::Constant(moments.sum()) - moments;
    talus::Rotation<Dim> rotation = tilt<Dim>(between(5.0, 175.0) * degree);
    if constexpr (Dim == 3)
        rotation = talus::Rotation<3>::exp({0.0, 0.0, between(0.0, 2.0 * pi)}) * rotation *
                   talus::Rotation<3>::exp({between(0.0, 2.0 * pi), 0.0, 0.0});
    V<Dim> velocity;
    for (int k = 0; k < Dim - 1; ++k) velocity[k] = between(-2.0, 2.0);
    velocity[Dim - 1] = -between(0.01, 1.0);
    return {{mass, moments}, 1.0, rotation, velocity};
}

template <int Dim>
void run(Trial<Dim>& trial) {
    auto rng = trial.rng();
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    Worst change, loss, on_mean, contacts;
    double gain = -1.0;
    std::vector<std::array<double, 3>> points;  // e, measured, exact
    for (int k = 0; k < sample_count; ++k) {
        const double mu = 2.0 * unit(rng), e = unit(rng);
        const auto impact = random_impact<Dim>(rng);
        auto world = impact.world(trial, law<Dim>(mu, e, e));
        const auto& data = world.step();
        contacts.see(static_cast<double>(data.contact_count()), 1.0);
        const double before = impact.energy();
        const double seen = (talus::kinetic_energy(world.bodies(), 1) - before) / before;
        gain = std::max(gain, seen);
        // By the reference's own matrix; vectors in world axes.
        const V<Dim> p = impulse_on(data, 1);
        const talus::Matrix<Dim> w = impact.w();
        const V<Dim> mean = impact.velocity + w * p / (1 + e);
        const double work = p.dot(mean), squared = p.dot(w * p);
        change.see(seen, (p.dot(impact.velocity) + 0.5 * squared) / before);
        const double slip = mean.template head<Dim - 1>().norm();
        const double exact = (-mu * p[Dim - 1] * slip - (1 - e) / (2 * (1 + e)) * squared) / before;
        loss.see(seen, exact);
        on_mean.see(work / before, -mu * p[Dim - 1] * slip / before);
        if (k < 200) points.push_back({e, seen, exact});
    }
    trial.within("contacts", contacts, 0.0, "one in every impact");
    trial.within(
        "largest gain of energy / T", std::max(gain, 0.0), 0.0, 1e-13,
        "tolerance of the catalogue; nearest to a gain: " + std::to_string(gain * 1e9) + "e-9");
    // Impulses reach some m v (1 + e) each way and cancel in the sum.
    trial.rounding("change of energy by the impulse's work", change, 10.0);
    trial.solver("work of the impulse on the mean velocity / T", on_mean, 10.0, 1e-14);
    trial.solver("change of energy by the formula", loss, 10.0, 1e-14);
    std::sort(points.begin(), points.end());
    Series seen{"measured", {}, {}}, exact{"exact", {}, {}, true};
    for (const auto& [e, measured, truth] : points) {
        seen.x.push_back(e), exact.x.push_back(e);
        seen.y.push_back(measured), exact.y.push_back(truth);
    }
    trial.curves({"200 of the impacts, ordered by e", "e", "ΔT / T", {seen, exact}});
}

const Register b16(
    {.id = "B16",
     .name = "energy-consistency-equal-e",
     .title = "Equal restitutions never create energy",
     .gate = 2,
     .setup = "40000 random straight bodies of random inertia strike the floor with one end at "
              "random velocities, friction up to 2 and one restitution between 0 and 1 for both "
              "directions. In the plane their Delassus matrices have eigenvalues and axes at will, "
              "in ratios up to 26.",
     .reference = {"ΔT = P · Ū − frac{1 − e}{2 (1 + e)} P · W P ≤ 0, Ū = frac{U_f + e U_i}{1 + e}",
                   "P · Ū = − μ P_N |Ū_T|, normal velocity Ū_N = 0"},
     .compared = "The largest change of kinetic energy, with 1e-13 T; the change of energy of each "
                 "impact with the formula and with the work of the impulse, by a Delassus matrix "
                 "of the reference's own.",
     .kind = Class::R,
     .why = "Both terms are negative whatever the matrix: friction opposes the mean velocity, and "
            "W is positive definite. The impulse is exact to the solver's tolerance.",
     .source = "Moreau 1988; Leine and van de Wouw 2008.",
     .catches = {Fault::friction_on_end_velocity, Fault::restitution_weight, Fault::short_arm}},
    run<2>, run<3>, __FILE__);

}  // namespace B16
}  // namespace validation
