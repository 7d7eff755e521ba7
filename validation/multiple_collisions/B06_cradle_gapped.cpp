// SPDX-License-Identifier: BSL-1.0
#include "cradle.hpp"

namespace validation {
namespace B06 {

constexpr std::size_t n = 5;
constexpr double h = collision_h, v = 1.0;

/// Way of a ball, in units of h v, to the first midpoint that finds the gap closed, if its
/// midpoints are `first`, `first` + 1, ... from where it was.
double closing(double gap, double first) {
    return std::max(0.0, std::ceil(gap / (h * v) - first - touching / (h * v))) + first;
}

template <int Dim>
void run(Trial<Dim>& trial) {
    for (const double ratio : {0.01, 0.5, 2.0, 10.0}) {
        auto cradle = Cradle::equal(n, 1.0);
        cradle.gap = ratio * h * v;
        auto world = cradle.make<Dim>(trial);
        const auto start = world.bodies().position;
        const std::string name = "gap " + std::to_string(ratio) + " h v";
        Series last{"ball 5", {}, {}}, middle{"ball 3", {}, {}};
        Worst momentum, energy;
        const double duration = (4 * ratio + 6) * h;
        world.run(duration, [&](const auto& w) {
            const auto& u = w.bodies().velocity;
            V<Dim> p = V<Dim>::Zero();
            double twice = 0.0;
            for (const auto& x : u) {
                p += x;
                twice += x.squaredNorm();
            }
            momentum.see(p, V<Dim>(v * slanted<Dim>()));
            energy.see(0.5 * twice, 0.5 * v * v);
            last.x.push_back(w.time());
            last.y.push_back(u[4].dot(slanted<Dim>()));
            middle.x.push_back(w.time());
            middle.y.push_back(u[2].dot(slanted<Dim>()));
        });
        for (std::size_t i = 0; i < n; ++i)
            trial.rounding(name + ": velocity of ball " + std::to_string(i + 1),
                           world.bodies().velocity[i],
                           V<Dim>(i + 1 == n ? V<Dim>(v * slanted<Dim>()) : V<Dim>::Zero()), v, h);
        // A ball that is handed the velocity has its next midpoint a full h v further on; the first
        // ball begins half a step before one.
        for (std::size_t i = 0; i + 1 < n; ++i)
            trial.rounding(name + ": where ball " + std::to_string(i + 1) + " stops [m]",
                           world.bodies().position[i] - start[i],
                           V<Dim>(h * v * closing(cradle.gap, i == 0 ? 0.5 : 1.0) * slanted<Dim>()),
                           1.0, h);
        trial.rounding(name + ": momentum", momentum, v, h);
        trial.rounding(name + ": energy", energy, v * v, h);
        if (ratio == 10.0) {
            const double hop = cradle.gap / v;
            trial.curves({"velocities, " + name,
                          "t [s]",
                          "v [m/s]",
                          {last,
                           middle,
                           {"ball 5, exact", {0, 4 * hop, 4 * hop, duration}, {0, 0, v, v}, true},
                           {"ball 3, exact",
                            {0, 2 * hop, 2 * hop, 3 * hop, 3 * hop, duration},
                            {0, 0, v, v, 0, 0},
                            true}}});
        }
    }
    // Which cradle it is, is for the tolerance of contact to say.
    for (const double gap : {0.5 * touching, 2.0 * touching}) {
        auto cradle = Cradle::equal(n, 1.0);
        cradle.gap = gap;
        auto world = cradle.make<Dim>(trial);
        world.run(20 * h);
        const bool apart = gap > touching;
        trial.rounding(apart ? "last ball, gap of twice the tolerance"
                             : "last ball, gap of half the tolerance",
                       world.bodies().velocity[n - 1],
                       V<Dim>((apart ? v : 2.0 / static_cast<double>(n)) * slanted<Dim>()), v, h);
    }
}

const Register b06(
    {.id = "B06",
     .name = "cradle-gapped",
     .title = "Newton's cradle with gaps",
     .gate = 2,
     .setup = "Five equal elastic balls on a line with gaps of 0.01, 0.5, 2 and 10 times the way "
              "of a step; the first arrives at 1 m/s. Steps of 1 ms, no gravity, no friction. "
              "Also gaps of half and of twice the tolerance of contact, 1e-10 m.",
     .reference = {"u_{end} = (0, 0, 0, 0, 1)",
                   "ball k stops at h v ceil(gap / h v) from where it was, the first at h v "
                   "(ceil(gap / h v − 1/2) + 1/2)"},
     .compared = "Velocities when all is over; where each ball stops; momentum and energy after "
                 "every step. With a gap below the tolerance the touching cradle of B05 instead.",
     .kind = Class::R,
     .why = "The midpoint test resolves the impacts one after another however small the gaps, and "
            "each impact of two equal balls hands the velocity over to rounding.",
     .source = "Two-body impacts; the stops follow from the midpoint rule.",
     .catches = {Fault::loose_contact, Fault::restitution_weight, Fault::begin_point,
                 Fault::end_point_drift}},
    run<2>, run<3>, __FILE__);

}  // namespace B06
}  // namespace validation
