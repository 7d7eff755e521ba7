// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/lagrangian/simulation.hpp>

#include <Eigen/Core>

#include <cmath>
#include <cstddef>

/// Systems that several tests make.
namespace machines {

inline constexpr double g = 9.81;
using Angle = Eigen::Vector<double, 1>;
using Two = Eigen::Vector2d;
using PlaneLaw = talus::WeightedMean<2, talus::Coulomb<2>>;

/// Two masses of 1 kg on two massless rods of 1 m, angles from the vertical; the outer one may meet
/// a wall x = `wall` from the left, which moves with `wall_speed`.
struct DoublePendulum {
    static constexpr int dof = 2;
    double gravity = g, wall = 1e9, wall_speed = 0.0;
    PlaneLaw law = {};

    void mass(double, const auto& q, auto& a) const {
        const double c = std::cos(q[0] - q[1]);
        a << 2.0, c, c, 1.0;
    }
    void force(double, const auto& q, const auto& u, auto& f) const {
        const double s = std::sin(q[0] - q[1]);
        f << -s * u[1] * u[1] - 2.0 * gravity * std::sin(q[0]),
            s * u[0] * u[0] - gravity * std::sin(q[1]);
    }
    void gaps(const auto& t, const auto& q, auto& contacts) const {
        contacts.add(wall + wall_speed * t - sin(q[0]) - sin(q[1]), law, "wall").slide[0] =
            -cos(q[0]) - cos(q[1]);
    }
    double energy(const Two& q, const Two& u) const {
        return u[0] * u[0] + 0.5 * u[1] * u[1] + std::cos(q[0] - q[1]) * u[0] * u[1] -
               gravity * (2.0 * std::cos(q[0]) + std::cos(q[1]));
    }
};

/// A bead on a circular wire of 1 m that turns about its vertical diameter.
struct BeadOnHoop {
    static constexpr int dof = 1;
    double turning = 5.0;  ///< [rad/s]

    void mass(double, const auto&, auto& a) const { a << 1.0; }
    void force(double, const auto& q, const auto&, auto& f) const {
        f << (turning * turning * std::cos(q[0]) - g) * std::sin(q[0]);
    }
    void contacts(double, const auto&, auto&) const {}
};

/// Blocks one above the other, in heights of their underside above the floor: a stack.
struct Stack {
    static constexpr int dof = Eigen::Dynamic;
    double restitution = 0.0;

    void mass(double, const auto& q, auto& a) const {
        for (Eigen::Index i = 0; i < q.size(); ++i) a(i, i) = 1.0;
    }
    void force(double, const auto& q, const auto&, auto& f) const {
        for (Eigen::Index i = 0; i < q.size(); ++i) f[i] = -g;
    }
    void contacts(double, const auto& q, auto& contacts) const {
        for (Eigen::Index i = 0; i < q.size(); ++i) {
            auto& c =
                contacts.add(i == 0 ? q[0] : q[i] - q[i - 1] - 0.1, PlaneLaw{{}, restitution, 0.0});
            c.rows(0, i) = 1.0;
            if (i > 0) c.rows(0, i - 1) = -1.0;
        }
    }
};

/// The same by gaps alone.
struct StackByGaps : Stack {
    void contacts(double, const auto&, auto&) const = delete;
    void gaps(const auto&, const auto& q, auto& contacts) const {
        for (Eigen::Index i = 0; i < q.size(); ++i) {
            auto gap = q[i];
            if (i > 0) gap -= q[i - 1] + 0.1;
            contacts.add(gap, PlaneLaw{{}, restitution, 0.0});
        }
    }
};

}  // namespace machines
