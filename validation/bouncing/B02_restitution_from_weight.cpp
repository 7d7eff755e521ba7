// SPDX-License-Identifier: BSL-1.0
#include "bouncing/bouncing.hpp"

namespace validation {
namespace B02 {

constexpr double h = 1e-3;

/// Velocities along `line` after the ball of mass `m_a` and speed 1 met one of mass `m_b` at rest.
template <int Dim>
std::array<double, 2> central_impact(Trial<Dim>& trial, double e, double m_a, double m_b,
                                     const V<Dim>& line, double& astray) {
    auto world = trial.world({.h = h, .contact = law<Dim>(0.0, e), .gravity = V<Dim>::Zero()});
    const double r = drop_radius;
    // Touch at the midpoint.
    world.add(talus::Ball<Dim>(r), round_inertia<Dim>(m_a, r), {-(r + h / 2) * line, {}}, {line});
    world.add(talus::Ball<Dim>(r), round_inertia<Dim>(m_b, r), {r * line, {}});
    world.step();
    const auto& v = world.bodies().velocity;
    astray = 0.0;
    for (const V<Dim>& u : v) astray = std::max(astray, (u - u.dot(line) * line).norm());
    return {v[0].dot(line), v[1].dot(line)};
}

template <int Dim>
double rebound_speed(Trial<Dim>& trial, double e) {
    return measured_rebound<Dim>(trial, {1.0, drop_radius, 0.0, -1.0, 0.0}, 0.0, e, 0.0).upward;
}

template <int Dim>
void run(Trial<Dim>& trial) {
    V<Dim> line = in_plane<Dim>(0.6, 0.8);
    if constexpr (Dim == 3) line = {0.48, 0.36, 0.8};
    Series wall{"ball and floor", {}, {}}, pair{"two balls", {}, {}};
    const std::array<std::array<double, 2>, 5> weights{
        {{1.0 / 2, 1.0}, {5.0 / 9, 0.8}, {2.0 / 3, 0.5}, {0.8, 0.25}, {1.0, 0.0}}};
    for (const auto& [theta, digits] : weights) {
        const double e = (1 - theta) / theta;
        const std::string name = "θ = " + std::to_string(theta);
        trial.rounding("reference, e, " + name, e, digits, 1.0);
        const double speed = rebound_speed<Dim>(trial, e);
        trial.rounding("rebound from the floor, " + name, speed, e, 1.0, h);
        double astray = 0.0;
        const auto [a, b] = central_impact<Dim>(trial, e, 1.0, 3.0, line, astray);
        trial.rounding("relative velocity of two balls, " + name, b - a, e, 1.0, h);
        trial.rounding("momentum of two balls, " + name, 1.0 * a + 3.0 * b, 1.0, 3.0, h);
        trial.rounding("velocity across the line of centres, " + name, astray, 0.0, 1.0, h);
        wall.x.push_back(theta), wall.y.push_back(speed);
        pair.x.push_back(theta), pair.y.push_back(b - a);
    }
    Series exact{"exact", {}, {}, true};
    for (int k = 0; k <= 50; ++k) {
        const double theta = 0.5 + 0.01 * k;
        exact.x.push_back(theta), exact.y.push_back((1 - theta) / theta);
    }
    trial.curves({"separation over approach", "θ", "e", {wall, pair, exact}});
}

const Register b02(
    {.id = "B02",
     .name = "restitution-from-weight",
     .title = "The weight of the mean velocity sets the restitution",
     .gate = 1,
     .setup = "A ball hits the floor at 1 m/s in a step without forces; a ball of 1 kg hits one of "
              "3 kg at rest, at 1 m/s along the line of centres, which is oblique to the axes.",
     .reference = {"e = frac{1 − θ}{θ}: 1, 0.8, 0.5, 0.25, 0 for θ = 1/2, 5/9, 2/3, 0.8, 1",
                   "v_b − v_a = e v, m_a v_a + m_b v_b = m_a v"},
     .compared = "Velocity of separation over that of approach, the momentum of the pair, and "
                 "what moves across the line of centres.",
     .kind = Class::R,
     .why = "One step, one contact, no forces: nothing but rounding.",
     .source = "Moreau 1988, 1994.",
     .catches = {Fault::restitution_weight, Fault::reaction_lost, Fault::tilted_normal}},
    run<2>, run<3>, __FILE__);

}  // namespace B02
}  // namespace validation
