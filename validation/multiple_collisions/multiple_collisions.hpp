// SPDX-License-Identifier: BSL-1.0
#pragma once

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

    Eigen::MatrixXd g() const {
        Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(contacts.size()),
                                                     Dim * static_cast<Eigen::Index>(mass.size()));
        for (std::size_t c = 0; c < contacts.size(); ++c) {
            const auto row = static_cast<Eigen::Index>(c);
            if (contacts[c].a != wall)
                rows.template block<1, Dim>(row, Dim * contacts[c].a) += contacts[c].normal;
            if (contacts[c].b != wall)
                rows.template block<1, Dim>(row, Dim * contacts[c].b) -= contacts[c].normal;
        }
        return rows;
    }
    Eigen::VectorXd inverse_mass() const {
        Eigen::VectorXd result(Dim * static_cast<Eigen::Index>(mass.size()));
        for (std::size_t i = 0; i < mass.size(); ++i)
            result.segment<Dim>(Dim * static_cast<Eigen::Index>(i)).setConstant(1.0 / mass[i]);
        return result;
    }
    Eigen::VectorXd begin() const {
        Eigen::VectorXd result(Dim * static_cast<Eigen::Index>(mass.size()));
        for (std::size_t i = 0; i < mass.size(); ++i)
            result.segment<Dim>(Dim * static_cast<Eigen::Index>(i)) = velocity[i];
        return result;
    }
    Eigen::MatrixXd delassus() const { return g() * inverse_mass().asDiagonal() * g().transpose(); }
    Eigen::VectorXd restitution() const {
        Eigen::VectorXd e(static_cast<Eigen::Index>(contacts.size()));
        for (Eigen::Index c = 0; c < e.size(); ++c) e[c] = contacts[static_cast<std::size_t>(c)].e;
        return e;
    }

    /// Moreau: 0 <= e u_begin + u_end complementary to r >= 0.
    Result moreau() const {
        const Eigen::VectorXd u = g() * begin();
        return after_complementarity(u + restitution().cwiseProduct(u), 0.0 * u);
    }
    /// Poisson: compression (soft); then expansion with e times its impulses at least.
    Result poisson() const {
        const Eigen::VectorXd u = g() * begin(), none = 0.0 * u;
        const Eigen::VectorXd compression = after_complementarity(u, none).impulse;
        const Eigen::VectorXd least = restitution().cwiseProduct(compression);
        const Eigen::VectorXd kept = compression + least;
        return after_complementarity(u + delassus() * kept, kept);
    }
    /// Newton: u_end = -e u_begin as an equation at all contacts.
    Result newton() const {
        const Eigen::VectorXd u = g() * begin();
        return with(delassus().ldlt().solve(-u - restitution().cwiseProduct(u)), true);
    }

  private:
    Result after_complementarity(const Eigen::VectorXd& b, const Eigen::VectorXd& before) const {
        const Enumeration all(frictionless(delassus(), b));
        if (all.velocities().size() != 1) throw std::logic_error("a projection is unique");
        const PlanarSolution& s = all.solutions().front();
        return with(before + normal_part(s.r), s.unique_impulses);
    }
    Result with(const Eigen::VectorXd& impulse, bool unique) const {
        const Eigen::VectorXd end =
            begin() + inverse_mass().asDiagonal() * (g().transpose() * impulse);
        Result result{{}, impulse, unique};
        for (std::size_t i = 0; i < mass.size(); ++i)
            result.velocity.push_back(end.segment<Dim>(Dim * static_cast<Eigen::Index>(i)));
        return result;
    }
};

}  // namespace validation
