// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <vector>

#include "multiple_collisions.hpp"

/// Balls on a line: Newton's cradle without its strings.
namespace validation {

struct Cradle {
    std::vector<double> mass, before;  ///< [kg], velocities along the line [m/s]
    std::vector<double> e;             ///< of each contact
    double gap = 0.0;                  ///< between neighbours [m]

    static constexpr double radius = 0.1;

    std::size_t count() const { return mass.size(); }
    /// n equal balls, the first with 1 m/s.
    static Cradle equal(std::size_t n, double e) {
        Cradle cradle{std::vector<double>(n, 1.0), std::vector<double>(n, 0.0),
                      std::vector<double>(n - 1, e)};
        cradle.before[0] = 1.0;
        return cradle;
    }

    /// The balls are where they should be at the midpoint of the first step or, if gapped, at its
    /// beginning.
    template <int Dim>
    World<Dim> make(Trial<Dim>& trial) const {
        // A material for each ball: every contact has its own restitution.
        talus::MaterialTable<Law<Dim>> laws(static_cast<int>(count()), law<Dim>(0.0));
        for (std::size_t c = 0; c + 1 < count(); ++c)
            laws.set(static_cast<talus::MaterialIndex>(c), static_cast<talus::MaterialIndex>(c + 1),
                     law<Dim>(0.0, e[c]));
        auto world = trial.world(collision_params<Dim>(law<Dim>(0.0)), laws);
        for (std::size_t i = 0; i < count(); ++i) {
            V<Dim> place = (2 * radius + gap) * static_cast<double>(i) * slanted<Dim>();
            const V<Dim> velocity = before[i] * slanted<Dim>();
            if (gap > 0.0) place += 0.5 * world.params().h * velocity;
            add_ball<Dim>(world, mass[i], radius, place, velocity,
                          static_cast<talus::MaterialIndex>(i));
        }
        return world;
    }
    template <int Dim>
    PointCollision<Dim> reference() const {
        PointCollision<Dim> collision{mass, {}, {}};
        for (const double v : before) collision.velocity.push_back(v * slanted<Dim>());
        for (std::size_t c = 0; c + 1 < count(); ++c)
            collision.contacts.push_back(
                {static_cast<int>(c + 1), static_cast<int>(c), slanted<Dim>(), e[c]});
        return collision;
    }
};

/// Velocities along the line as vectors.
template <int Dim>
std::vector<V<Dim>> along_line(const std::vector<double>& v) {
    std::vector<V<Dim>> result;
    for (const double x : v) result.push_back(x * slanted<Dim>());
    return result;
}

}  // namespace validation
