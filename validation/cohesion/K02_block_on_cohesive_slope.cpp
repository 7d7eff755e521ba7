// SPDX-License-Identifier: BSL-1.0
#include "cohesion/cohesive_block.hpp"

namespace validation {
namespace K02 {

constexpr double mu = 0.3;

/// A block on a plane tilted by `slope`, beyond 90 degrees overhanging; `part` is the cohesion by
/// what holds it there.
template <int Dim>
void slide(Trial<Dim>& trial, double slope, double part, double h) {
    constexpr double m = CohesiveBlock<Dim>::mass;
    const double along = m * g * std::sin(slope), press = m * g * std::cos(slope);
    const double force = part * (along / mu - press);
    CohesiveBlock<Dim> block(trial.fault(), h, mu, force,
                             in_plane<Dim>(g * std::sin(slope), -g * std::cos(slope)));
    const double a = std::max(0.0, (along - mu * (press + force)) / m);
    Worst velocity, way;
    block.run(0.3, [&](double t, const V<Dim>& u, const V<Dim>& x) {
        velocity.see(u, in_plane<Dim>(a * t, 0.0));
        way.see(x, in_plane<Dim>(a * t * t / 2, 0.0));
    });
    const std::string name = std::to_string(static_cast<int>(std::lround(slope / degree))) +
                             " deg, cohesion " + std::to_string(part) + " of what holds";
    trial.rounding("velocity, " + name, velocity, 1.0 / std::sqrt(h), h);
    trial.rounding("way, " + name, way, 1.0 / std::sqrt(h), h);
    trial.within("worst residual, " + name, block.worst_residual(), 0.0, 1e-12,
                 "100 times the solver's tolerance", h);
}

template <int Dim>
void run(Trial<Dim>& trial) {
    for (const double h : {1e-2, 1e-3})
        for (const double slope : {30 * degree, 90 * degree, 120 * degree})
            for (const double part : {0.9, 0.999, 1.001}) slide(trial, slope, part, h);
}

const Register k02(
    {.id = "K02",
     .name = "cohesive-slope",
     .title = "A block sticks to a slope, a wall and an overhang",
     .gate = 1,
     .setup = "A block of 2 kg, which does not turn, starts from rest on a plane tilted by 30°, "
              "90° or 120° with friction 0.3 and a cohesion a little more or less than what holds "
              "it there.",
     .reference = {"rests for m g sin β ≤ μ (m g cos β + F_c)",
                   "else frac{du}{dt} = g sin β − μ (g cos β + frac{F_c}{m})"},
     .compared = "Velocity and way at every step.",
     .kind = Class::R,
     .why = "All forces are constant, so the step is exact; 1/h steps add their rounding errors.",
     .source = "Mohr and Coulomb; balance of momentum.",
     .catches = {Fault::friction_off, Fault::tilted_normal}},
    run<2>, run<3>, __FILE__);

}  // namespace K02
}  // namespace validation
