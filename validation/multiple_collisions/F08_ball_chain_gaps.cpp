// SPDX-License-Identifier: BSL-1.0
#include "cradle.hpp"

namespace validation {
namespace F08 {

constexpr std::size_t n = 10;
/// So wide that at first not even the boxes around the balls meet.
constexpr double e = 0.9, gap = 0.2;

template <int Dim>
void run(Trial<Dim>& trial) {
    auto cradle = Cradle::equal(n, e);
    cradle.gap = gap;
    auto world = cradle.make<Dim>(trial);
    const auto start = world.bodies().position;
    const double handed = 0.5 * (1 + e), kept = 0.5 * (1 - e), h = collision_h;
    double arrival = 0.0;
    for (std::size_t k = 0; k + 1 < n; ++k) arrival += gap / std::pow(handed, k);
    Series last{"last ball", {}, {}}, fifth{"fifth ball", {}, {}};
    const double duration = arrival + 0.2;
    world.run(duration, [&](const auto& w) {
        for (auto& [series, ball] : {std::pair{&last, n - 1}, std::pair{&fifth, n / 2 - 1}}) {
            series->x.push_back(w.time());
            series->y.push_back(w.bodies().velocity[ball].dot(slanted<Dim>()));
        }
    });
    const double fastest = std::pow(handed, n - 1);
    trial.within("reference, speed of the last ball [m/s]", fastest, 0.630249410, 5e-10, "digits");
    for (std::size_t k = 0; k < n; ++k)
        trial.rounding("velocity of ball " + std::to_string(k + 1) + " [m/s]",
                       world.bodies().velocity[k],
                       V<Dim>((k + 1 == n ? fastest : kept * std::pow(handed, k)) * slanted<Dim>()),
                       1.0 / h, h);
    trial.within("way of the last ball [m]",
                 (world.bodies().position.back() - start.back()).dot(slanted<Dim>()),
                 fastest * (world.time() - arrival), n * h, "each impact at most a step late", h);
    trial.curves({"velocities",
                  "t [s]",
                  "v [m/s]",
                  {fifth,
                   last,
                   {"last ball, exact",
                    {0.0, arrival, arrival, duration},
                    {0.0, 0.0, fastest, fastest},
                    true}}});
}

const Register f08(
    {.id = "F08",
     .name = "ball-chain-gaps",
     .title = "A blow runs along a chain of balls",
     .gate = 1,
     .setup = "Ten equal balls of radius 0.1 m on a line with gaps of 0.2 m; the first moves at 1 "
              "m/s. Restitution 0.9, steps of 1 ms, no gravity, no friction. Each ball meets the "
              "next long after the first step.",
     .reference = {"u_{10} = (frac{1 + e}{2})^9 = 0.630249",
                   "u_k = frac{1 − e}{2} (frac{1 + e}{2})^{k − 1} for k < 10"},
     .compared = "Velocities when the blow has passed; the way of the last ball by then.",
     .kind = Class::R,
     .why = "Impacts of two balls are exact; 1/h steps add their rounding errors, which turn the "
            "normals a little. Each impact may be seen up to a step late, which delays the last "
            "ball.",
     .source = "Two-body impacts in sequence.",
     .catches = {Fault::stale_candidates, Fault::restitution_weight, Fault::reaction_lost}},
    run<2>, run<3>, __FILE__);

}  // namespace F08
}  // namespace validation
