// SPDX-License-Identifier: BSL-1.0
#include "statics.hpp"

namespace validation {
namespace D11 {

constexpr double mu = 0.4;
constexpr talus::MaterialIndex rough = 0, smooth = 1;

/// A block of unit weight (body 2) between a wall (1) and a pad (3) pushed with force S. The pad
/// slides on the smooth floor (0) and does not turn.
template <int Dim>
World<Dim> grip(Trial<Dim>& trial, double squeeze, double h) {
    talus::MaterialTable<Law<Dim>> laws(2, law<Dim>(0.0));
    laws.set(rough, rough, law<Dim>(mu));
    auto world = trial.world(statics_params<Dim>(h), laws);
    world.add_floor(smooth);
    world.add_plane(V<Dim>::Zero(), V<Dim>::Unit(0), rough);
    const V<Dim> half = V<Dim>::Constant(0.1), pad_half = half_extents<Dim>(0.05, 0.25, 0.25);
    const double height = pad_half[Dim - 1];
    world.add(talus::Box<Dim>(half), box_inertia<Dim>(1.0 / g, half),
              {in_plane<Dim>(0.1, height), {}}, {}, rough);
    const auto pad = world.add(talus::Box<Dim>(pad_half), point_mass<Dim>(1.0 / g),
                               {in_plane<Dim>(0.25, height), {}}, {}, rough);
    push<Dim>(world, pad, V<Dim>::Zero(), -squeeze * V<Dim>::Unit(0));
    return world;
}

/// Every corner of a side carries the same: a start that has the symmetry of the situation.
template <int Dim>
talus::ImpulseCache<Dim> shared_equally(const Equilibrium<Dim>& shown, double squeeze) {
    const auto& data = shown.data;
    const auto& j = data.problem.jacobian;
    const double share = 1.0 / (1 << (Dim - 1));
    std::vector<V<Dim>> r;
    for (std::size_t c = 0; c < data.contact_count(); ++c) {
        V<Dim> on_block;  // or on the pad, from the floor
        if (j.a[c] == 0)
            on_block = 1.5 * up<Dim>();
        else
            on_block = in_plane<Dim>(j.a[c] == 1 ? squeeze : -squeeze, 0.5);
        // The block is b of the wall's contacts and a of the pad's.
        const V<Dim> on_a = j.a[c] == 2 ? on_block : V<Dim>(-on_block);
        r.push_back(data.h * share * (j.frame[c] * on_a));
    }
    talus::ImpulseCache<Dim> cache;
    cache.store(data.contacts, j, r);
    return cache;
}

template <int Dim>
void run(Trial<Dim>& trial) {
    const double critical = 1 / (2 * mu);
    trial.rounding("reference, threshold / W", critical, 1.25, 1.0);
    const double enough = 1.01 * critical;
    const auto start = [&](const Equilibrium<Dim>& shown) {
        return shared_equally<Dim>(shown, enough);
    };
    expect_threshold<Dim>(
        trial, "S / W", enough, 0.99 * critical,
        [&](double h, double s) { return grip<Dim>(trial, s, h); }, start);

    auto world = grip<Dim>(trial, enough, 1e-2);
    const auto cold = world.equilibrium();
    if constexpr (Dim == 3)
        trial.note("From zero impulses the solver finds " +
                   std::string(cold.verdict == talus::Verdict::moving
                                   ? "a block that slides and spins"
                                   : "equilibrium") +
                   " at 1.01 of the threshold.");
    else
        trial.holds("from zero impulses too", cold.verdict == talus::Verdict::equilibrium);

    const auto report = world.equilibrium(start(cold));
    const V<Dim> centre = in_plane<Dim>(0.1, 0.25);
    const auto wall = resultant<Dim>(report, 1, 2, centre);
    const auto pad = resultant<Dim>(report, 3, 2, centre);
    trial.solver("push of the wall / W", wall.force[0], enough, 1.0, statics_tolerance);
    trial.solver("push of the pad / W", -pad.force[0], enough, 1.0, statics_tolerance);
    trial.solver("friction of both sides / W", wall.force[Dim - 1] + pad.force[Dim - 1], 1.0, 1.0,
                 statics_tolerance);
}

const Register d11(
    {.id = "D11",
     .name = "friction-grip",
     .title = "A block held between two pads",
     .gate = 1,
     .setup = "A block of weight W is held by friction 0.4 between a fixed wall and a pad that a "
              "force S pushes through the block's centre; the pad is guided by a smooth floor.",
     .reference = {"holds if 2 μ S ≥ W, so from S = 1.25 W on"},
     .compared = "The verdict at S = 1.2625 W and 1.2375 W; the two pushes and the sum of "
                 "friction. How the two sides share friction is not determined, nor, in space, "
                 "the verdict just above the threshold: see the theory page.",
     .kind = Class::S,
     .why = "Resultants agree to the solver's tolerance. In space the corners may share the push "
            "unevenly; then a block that slides while it spins about the push solves the step too, "
            "as its friction points in several directions. The solve therefore starts from "
            "impulses that have the symmetry of the situation.",
     .source = "Elementary statics.",
     .catches = {Fault::friction_off, Fault::reaction_lost}},
    run<2>, run<3>, __FILE__);

}  // namespace D11
}  // namespace validation
