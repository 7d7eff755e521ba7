// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <vector>

#include "harness/case.hpp"

namespace validation {

/// A gas of smooth discs (spheres) of diameter 1 m and mass 1 kg without gravity, in a box of
/// smooth elastic walls. They start on a lattice at the same speed, in random directions, so that
/// all components of velocity have the temperature 1 (mean square, [m^2/s^2]): no Maxwellian.
template <int Dim>
struct Gas {
    int across;          ///< balls along an axis
    double solid;        ///< part of the box that is solid
    double restitution;  ///< between balls
    double way = 0.02;   ///< of a ball at the mean speed in a step, in diameters

    static constexpr std::size_t walls = 2 * Dim;
    static constexpr double unit = Dim == 2 ? pi / 4 : pi / 6;  ///< volume of a ball [m^Dim]

    int count() const { return static_cast<int>(std::lround(std::pow(across, Dim))); }
    double pitch() const { return std::pow(unit / solid, 1.0 / Dim); }
    double length() const { return pitch() * across; }  ///< of the box [m]
    double h() const { return way; }                    ///< [s]: the speed is some 1 m/s

    /// Of pairs in touch over that of points, by Henderson (plane), Carnahan and Starling (space).
    double contact_value(double solid_part) const {
        if constexpr (Dim == 2)
            return (1 - 7 * solid_part / 16) / std::pow(1 - solid_part, 2);
        else
            return (1 - solid_part / 2) / std::pow(1 - solid_part, 3);
    }
    /// Collisions of a ball in a second by Enskog, at temperature T and n balls per m^Dim.
    double collision_rate(double n, double temperature) const {
        return (Dim == 2 ? 2 : 4) * std::sqrt(pi) * n * contact_value(n * unit) *
               std::sqrt(temperature);
    }

    // A collision is seen in the middle of the step in which bodies have met, when they have gone
    // on by half a step on the average: balls are met at a smaller distance, walls farther out.
    // Mean normal speeds of what meets, at temperature 1: of two balls √π, of a ball and a wall
    // √(π/2).
    double met_at() const { return 1 - 0.5 * h() * std::sqrt(pi); }  ///< distance of centres [m]
    double free_length() const {
        return length() - 1 + h() * std::sqrt(0.5 * pi);
    }  ///< of them [m]

    /// Balls per volume that centres can reach, away from the walls. At a wall they are denser,
    /// since a part of what others would exclude is beyond it: by n times that part, to second
    /// order in n, whose integral over the distance is 2/3 in the plane and pi/4 in space.
    static constexpr double surplus = Dim == 2 ? 2.0 / 3 : pi / 4;
    double bulk_density() const {
        const double free = free_length();
        const double mean = count() / std::pow(free, Dim);
        double n = mean;
        for (int k = 0; k < 50; ++k) n = mean / (1 + 2 * Dim * surplus * n / free);
        return n;
    }

    World<Dim> make(Trial<Dim>& trial, std::uint64_t realisation) const {
        talus::MaterialTable<Law<Dim>> laws(2, law<Dim>(0.0, 1.0));
        laws.set(0, 0, law<Dim>(0.0, restitution));
        auto world = trial.world({.h = h(),
                                  .gravity = V<Dim>::Zero(),
                                  .solver = {.max_sweeps = 2000, .tolerance = 1e-12}},
                                 laws);
        for (int axis = 0; axis < Dim; ++axis) {
            world.add_plane(V<Dim>::Zero(), V<Dim>::Unit(axis), 1);
            world.add_plane(length() * V<Dim>::Unit(axis), -V<Dim>::Unit(axis), 1);
        }
        auto rng = trial.rng(realisation);
        std::normal_distribution<double> normal;
        for (int k = 0; k < count(); ++k) {
            V<Dim> x, v;
            for (int d = 0, rest = k; d < Dim; ++d, rest /= across) {
                x[d] = (rest % across + 0.5) * pitch();
                v[d] = normal(rng);
            }
            world.add(talus::Ball<Dim>{0.5}, point_mass<Dim>(1.0), {x, {}},
                      {V<Dim>(std::sqrt(double{Dim}) * v.normalized()), {}});
        }
        return world;
    }
};

/// Mean squares of the components of velocity, and the mean fourth power of the speed.
template <int Dim>
struct Moments {
    V<Dim> square = V<Dim>::Zero();
    double fourth = 0.0;

    Moments() = default;
    explicit Moments(const talus::Bodies<Dim>& bodies) {
        const double n = static_cast<double>(bodies.count() - Gas<Dim>::walls);
        for (std::size_t i = Gas<Dim>::walls; i < bodies.count(); ++i) {
            const V<Dim>& v = bodies.velocity[i];
            square += v.cwiseProduct(v) / n;
            fourth += std::pow(v.squaredNorm(), 2) / n;
        }
    }
    double temperature() const { return square.sum() / Dim; }
};

}  // namespace validation
