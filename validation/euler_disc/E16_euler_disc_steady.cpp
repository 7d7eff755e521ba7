// SPDX-License-Identifier: BSL-1.0
#include <map>

#include "harness/case.hpp"

namespace validation {
namespace E16 {

constexpr double radius = 0.1, tilted = 20 * degree, mass = 0.3, mu = 0.5;
constexpr int turns = 5;
const double om = std::sqrt(4 * g / (radius * std::sin(tilted)));
const double turn = 2 * pi / om;  ///< of the contact point about the floor [s]

/// The disc leans down towards the first axis and turns about the diameter through its contact.
World<3> disc(Trial<3>& trial, double h, talus::Gyroscopic option) {
    auto world = trial.world({.h = h,
                              .contact = law<3>(mu),
                              .step = {.contact_tolerance = touching, .gyroscopic = option}});
    world.add_floor();
    const auto lean = talus::Rotation<3>::exp(V<3>(0, tilted, 0));
    const V<3> to_contact = lean * V<3>(1, 0, 0);
    const double transverse = mass * radius * radius / 4;
    world.add(Rim{radius}, talus::Inertia<3>{mass, transverse * V<3>(1, 1, 2)},
              {radius * std::sin(tilted) * up<3>(), lean},
              {V<3>::Zero(), -om * std::sin(tilted) * to_contact});
    return world;
}

/// How far the disc is from the steady motion during five turns.
struct Rolling {
    double drift = 0.0;     ///< of the centre, largest [m]
    double tilt = 0.0;      ///< off 20 degrees, largest [rad]
    double phase = 0.0;     ///< of the axis about the vertical, at the end [rad]
    double slip = 0.0;      ///< largest [m/s]
    double friction = 0.0;  ///< by weight, mean
    double normal = 0.0;    ///< by weight, largest deviation from 1 after the first step
    Series tilts{"measured", {}, {}}, normals{"measured", {}, {}};
};

Rolling roll(Trial<3>& trial, double h, talus::Gyroscopic option) {
    auto world = disc(trial, h, option);
    const V<3> start = world.bodies().position[1];
    Rolling seen;
    double count = 0.0, azimuth = 0.0, before = 0.0;
    world.run(turns * turn, [&](const auto& w) {
        const auto& bodies = w.bodies();
        const V<3> axis = bodies.rotation[1] * V<3>(0, 0, 1);
        const double tilt = std::atan2(axis.head<2>().norm(), axis[2]);
        const double now = std::atan2(axis[1], axis[0]);
        azimuth += std::remainder(now - before, 2 * pi);
        before = now;
        seen.drift = std::max(seen.drift, (bodies.position[1] - start).norm());
        seen.tilt = std::max(seen.tilt, std::abs(tilt - tilted));
        for (std::size_t c = 0; c < w.data().contact_count(); ++c)
            seen.slip = std::max(seen.slip, end_velocity(w.data(), c).template tail<2>().norm());
        const V<3> r = impulse_on(w.data(), 1);
        const double normal = r[2] / (mass * g * h);
        seen.friction += r.head<2>().norm() / (mass * g * h);
        // The first step sees half of the contact's way along the rim. No mean here: the sum of
        // the normal impulses says no more than that the disc ends without falling or rising.
        if (count > 0.0) {
            seen.normal = std::max(seen.normal, std::abs(normal - 1));
            seen.normals.x.push_back(w.time() / turn), seen.normals.y.push_back(normal);
        }
        ++count;
        seen.tilts.x.push_back(w.time() / turn), seen.tilts.y.push_back(tilt / degree);
    });
    seen.phase = azimuth - om * world.time();
    seen.friction /= count;
    return seen;
}

void run(Trial<3>& trial) {
    trial.within("reference, rate of precession", om, 33.871830, 5e-7, "digits given");
    // Newton and Euler at the start: the moment of the floor's reaction m g turns the momentum.
    const double momentum = mass * radius * radius / 4 * om * std::sin(tilted);
    trial.within("reference, moment of the reaction", mass * g * radius * std::cos(tilted),
                 om * momentum * std::cos(tilted), 1e-15, "equations of motion");
    using talus::Gyroscopic;
    for (const auto option : {Gyroscopic::explicit_term, Gyroscopic::momentum_preserving}) {
        const std::string name =
            option == Gyroscopic::explicit_term ? ", explicit term" : ", momentum kept";
        const double h = turn / 1000;
        const Rolling seen = roll(trial, h, option);
        trial.rounding("slip" + name, seen.slip, 0.0, 10.0, h);
        trial.curves({"tilt" + name,
                      "turns",
                      "α [deg]",
                      {seen.tilts, {"exact", {0.0, turns}, {20.0, 20.0}, true}}});
        trial.curves({"normal force by weight" + name,
                      "turns",
                      "N / (m g)",
                      {seen.normals, {"exact", {0.0, turns}, {1.0, 1.0}, true}}});
        std::map<double, Rolling> rolled;  // by step size
        const auto order = [&](const std::string& what, double Rolling::*error) {
            trial.order(
                what + name, halvings(turn / 500, 5),
                [&](double step) {
                    auto at = rolled.find(step);
                    if (at == rolled.end())
                        at = rolled.emplace(step, roll(trial, step, option)).first;
                    return at->second.*error;
                },
                first_order);
        };
        order("drift of the centre", &Rolling::drift);
        order("tilt", &Rolling::tilt);
        order("phase after five turns", &Rolling::phase);
        order("mean friction by weight", &Rolling::friction);
        order("normal force by weight, worst of all steps", &Rolling::normal);
    }
}

const Register e16(
    {.id = "E16",
     .name = "euler-disc-steady",
     .title = "A thin disc rolls around, its centre at rest",
     .setup = "A thin disc of 0.1 m radius leans at 20 degrees to a floor with friction 0.5 and "
              "rolls without slipping so that its centre stays where it is, for five turns of the "
              "contact point; with both updates of the gyroscopic term.",
     .reference = {"spin Ω sin α along the diameter through the contact",
                   "Ω^2 = frac{4 g}{R sin α}, Ω = 33.8718 rad/s", "N = m g, no friction"},
     .compared = "Slip at every step; the orders of the centre's drift, of the tilt, of the phase "
                 "of the precession, of the mean friction and of the normal force's largest "
                 "deviation from the weight, all of which vanish with h.",
     .kind = Class::D1,
     .why = "The contact is taken at the midpoint while it runs along the rim: first order. The "
            "law of the disc's final whirl needs rolling resistance and is not compared. The "
            "moment of the reaction points along a horizontal diameter, where an inertia tensor "
            "that was not turned with the disc is right too: E18 looks for that mistake.",
     .source = "Moffatt 2000; Kessler and O'Reilly 2002.",
     .catches = {Fault::begin_point, Fault::short_arm}},
    nullptr, run, __FILE__);

}  // namespace E16
}  // namespace validation
