// SPDX-License-Identifier: BSL-1.0
#include <Eigen/Core>

#include "harness/enumeration.hpp"
#include "rocking_block.hpp"

namespace validation {
namespace B18 {

constexpr double h = 1e-3, spin = 1.0;

/// Friction that the impact needs if the new corner is not to slip.
double needed_friction(const RockingBlock& block) {
    const double s = std::sin(block.slenderness()), c = std::cos(block.slenderness());
    return 3 * s * c / (1 + 3 * c * c);
}

/// Velocity of the centre when the block turns about its right corner and lies flat.
Eigen::Vector2d velocity_before(const RockingBlock& block) {
    return {-spin * block.height, -spin * block.b};
}

/// Reference: (v, w) after the impact, over all combinations of statuses.
Eigen::Vector3d enumerated(TrialRecord& trial, const RockingBlock& block, double mu, double e,
                           const std::string& name, std::string& statuses) {
    PlanarBody body(block.mass, block.inertia());
    for (const double side : {-1.0, 1.0}) body.touch({side * block.b, -block.height}, {0, 1}, mu);
    const Eigen::Vector2d v = velocity_before(block);
    const Eigen::Vector3d begin(v[0], v[1], spin), no_load = Eigen::Vector3d::Zero();
    const Enumeration all(body.problem(begin, no_load, e, e));
    trial.holds("reference, one velocity, " + name, all.velocities().size() == 1);
    for (const auto& s : all.solutions()) statuses += (statuses.empty() ? "" : ", ") + s.status;
    return body.end(begin, no_load, all.solutions().at(0).r);
}

/// The world whose midpoint has the block flat on the floor.
template <int Dim>
World<Dim> impact(Trial<Dim>& trial, const RockingBlock& block, double mu, double e) {
    // Where friction just suffices, Gauss-Seidel takes its time.
    auto world = trial.world({.h = h,
                              .contact = law<Dim>(mu, e, e),
                              .gravity = V<Dim>::Zero(),
                              .solver = {.max_sweeps = 200000, .tolerance = 1e-14}});
    world.add_floor();
    const Eigen::Vector2d before = velocity_before(block);
    const V<Dim> v = in_plane<Dim>(before[0], before[1]);
    block.add<Dim>(world, V<Dim>(block.height * up<Dim>() - 0.5 * h * v), -0.5 * h * spin,
                   {v, rolling_spin<Dim>(-spin)});
    return world;
}

template <int Dim>
void compare(Trial<Dim>& trial, const RockingBlock& block, double mu, double e, double ratio,
             const std::string& name) {
    std::string statuses;
    const Eigen::Vector3d exact = enumerated(trial, block, mu, e, name, statuses);
    trial.rounding("reference, ratio by enumeration, " + name, exact[2] / spin, ratio, 10.0);
    auto world = impact<Dim>(trial, block, mu, e);
    const auto& data = world.step();
    trial.holds("lands on all corners, " + name, data.contact_count() == 1 << (Dim - 1));
    const auto twist = world.bodies().twist(1);
    // Coordinates of corners of up to 1 m, spins of 1/s.
    trial.rounding("ratio of spins, " + name, tilting_spin<Dim>(twist) / spin, ratio, 10.0);
    trial.rounding("spin [1/s], " + name, twist.angular, W<Dim>(rolling_spin<Dim>(-exact[2])),
                   10.0 * spin);
    trial.rounding("velocity, " + name, twist.linear, in_plane<Dim>(exact[0], exact[1]), 10.0);

    double left = 0.0, right = 0.0, opening = 1e9;
    for (std::size_t c = 0; c < data.contact_count(); ++c) {
        const bool is_right = data.contacts.point[c][0] > 0.0;
        (is_right ? right : left) += impulse_on<Dim>(data, 1, c)[Dim - 1];
        if (is_right) opening = std::min(opening, end_velocity<Dim>(data, c)[0]);
    }
    if (ratio > 0.0) {
        trial.holds("the new corner takes the impulse, " + name, left > 0.1 * block.mass * block.b);
        trial.rounding("impulse at the old corner, " + name, right, 0.0, 10.0);
        trial.rounding("the old corner opens [m/s], " + name, opening,
                       2 * block.b * (e + ratio) * spin, 10.0);
    }
    trial.note(name + ": statuses (left, right corner) " + statuses + ".");
}

template <int Dim>
void run(Trial<Dim>& trial) {
    const double catalogue[3][4] = {{0.25, 0.911764706, 0.184615385, 0.888243},
                                    {0.625, 0.578651685, 0.427046263, 0.510023},
                                    {1.0, 0.25, 0.6, 0.183432}};
    for (const auto& [slope, ratio, friction, slipping] : catalogue) {
        const RockingBlock block{0.4 * slope, 0.4};
        const std::string name = "b/H = " + std::to_string(slope);
        const double needed = needed_friction(block);
        trial.within("reference, ratio, " + name, block.housner(), ratio, 6e-10,
                     "digits of the catalogue");
        trial.within("reference, friction needed, " + name, needed, friction, 6e-10,
                     "digits of the catalogue");
        compare<Dim>(trial, block, 2.0, 0.0, block.housner(), name + ", mu = 2");
        compare<Dim>(trial, block, 1.001 * needed, 0.0, block.housner(),
                     name + ", friction just enough");
        // Slip at the new pivot: P_T = mu P_N there, and its normal velocity is zero.
        const double mu = 0.9 * needed;
        const double b = block.b, height = block.height, i = block.inertia() / block.mass;
        const double p = 2 * b * spin / (1 + b * (b - mu * height) / i);
        const double after = spin - (b - mu * height) * p / i;
        trial.within("reference, ratio when slipping, " + name, after / spin, slipping, 6e-7,
                     "digits of the catalogue");
        compare<Dim>(trial, block, mu, 0.0, after / spin, name + ", too little friction");
    }
    const RockingBlock slender{0.1, 0.4}, broad{0.6, 0.4};
    const double bouncing = -0.3 + 1.3 * slender.housner();
    trial.within("reference, ratio with e = 0.3", bouncing, 0.885294118, 6e-10,
                 "digits of the catalogue");
    // With e > 0 the old corner, at rest before, opens as well.
    compare<Dim>(trial, slender, 2.0, 0.3, bouncing, "b/H = 0.25, e = 0.3");
    compare<Dim>(trial, broad, 2.0, 0.0, 0.0, "b/H = 1.5, both corners stay");

    Series seen{"computed", {}, {}}, exact{"max(0, 1 − (3/2) sin^2 α)", {}, {}, true};
    for (int k = 1; k <= 40; ++k) {
        const RockingBlock block{0.4 * 0.05 * k, 0.4};
        auto world = impact<Dim>(trial, block, 2.0, 0.0);
        world.step();
        seen.x.push_back(0.05 * k);
        seen.y.push_back(tilting_spin<Dim>(world.bodies().twist(1)) / spin);
        exact.x.push_back(0.05 * k);
        exact.y.push_back(std::max(0.0, block.housner()));
    }
    trial.curves({"spin after the impact, mu = 2", "b / H", "w_+ / w_-", {seen, exact}});
}

const Register b18(
    {.id = "B18",
     .name = "rocking-impact-housner",
     .title = "A rocking block lands",
     .gate = 2,
     .setup = "A block of half width b and half height H = 0.4 m turns about its right lower "
              "corner at 1/s and lands flat; b/H = 0.25, 0.625, 1 and 1.5. Soft with friction 2, "
              "with 1.001 and with 0.9 times the friction needed; once with restitution 0.3 in "
              "all directions. In space a prism with edges in place of corners.",
     .reference = {"frac{w_+}{w_-} = r = 1 − frac{3}{2} sin^2 α,  tan α = b/H; 0 where r < 0",
                   "needs μ ≥ frac{3 sin α cos α}{1 + 3 cos^2 α}; below that the new corner slips",
                   "with restitution e in all directions: −e + (1 + e) r"},
     .compared = "Spin and velocity after the impact, the impulse at the old corner (zero) and the "
                 "velocity at which it opens; all with an enumeration of the statuses as well, "
                 "which shows that the solution is unique.",
     .kind = Class::R,
     .why = "One step at the flat geometry. The soft law finds by itself that the old corner opens "
            "without an impulse.",
     .source = "Housner 1963; Moreau 1988.",
     .catches = {Fault::friction_off, Fault::short_arm, Fault::restitution_weight}},
    run<2>, run<3>, __FILE__);

}  // namespace B18
}  // namespace validation
