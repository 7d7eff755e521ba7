// SPDX-License-Identifier: BSL-1.0
#include "multiple_collisions.hpp"

namespace validation {
namespace B07 {

constexpr double radius = 0.1, v = 1.0;

/// From the cue ball to each of the Dim targets, which touch each other.
template <int Dim>
std::vector<V<Dim>> normals() {
    std::vector<V<Dim>> result;
    const double c = Dim == 2 ? std::sqrt(3.0) / 2 : std::sqrt(2.0 / 3.0), s = std::sqrt(1 - c * c);
    for (int k = 0; k < Dim; ++k) {
        if constexpr (Dim == 2)
            result.push_back({c, k == 0 ? s : -s});
        else
            result.push_back({c, s * std::cos(2 * pi * k / 3.0), s * std::sin(2 * pi * k / 3.0)});
    }
    return result;
}

template <int Dim>
World<Dim> table(Trial<Dim>& trial, double e) {
    auto world = trial.world(collision_params<Dim>(law<Dim>(0.0, e)));
    add_ball<Dim>(world, 1.0, radius, V<Dim>::Zero(), v * V<Dim>::Unit(0));
    for (const V<Dim>& n : normals<Dim>())
        add_ball<Dim>(world, 1.0, radius, 2 * radius * n, V<Dim>::Zero());
    return world;
}

template <int Dim>
void run(Trial<Dim>& trial) {
    const auto n = normals<Dim>();
    const double c = n[0][0];
    Series cue{"cue ball", {}, {}}, target{"targets", {}, {}};
    Series cue_exact{"cue ball, exact", {}, {}, true}, target_exact{"targets, exact", {}, {}, true};
    for (int k = 0; k <= 10; ++k) {
        const double e = 0.1 * k;
        const double p = (1 + e) * c / (1 + Dim * c * c) * v, rest = v - Dim * c * p;
        auto world = table<Dim>(trial, e);
        const auto& data = world.step();
        const auto& u = world.bodies().velocity;
        cue.x.push_back(e);
        cue.y.push_back(u[0][0]);
        cue_exact.x.push_back(e);
        cue_exact.y.push_back(rest);
        target.x.push_back(e);
        target.y.push_back(u[1].norm());
        target_exact.x.push_back(e);
        target_exact.y.push_back(p);
        if (k != 0 && k != 10) continue;

        const std::string name = k == 0 ? "e = 0" : "e = 1";
        if constexpr (Dim == 2) {
            trial.within("reference, targets, " + name, p, k == 0 ? 0.346410162 : 0.692820323,
                         6e-10, "digits of the catalogue");
            trial.rounding("reference, cue, " + name, rest, k == 0 ? 0.4 : -0.2, 1.0);
        } else {
            trial.within("reference, targets, " + name, p, k == 0 ? 0.272165527 : 0.544331054,
                         6e-10, "digits of the catalogue");
            trial.rounding("reference, cue, " + name, rest, k == 0 ? 1.0 / 3 : -1.0 / 3, 1.0);
        }
        PointCollision<Dim> collision;
        collision.mass.assign(Dim + 1, 1.0);
        collision.velocity.assign(Dim + 1, V<Dim>::Zero());
        collision.velocity[0][0] = v;
        for (int i = 0; i < Dim; ++i) {
            const auto here = static_cast<std::size_t>(i);
            collision.contacts.push_back({i + 1, 0, n[here], e});
            for (int j = 0; j < i; ++j)
                collision.contacts.push_back(
                    {i + 1, j + 1, (n[here] - n[static_cast<std::size_t>(j)]).normalized(), e});
        }
        const auto enumerated = collision.moreau();
        for (std::size_t i = 0; i <= Dim; ++i) {
            const V<Dim> exact = i == 0 ? V<Dim>(rest * V<Dim>::Unit(0)) : V<Dim>(p * n[i - 1]);
            const std::string who = i == 0 ? "cue" : "target " + std::to_string(i);
            trial.rounding("reference, " + who + " by enumeration, " + name, enumerated.velocity[i],
                           exact, v);
            trial.rounding(who + ", " + name, u[i], exact, v);
        }
        double between_targets = 0.0;
        for (std::size_t i = 0; i < data.contact_count(); ++i)
            if (data.problem.jacobian.a[i] > 0 && data.problem.jacobian.b[i] > 0)
                between_targets = std::max(between_targets, data.impulse[i].norm());
        trial.holds("all pairs touch, " + name, data.contact_count() == Dim + Dim * (Dim - 1) / 2);
        trial.rounding("impulse between targets, " + name, between_targets, 0.0, v);
    }
    trial.curves(
        {"velocities after the break", "e", "v [m/s]", {cue, target, cue_exact, target_exact}});
}

const Register b07(
    {.id = "B07",
     .name = "billiard-break",
     .title = "A cue ball meets two or three balls at once",
     .gate = 2,
     .setup = "A ball at 1 m/s arrives centrally at two equal balls that touch each other, the "
              "normals at 30 degrees from its path; in space at three, the normals at 35.26 "
              "degrees. No friction, restitution 0 to 1.",
     .reference = {"P = (1 + e) frac{c}{1 + n c^2} m v at each of the n targets, c the cosine",
                   "targets P / m along the normals, cue v − n c P / m"},
     .compared = "The velocities of all balls; the impulse between targets with zero. The formula "
                 "with an enumeration that includes the contacts between targets.",
     .kind = Class::R,
     .why = "One step of a well-posed problem whose solver runs to rounding.",
     .source = "Classical; Ivanov 1995 on simultaneous impacts.",
     .catches = {Fault::restitution_weight, Fault::tilted_normal, Fault::reaction_lost}},
    run<2>, run<3>, __FILE__);

}  // namespace B07
}  // namespace validation
