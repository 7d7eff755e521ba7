// SPDX-License-Identifier: BSL-1.0
#include "box_of_balls.hpp"

namespace validation {
namespace G05 {

constexpr double lid_force = 100.0, lid_mass = 2.0;  // [N], [kg]: gently

/// Balls in a box without gravity, under a lid that slides down with a constant force.
template <int Dim>
World<Dim> pressed(Trial<Dim>& trial, WorldParams<Dim> params) {
    params.gravity = V<Dim>::Zero();
    const BoxOfBalls<Dim> box{Dim == 2 ? 5 : 3, Dim == 2 ? 5 : 3};
    auto world = box.make(trial, params);
    const double side = box.width(), lid_height = 0.27 * box.high + 0.05;
    V<Dim> half = V<Dim>::Constant(0.45 * side);  // clear of the walls
    half[Dim - 1] = 0.05;
    V<Dim> centre = V<Dim>::Constant(0.5 * side);
    centre[Dim - 1] = lid_height;
    const auto lid = world.add(talus::Box<Dim>(half), point_mass<Dim>(lid_mass), {centre, {}});
    world.system().forces.push_back(
        [lid](double, const talus::Bodies<Dim>&, std::span<talus::Wrench<Dim>> wrenches) {
            wrenches[static_cast<std::size_t>(lid)].force[Dim - 1] -= lid_force;
        });
    return world;
}

template <int Dim>
void run(Trial<Dim>& trial) {
    auto settling = pressed<Dim>(trial, settling_params<Dim>(0.5));
    settling.system().forces.push_back(drag<Dim>(drag_rate));
    settling.run(settling_time);
    const double tolerance = 1e-10;
    auto world = pressed<Dim>(trial, resting_params<Dim>(0.5, tolerance));
    copy_places<Dim>(settling, world);
    // From the forces that hold it: a jam is one of the answers (C07), and not the cold one.
    const auto report = world.equilibrium(settling.impulse_cache());
    trial.within("speed left / speed of the loads alone", report.speed / report.load_speed, 0.0,
                 1e-4, "at rest");
    const auto& data = report.data;
    const auto& j = data.problem.jacobian;
    const auto forces = measured_forces<Dim>(trial, data);
    const std::size_t last = world.bodies().count() - 1;  // the lid
    const auto is_ball = [&](std::size_t i) { return BoxOfBalls<Dim>::is_ball(i) && i != last; };

    // Grain by grain about a common origin: right only if every grain is in equilibrium.
    talus::Matrix<Dim> grains = talus::Matrix<Dim>::Zero();
    for (std::size_t c = 0; c < forces.size(); ++c) {
        // A force acts where its arm ends.
        const V<Dim> on_a = world.bodies().position[j.a[c]] + j.arm_a[c];
        const V<Dim> on_b = world.bodies().position[j.b[c]] + j.arm_b[c];
        if (is_ball(static_cast<std::size_t>(j.a[c]))) grains += on_a * forces[c].transpose();
        if (is_ball(static_cast<std::size_t>(j.b[c]))) grains -= on_b * forces[c].transpose();
    }
    const talus::Matrix<Dim> branches = talus::branch_moment<Dim>(j, forces, is_ball);
    const double scale = branches.norm();
    // A residual force on each ball times its distance from the origin.
    trial.solver("Σ x_c ⊗ f_c over grains against Σ branch ⊗ f over contacts [N m]", grains,
                 branches, scale * static_cast<double>(last), tolerance);
    trial.holds("the mean stress is compressive", branches.trace() < -0.5 * scale,
                "trace / norm = " + std::to_string(branches.trace() / scale) + ", " +
                    std::to_string(data.contact_count()) + " contacts");
    const auto moments = internal_moments<Dim>(j, forces, last + 1);
    talus::Matrix<Dim> sum = talus::Matrix<Dim>::Zero();
    for (std::size_t i = 0; i <= last; ++i)
        if (is_ball(i)) sum += moments[i];
    trial.rounding("sum of internal moments against branches [N m]", sum, branches, scale * 10);
}

const Register g05(
    {.id = "G05",
     .name = "branch-vs-grain-stress",
     .title = "Stress by branches and by grains",
     .gate = 2,
     .setup = "25 discs (27 spheres) with friction 0.5 and no gravity in a box, pressed by a "
              "sliding lid with 100 N until they rest in thick air.",
     .reference = {"Σ_c b_c ⊗ f_c = Σ_i Σ_{c ∈ i} x_c ⊗ f_c, if every grain is in equilibrium",
                   "b_c: centre to centre, or centre to the contact with a wall"},
     .compared = "Both sums, the second about a far origin; and the sum of the grains' internal "
                 "moments about their own centres, which is the first without any equilibrium.",
     .kind = Class::S,
     .why = "The sums differ by residual force times distance, summed over the grains.",
     .source = "Derived; Weber 1966.",
     .catches = {Fault::forces_in_local_axes}},
    run<2>, run<3>, __FILE__);

}  // namespace G05
}  // namespace validation
