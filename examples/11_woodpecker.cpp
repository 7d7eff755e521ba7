// SPDX-License-Identifier: BSL-1.0
//
// A machine in coordinates of its own: the woodpecker toy. A sleeve with play slides down a pole
// and carries a bird by a spring; impacts and friction make it peck. Contacts are given as gaps and
// tangential displacements, and differentiated by talus.
//
// Sample run:  examples/run 11_woodpecker
#include <talus/lagrangian/simulation.hpp>

#include <Eigen/Core>

#include <cstdio>

struct Woodpecker {
    static constexpr int dof = 3;  // height of the sleeve, its angle, that of the bird

    double bird = 0.0045, sleeve = 0.0003;            // masses [kg]
    double bird_moment = 7e-7, sleeve_moment = 5e-9;  // [kg m^2]
    double spring = 0.0056, g = 9.81;                 // [N m/rad], [m/s^2]
    double to_spring = 0.010, to_bird = 0.015;        // lengths [m]
    double to_beak = 0.0201, beak_height = 0.020, sleeve_height = 0.0058;
    double sleeve_radius = 0.0031, pole_radius = 0.0025;
    talus::Coulomb<2> friction{.mu = 0.3};

    void mass(double, const auto&, auto& a) const {
        const double m = bird, l = to_spring, b = to_bird;
        a << m + sleeve, m * l, m * b,                    //
            m * l, sleeve_moment + m * l * l, m * l * b,  //
            m * b, m * l * b, bird_moment + m * b * b;
    }
    void force(double, const auto& q, const auto&, auto& f) const {
        const double moment = spring * (q[1] - q[2]);
        f << -(bird + sleeve) * g, -moment - bird * g * to_spring, moment - bird * g * to_bird;
    }
    void gaps(const auto&, const auto& q, auto& contacts) const {
        const double play = sleeve_radius - pole_radius, reach = to_spring + to_bird - to_beak;
        contacts.add(reach - pole_radius - beak_height * q[2], {friction, 0.5}, "beak").slide[0] =
            q[0] + to_spring * q[1] + (to_bird - to_beak) * q[2];
        for (const double side : {1.0, -1.0})
            contacts.add(play + side * sleeve_height * q[1], {friction}, "sleeve").slide[0] =
                q[0] + sleeve_radius * q[1];
    }
};

int main() {
    talus::LagrangianSimulation toy(Woodpecker{}, Eigen::Vector3d(0.0, -0.1036, -0.2788),
                                    Eigen::Vector3d(-0.3411, 0.0, -7.4583), 0.0, {.h = 2e-5});
    talus::LagrangianSummary run = toy.run(3.0);  // until it pecks in rhythm

    int pecks = 0;
    double first = 0.0, last = 0.0, height = 0.0, drop = 0.0;
    run.add(toy.run(1.6, [&](const auto& now) {
        if (now.data().impulse_at(0)[0] == 0.0 || now.time() < last + 0.05) return;
        last = now.time();
        if (pecks++ == 0) first = last, height = now.position()[0];
        drop = height - now.position()[0];
    }));
    std::printf("%d pecks, one each %.4f s, %.2f mm lower each time\n    %s\n", pecks,
                (last - first) / (pecks - 1), 1e3 * drop / (pecks - 1), to_string(run).c_str());
}
