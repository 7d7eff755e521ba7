// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/lagrangian/concepts.hpp>

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

/// One system for all that a body in the plane does on a floor.
namespace machines {

using Three = Eigen::Vector3d;
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Coordinates of the centre and angle; corners, fixed to the body, meet the floor y = 0.
struct PlanarBody {
    static constexpr int dof = 3;
    double mu = 0.0, restitution = 0.0;
    std::vector<Eigen::Vector2d> corners = {{0.0, 0.0}};
    Eigen::Vector2d gravity = {0.0, -9.81};
    double inertia = 1.0 / 12.0;                           // the mass is 1 kg
    Eigen::Vector2d rise = {0.0, 0.0};                     // of a force, per second
    double stiffness = 0.0, shake = 0.0, frequency = 0.0;  // of a spring and a force along y
    double spoilt_from = std::numeric_limits<double>::infinity();

    static PlanarBody rod(double mu, double restitution) {
        PlanarBody body;
        body.mu = mu;
        body.restitution = restitution;
        body.corners = {{-0.5, 0.0}, {0.5, 0.0}};
        return body;
    }
    void mass(double, const auto&, auto& a) const { a.diagonal() << 1.0, 1.0, inertia; }
    void force(double t, const auto& q, const auto&, auto& f) const {
        f.template head<2>() = gravity + t * rise;
        f[1] += shake * std::cos(frequency * t) - stiffness * q[1];
        if (t >= spoilt_from) f[0] = nan;
    }
    void contacts(double, const auto& q, auto& contacts) const {
        const double c = std::cos(q[2]), s = std::sin(q[2]);
        for (const Eigen::Vector2d& p : corners) {
            auto& contact =
                contacts.add(q[1] + s * p[0] + c * p[1], {{mu}, restitution, 0.0}, "corner");
            contact.rows << 0.0, 1.0, c * p[0] - s * p[1], 1.0, 0.0, -s * p[0] - c * p[1];
        }
    }
    double energy(const Three& q, const Three& u) const {
        return 0.5 * (u[0] * u[0] + u[1] * u[1] + inertia * u[2] * u[2]) - gravity.dot(q.head<2>());
    }
};

/// Painleve's rod of unit mass and length: its first end on the floor at an angle, the rest to the
/// right of it; `slide` is the velocity of that end.
struct SlidingRod {
    PlanarBody body;
    Three q, u;

    SlidingRod(double angle, double mu, double slide, double spin)
        : body(PlanarBody::rod(mu, 0.0)) {
        body.corners.resize(1);
        const double c = 0.5 * std::cos(angle), s = 0.5 * std::sin(angle);
        q << c, s, angle;
        u << slide - s * spin, c * spin, spin;
    }
};

}  // namespace machines
