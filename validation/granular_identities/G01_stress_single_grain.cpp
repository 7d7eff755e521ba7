// SPDX-License-Identifier: BSL-1.0
#include "measured.hpp"

namespace validation {
namespace G01 {

template <int Dim>
void run(Trial<Dim>& trial) {
    const double r = 0.3;
    const V<Dim> push = [] {
        V<Dim> f;
        for (int k = 0; k < Dim; ++k) f[k] = 3.0 + 2.0 * k;
        return f;
    }();
    auto world = trial.world({.h = 1e-2, .gravity = V<Dim>::Zero()});
    for (int k = 0; k < Dim; ++k) world.add_plane(V<Dim>::Zero(), V<Dim>::Unit(k));
    const auto ball =
        world.add(talus::Ball<Dim>{r}, round_inertia<Dim>(1.0, r), {V<Dim>::Constant(r), {}});
    // Plates that slide towards the ball, each pushed by its force.
    std::vector<talus::BodyIndex> plates;
    for (int k = 0; k < Dim; ++k) {
        V<Dim> half = V<Dim>::Constant(0.8 * r);
        half[k] = 0.1;
        V<Dim> centre = V<Dim>::Constant(r);
        centre[k] = 2 * r + 0.1;
        plates.push_back(world.add(talus::Box<Dim>(half), point_mass<Dim>(1.0), {centre, {}}));
    }
    world.system().forces.push_back(
        [plates, push](double, const talus::Bodies<Dim>&, std::span<talus::Wrench<Dim>> wrenches) {
            for (int k = 0; k < Dim; ++k)
                wrenches[static_cast<std::size_t>(plates[static_cast<std::size_t>(k)])].force[k] -=
                    push[k];
        });
    world.step();
    const auto& data = world.data();
    const auto moments = internal_moments<Dim>(
        data.problem.jacobian, measured_forces<Dim>(trial, data), world.bodies().count());
    const double volume = std::pow(2 * r, Dim), area = std::pow(2 * r, Dim - 1);
    const talus::Matrix<Dim> stress = moments[static_cast<std::size_t>(ball)] / volume;
    for (int k = 0; k < Dim; ++k)
        for (int l = 0; l < Dim; ++l)
            trial.rounding("stress " + std::to_string(k) + std::to_string(l) + " [Pa]",
                           stress(k, l), k == l ? -push[k] / area : 0.0, largest(push) / area);
}

const Register g01(
    {.id = "G01",
     .name = "stress-single-grain",
     .title = "Stress of a single grain",
     .gate = 1,
     .setup = "A disc (sphere) of radius 0.3 m in a box of side 2 r, pressed along every axis "
              "between a wall and a plate that is pushed with a force of its own (3, 5 and 7 N), "
              "without friction.",
     .reference = {"σ = frac{1}{V} Σ_c x_c ⊗ f_c, V = (2 r)^D",
                   "σ_{kk} = − frac{2 r F_k}{(2 r)^D} = − wall force per wall area",
                   "σ_{kl} = 0 for k ≠ l"},
     .compared = "All components of the mean stress from the internal moment.",
     .kind = Class::R,
     .why = "Opposed forces through the centre: the solver finds them to rounding in one step.",
     .source = "Moreau 1997; Love 1927; Weber 1966.",
     .catches = {Fault::forces_in_local_axes, Fault::short_arm, Fault::tilted_normal}},
    run<2>, run<3>, __FILE__);

}  // namespace G01
}  // namespace validation
