// SPDX-License-Identifier: BSL-1.0
#include "harness/case.hpp"
#include "harness/observed.hpp"

namespace validation {
namespace E17 {

/// Runs n steps, turns all velocities round, runs n steps again; how far the start is missed.
template <int Dim>
double missed(World<Dim>& world, int n, std::size_t body, Series* path = nullptr) {
    const talus::Bodies<Dim> start = world.bodies();
    const auto go = [&](double origin, double sense) {
        for (int k = 1; k <= n; ++k) {
            world.step();
            if (!path) continue;
            path->x.push_back(origin + sense * k * world.params().h);
            path->y.push_back(world.bodies().position[body][Dim - 1]);
        }
    };
    go(0.0, 1.0);
    auto& bodies = world.bodies();
    for (std::size_t i = 0; i < bodies.count(); ++i) {
        bodies.velocity[i] *= -1.0;
        bodies.spin[i] *= -1.0;
    }
    go(n * world.params().h, -1.0);
    double error = 0.0;
    for (std::size_t i = 0; i < bodies.count(); ++i) {
        error = std::max(error, largest((bodies.position[i] - start.position[i]).eval()));
        error = std::max(error, largest((bodies.velocity[i] + start.velocity[i]).eval()));
        error = std::max(error, largest((bodies.spin[i] + start.spin[i]).eval()));
        error = std::max(error, bodies.rotation[i].distance(start.rotation[i]));
    }
    return error;
}

/// Splits a path that went forth and back.
Curves forth_and_back(const std::string& label, const Series& path) {
    const auto half = static_cast<std::ptrdiff_t>(path.x.size() / 2);
    Series forth{
        "forth", {path.x.begin(), path.x.begin() + half}, {path.y.begin(), path.y.begin() + half}};
    Series back{
        "back", {path.x.begin() + half, path.x.end()}, {path.y.begin() + half, path.y.end()}};
    // The way forth is what the way back has to be.
    forth.exact = true;
    return {label, "t [s]", "z [m]", {back, forth}};
}

template <int Dim>
void run(Trial<Dim>& trial) {
    for (const double h : {3e-2, 1e-3}) {
        // A spring that stiffens, pulling at a body that turns.
        auto flight = trial.world({.h = h,
                                   .step = {.contact_tolerance = touching,
                                            .gyroscopic = talus::Gyroscopic::momentum_preserving}});
        W<Dim> moments = W<Dim>::Constant(0.3);
        W<Dim> spin = rolling_spin<Dim>(1.3);
        if constexpr (Dim == 3) {
            moments = {0.2, 0.3, 0.4};
            spin = {0.7, 1.3, -0.4};
        }
        const auto body =
            flight.add(talus::Ball<Dim>(0.3), talus::Inertia<Dim>{1.2, moments},
                       {in_plane<Dim>(1.0, 0.5), {}}, {in_plane<Dim>(-0.3, 2.0), spin});
        push(flight, body,
             [](double, const V<Dim>& x) { return V<Dim>(-(2.0 + 5.0 * x.squaredNorm()) * x); });
        const int n = 1000;
        Series path;
        const double away = missed(flight, n, 0, &path);
        // Numbers of order 1, both ways; an anharmonic orbit shears rounding like n.
        trial.rounding("start missed, stiffening spring", away, 0.0, n, h);
        if (h == 3e-2) trial.curves(forth_and_back("height, stiffening spring", path));

        // A ball that bounces without loss.
        auto bounce = trial.world({.h = h, .contact = law<Dim>(0.0, 1.0)});
        bounce.add_floor();
        bounce.add(talus::Ball<Dim>(0.2), round_inertia<Dim>(1.0, 0.2), {1.2 * up<Dim>(), {}},
                   {in_plane<Dim>(0.4, 0.0)});
        Series hops;
        trial.rounding("start missed, elastic bounces", missed(bounce, n, 1, &hops), 0.0, n, h);
        if (h == 1e-3) trial.curves(forth_and_back("height, elastic bounces", hops));
    }
}

const Register e17(
    {.id = "E17",
     .name = "ballistic-symmetry",
     .title = "Motion runs backwards",
     .setup = "A body on a stiffening spring under gravity, turning (in space with three different "
              "moments and the update that keeps momentum), and a ball that bounces without loss "
              "on a floor: 1000 steps, then all velocities reversed, and 1000 steps again.",
     .reference = {"back at the start, with the velocities reversed"},
     .compared = "Place, orientation, velocity and spin with those of the start.",
     .kind = Class::R,
     .why = "Half a step of motion, a change of velocity, half a step of motion: the same read "
            "backwards. A bounce without loss reverses the velocity at one place. Rounding grows "
            "with the number of steps.",
     .source = "Time symmetry of the midpoint scheme; derived here.",
     .catches = {Fault::force_at_begin, Fault::end_point_drift, Fault::restitution_weight}},
    run<2>, run<3>, __FILE__);

}  // namespace E17
}  // namespace validation
