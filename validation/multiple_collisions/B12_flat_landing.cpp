// SPDX-License-Identifier: BSL-1.0
#include <Eigen/Core>

#include "multiple_collisions.hpp"

namespace validation {
namespace B12 {

constexpr double m = 1.7, v = 1.0;

template <int Dim>
V<Dim> half() {
    V<Dim> result = V<Dim>::Constant(0.3);
    result[0] = 0.4;
    result[Dim - 1] = 0.2;
    return result;
}

template <int Dim>
World<Dim> landing(Trial<Dim>& trial, double mu, double e) {
    auto world = trial.world(collision_params<Dim>(law<Dim>(mu, e, e)));
    world.add_floor();
    world.add(talus::Box<Dim>(half<Dim>()), box_inertia<Dim>(m, half<Dim>()),
              {(half<Dim>()[Dim - 1] + 0.5 * collision_h * v) * up<Dim>(), {}}, {-v * up<Dim>()});
    return world;
}

/// In the plane: how many combinations of statuses, and do all have the same velocity?
void enumerate(Trial<2>& trial, double mu, double e, const std::string& name) {
    PlanarBody box(m, m / 3 * half<2>().squaredNorm());
    for (const double side : {-1.0, 1.0})
        box.touch({side * half<2>()[0], -half<2>()[1]}, {0, 1}, mu);
    const Eigen::Vector3d begin(0, -v, 0), no_load = Eigen::Vector3d::Zero();
    const Enumeration all(box.problem(begin, no_load, e, e));
    trial.holds("reference, " + std::string(mu > 0.0 ? "7 combinations" : "1 combination") +
                    " of statuses, " + name,
                all.solutions().size() == (mu > 0.0 ? 7u : 1u),
                std::to_string(all.solutions().size()) + " found");
    Worst worst;
    for (const auto& s : all.solutions())
        worst.see(Eigen::Vector3d(box.end(begin, no_load, s.r)), Eigen::Vector3d(-e * begin));
    trial.rounding("reference, velocity of all of them, " + name, worst, 10 * v);
}

template <int Dim>
void run(Trial<Dim>& trial) {
    for (const double mu : {0.0, 0.5}) {
        Series up_again{"computed", {}, {}}, exact{"e v", {0, 1}, {0, v}, true};
        Series push{"computed", {}, {}},
            push_exact{"(1 + e) m v", {0, 1}, {m * v, 2 * m * v}, true};
        for (int k = 0; k <= 10; ++k) {
            const double e = 0.1 * k;
            auto world = landing<Dim>(trial, mu, e);
            const auto& data = world.step();
            // Floor and box are the two bodies; the impulses are what the box receives.
            V<Dim> sum = V<Dim>::Zero();
            W<Dim> moments = W<Dim>::Zero();
            for (std::size_t c = 0; c < data.contact_count(); ++c) {
                const V<Dim> r = impulse_on<Dim>(data, 1, c);
                const V<Dim> normal = r.dot(up<Dim>()) * up<Dim>();
                sum += r;
                moments += talus::moment<Dim>(
                    data.contacts.point[c] - half<Dim>()[Dim - 1] * up<Dim>(), normal);
            }
            up_again.x.push_back(e);
            up_again.y.push_back(world.bodies().velocity[1][Dim - 1]);
            push.x.push_back(e);
            push.y.push_back(sum[Dim - 1]);
            if (k % 5 != 0) continue;
            const std::string name = "mu = " + std::to_string(mu) + ", e = " + std::to_string(e);
            const double tolerance = world.params().solver.tolerance;
            if constexpr (Dim == 2) enumerate(trial, mu, e, name);
            trial.holds("lands on all corners, " + name, data.contact_count() == 1 << (Dim - 1));
            trial.holds("the solver arrives, " + name,
                        data.report.status == talus::SolveStatus::converged);
            trial.solver("velocity, " + name, world.bodies().velocity[1], V<Dim>(e * v * up<Dim>()),
                         v, tolerance);
            trial.solver("spin [1/s], " + name, world.bodies().spin[1], W<Dim>(W<Dim>::Zero()),
                         v / half<Dim>()[Dim - 1], tolerance);
            trial.solver("sum of impulses [N s], " + name, sum, V<Dim>((1 + e) * m * v * up<Dim>()),
                         2 * m * v, tolerance);
            trial.solver("first moments of normal impulses [N m s], " + name, moments,
                         W<Dim>(W<Dim>::Zero()), 2 * m * v, tolerance);
        }
        const std::string name = ", mu = " + std::to_string(mu);
        trial.curves({"velocity after" + name, "e", "v [m/s]", {up_again, exact}});
        trial.curves({"sum of impulses" + name, "e", "P [N s]", {push, push_exact}});
    }
}

const Register b12(
    {.id = "B12",
     .name = "flat-landing",
     .title = "A box lands on all its corners at once",
     .gate = 2,
     .setup = "A box of 0.8 × 0.4 m (0.8 × 0.6 × 0.4 m) and 1.7 kg falls flat on the floor at "
              "1 m/s; friction 0 and 0.5, restitution 0 to 1 in all directions.",
     .reference = {"v_{end} = e v upwards, no spin", "Σ P_N = (1 + e) m v,  Σ x × P_N = 0"},
     .compared = "Velocity, spin, the sum of the impulses and the first moments of their normal "
                 "parts. Not the single impulses: four corners in space have a Delassus matrix of "
                 "rank 3 in their normals, and friction may hold corners against each other. In "
                 "the plane the enumeration finds one combination of statuses without friction "
                 "and seven with it, all with this velocity.",
     .kind = Class::S,
     .why = "What is compared is unique although the impulses are not, and the solver must "
            "converge in spite of the singular matrix.",
     .source = "Balance of momentum.",
     .catches = {Fault::restitution_weight, Fault::reaction_lost}},
    run<2>, run<3>, __FILE__);

}  // namespace B12
}  // namespace validation
