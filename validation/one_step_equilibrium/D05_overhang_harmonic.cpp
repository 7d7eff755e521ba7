// SPDX-License-Identifier: BSL-1.0
#include "statics.hpp"

namespace validation {
namespace D05 {

constexpr double half_length = 0.5, half_height = 0.1;

/// n blocks on a table whose edge is at x = 0; the k-th from the top overhangs the next by
/// s / (2 k).
template <int Dim>
World<Dim> pile(Trial<Dim>& trial, int n, double s, double h) {
    auto world = trial.world(statics_params<Dim>(h, 0.5));
    const V<Dim> table = half_extents<Dim>(1.0, 0.2, 0.5);
    world.add_obstacle(talus::Box<Dim>(table), talus::Pose<Dim>{in_plane<Dim>(-1.0, -0.2), {}});
    const V<Dim> half = half_extents<Dim>(half_length, half_height, 0.2);
    double edge = 0.0;  // right end of what lies below
    for (int below = 0; below < n; ++below) {
        edge += s / (2.0 * (n - below));
        world.add(talus::Box<Dim>(half), box_inertia<Dim>(1.0, half),
                  {in_plane<Dim>(edge - half_length, half_height * (2 * below + 1)), {}});
    }
    return world;
}

template <int Dim>
void run(Trial<Dim>& trial) {
    struct Height {
        int blocks;
        double overhang;
    };
    for (const auto& [n, digits] : {Height{1, 0.5}, Height{2, 0.75}, Height{3, 0.916667},
                                    Height{4, 1.041667}, Height{8, 1.358929}}) {
        double overhang = 0.0;
        for (int k = 1; k <= n; ++k) overhang += 0.5 / k;
        const std::string blocks = std::to_string(n) + " blocks";
        trial.within("reference, overhang of " + blocks, overhang, digits, 5e-7, "digits");
        expect_threshold<Dim>(trial, blocks + ", s", 0.999, 1.001,
                              [&, n = n](double h, double s) { return pile<Dim>(trial, n, s, h); });
    }
}

const Register d05(
    {.id = "D05",
     .name = "overhang-harmonic",
     .title = "The harmonic overhang",
     .gate = 1,
     .setup = "1, 2, 3, 4 and 8 blocks, 1 m long and 0.2 m high, lie on each other at the edge of "
              "a table; the k-th from the top overhangs the next by s / 2k of its length, with s "
              "one thousandth below and above 1.",
     .reference = {"stands if s ≤ 1", "overhang = frac{s}{2} (1 + frac{1}{2} + … + frac{1}{n})"},
     .compared = "The verdict, at two step sizes, cold and warm. In space every interface has four "
                 "corners and is hyperstatic.",
     .kind = Class::T,
     .why = "One thousandth beside the threshold the verdict is still clear: 1e-9 g h against "
            "1e-4 g h.",
     .source = "Phear 1850; Hall 2005.",
     .catches = {Fault::pulling_contact, Fault::reaction_lost, Fault::sliver_face}},
    run<2>, run<3>, __FILE__);

}  // namespace D05
}  // namespace validation
