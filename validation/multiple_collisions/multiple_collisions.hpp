// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>

#include <stdexcept>
#include <vector>

#include "harness/case.hpp"
#include "harness/enumeration.hpp"

/// Collisions of several bodies within one step, without forces.
namespace validation {

inline constexpr double collision_h = 1e-3;

template <int Dim>
WorldParams<Dim> collision_params(const Law<Dim>& contact) {
    return {.h = collision_h, .contact = contact, .gravity = V<Dim>::Zero()};
}

/// Adds a ball that the midpoint of the first step finds at `place`.
template <int Dim>
talus::BodyIndex add_ball(World<Dim>& world, double mass, double radius, const V<Dim>& place,
                          const V<Dim>& velocity, talus::MaterialIndex material = 0) {
    return world.add(talus::Ball<Dim>(radius), round_inertia<Dim>(mass, radius),
                     {place - 0.5 * world.params().h * velocity, {}}, {velocity}, material);
}

/// A direction of no special position.
template <int Dim>
V<Dim> slanted() {
    if constexpr (Dim == 2)
        return {0.6, 0.8};
    else
        return {0.48, 0.64, 0.6};
}

/// Reference: a collision of bodies that do not turn, without friction, by enumeration.
template <int Dim>
struct PointCollision {
    static constexpr int wall = -1;
    struct Contact {
        int a, b;       ///< bodies, or the wall
        V<Dim> normal;  ///< towards a
        double e = 0.0;
    };
    struct Result {
        std::vector<V<Dim>> velocity;
        Eigen::VectorXd impulse;
        bool unique_impulses;
    };

    std::vector<double> mass;
    std::vector<V<Dim>> velocity;
    std::vector<Contact> contacts;

    Eigen::MatrixXd g() const;
    Eigen::VectorXd inverse_mass() const;
    Eigen::VectorXd begin() const;
    Eigen::MatrixXd delassus() const;
    Eigen::VectorXd restitution() const;

    /// Moreau: 0 <= e u_begin + u_end complementary to r >= 0.
    Result moreau() const;
    /// Poisson: compression (soft); then expansion with e times its impulses at least.
    Result poisson() const;
    /// Newton: u_end = -e u_begin as an equation at all contacts.
    Result newton() const;

  private:
    Result after_complementarity(const Eigen::VectorXd& b, const Eigen::VectorXd& before) const;
    Result with(const Eigen::VectorXd& impulse, bool unique) const;
};

// Compiled in point_collision.cpp.
extern template struct PointCollision<2>;
extern template struct PointCollision<3>;

}  // namespace validation
