// SPDX-License-Identifier: BSL-1.0
#include <Eigen/Core>

#include "multiple_collisions.hpp"

namespace validation {
namespace B11 {

constexpr double m = 1.3, radius = 0.2, v = 1.0;

/// Two planes, in space three, around the vertical axis, each with the given slope.
template <int Dim>
std::vector<V<Dim>> normals(double slope) {
    std::vector<V<Dim>> result;
    for (int k = 0; k < Dim; ++k) {
        V<Dim> n = std::cos(slope) * up<Dim>();
        if constexpr (Dim == 2) {
            n[0] = k == 0 ? std::sin(slope) : -std::sin(slope);
        } else {
            n[0] = std::sin(slope) * std::cos(2 * pi * k / 3.0);
            n[1] = std::sin(slope) * std::sin(2 * pi * k / 3.0);
        }
        result.push_back(n);
    }
    return result;
}

/// The ball touches all planes at the midpoint of the step.
template <int Dim>
World<Dim> wedge(Trial<Dim>& trial, double slope, const V<Dim>& velocity, const Law<Dim>& contact) {
    auto world = trial.world(collision_params<Dim>(contact));
    for (const V<Dim>& n : normals<Dim>(slope)) world.add_plane(V<Dim>::Zero(), n);
    add_ball<Dim>(world, m, radius, radius / std::cos(slope) * up<Dim>(), velocity);
    return world;
}

/// Reference in the plane: statuses of both contacts by enumeration.
void enumerate(Trial<2>& trial, const std::string& name, double slope, const V<2>& velocity,
               double mu, double e, double e_t) {
    PlanarBody ball(m, 0.5 * m * radius * radius);
    for (const V<2>& n : normals<2>(slope)) ball.touch(-radius * n, n, mu);
    const Eigen::Vector3d begin(velocity[0], velocity[1], 0.0), no_load = Eigen::Vector3d::Zero();
    const Enumeration all(ball.problem(begin, no_load, e, e_t));
    const auto velocities = all.velocities();
    trial.holds("reference, one velocity, " + name, velocities.size() == 1,
                std::to_string(all.solutions().size()) + " combinations of statuses");
    Worst worst;
    for (const auto& s : all.solutions())
        worst.see(Eigen::Vector3d(ball.end(begin, no_load, s.r)), Eigen::Vector3d(-e * begin));
    trial.rounding("reference, enumeration, " + name, worst, 10.0 * v);
}

template <int Dim>
void on_axis(Trial<Dim>& trial, double slope) {
    const V<Dim> velocity = -v * up<Dim>();
    const std::string tan = std::to_string(slope / degree) + " degrees, ";
    for (const double mu : {0.0, 0.5})
        for (const double e : {0.0, 0.5, 1.0})
            for (const double e_t : {0.0, e}) {
                const std::string name = tan + "mu = " + std::to_string(mu) +
                                         ", e = " + std::to_string(e) +
                                         ", e_t = " + std::to_string(e_t);
                if constexpr (Dim == 2) enumerate(trial, name, slope, velocity, mu, e, e_t);
                auto world = wedge<Dim>(trial, slope, velocity, law<Dim>(mu, e, e_t));
                const auto& data = world.step();
                trial.holds("all planes touched, " + name, data.contact_count() == Dim);
                const double tolerance = world.params().solver.tolerance;
                const auto ball = static_cast<std::size_t>(Dim);
                trial.solver("velocity, " + name, world.bodies().velocity[ball],
                             V<Dim>(-e * velocity), v, tolerance);
                trial.solver("spin times radius, " + name,
                             radius * world.bodies().spin[ball].norm(), 0.0, v, tolerance);
                if (e == 0.0) break;
            }
}

/// Arrivals from all sides without friction, soft: projections on the plane, the edge, the apex.
template <int Dim>
void off_axis(Trial<Dim>& trial, double slope) {
    const auto n = normals<Dim>(slope);
    Series seen{"computed", {}, {}}, exact{"projection", {}, {}, true};
    Worst worst, closed_form;
    for (int k = -17; k <= 17; ++k)
        for (const double azimuth : {0.0, 0.4, 1.9}) {
            if (Dim == 2 && azimuth > 0.0) continue;
            const double angle = 5.0 * k * degree;
            V<Dim> velocity = -v * std::cos(angle) * up<Dim>();
            velocity[0] = v * std::sin(angle) * std::cos(azimuth);
            if constexpr (Dim == 3) velocity[1] = v * std::sin(angle) * std::sin(azimuth);
            PointCollision<Dim> collision{{m}, {velocity}, {}};
            for (const V<Dim>& normal : n)
                collision.contacts.push_back({0, PointCollision<Dim>::wall, normal});
            const V<Dim> projected = collision.moreau().velocity[0];
            if constexpr (Dim == 2) {
                // Within the normals' cone the apex; beside it the plane on that side.
                const double off = std::abs(angle) - slope;
                closed_form.see(projected.norm(), off <= 0.0 ? 0.0 : v * std::sin(off));
            }
            auto world = wedge<Dim>(trial, slope, velocity, law<Dim>(0.0));
            world.step();
            worst.see(world.bodies().velocity[Dim], projected);
            if (azimuth == 0.0) {
                seen.x.push_back(angle / degree);
                seen.y.push_back(world.bodies().velocity[Dim].norm());
                exact.x.push_back(angle / degree);
                exact.y.push_back(projected.norm());
            }
        }
    const std::string name = std::to_string(slope / degree) + " degrees";
    if constexpr (Dim == 2)
        trial.rounding("reference, projection by enumeration, " + name, closed_form, v);
    trial.solver("velocities off the axis, " + name, worst, v, 1e-14);
    trial.curves({"soft arrival off the axis, " + name,
                  "angle of arrival [degrees]",
                  "speed after [m/s]",
                  {seen, exact}});
}

template <int Dim>
void run(Trial<Dim>& trial) {
    for (const double slope : {45 * degree, 30 * degree}) {
        on_axis<Dim>(trial, slope);
        off_axis<Dim>(trial, slope);
    }
}

const Register b11(
    {.id = "B11",
     .name = "v-wedge-soft",
     .title = "A ball falls into a wedge",
     .gate = 2,
     .setup = "A ball arrives at 1 m/s in a symmetric V of two planes (in space three) that slope "
              "45 or 30 degrees, and touches all of them at once. On the axis: restitution 0, 0.5 "
              "and 1, friction 0 and 0.5, tangential restitution 0 or that of the normal. Off "
              "the axis: soft and without friction, at angles up to 85 degrees.",
     .reference = {"on the axis: u_{end} = −e u_{begin}, no spin",
                   "off the axis: the projection of u_{begin} on {u : n_k u ≥ 0}; in the plane its "
                   "speed is v max(0, sin(angle − slope))"},
     .compared = "Velocity and spin after the step; in the plane also those of an enumeration of "
                 "all statuses, which shows that they are unique. Impulses are not compared: with "
                 "friction they are not unique.",
     .kind = Class::S,
     .why = "With all contacts closed the normals alone determine the velocity.",
     .source = "Moreau 1985.",
     .catches = {Fault::restitution_weight, Fault::tilted_normal, Fault::pulling_contact}},
    run<2>, run<3>, __FILE__);

}  // namespace B11
}  // namespace validation
