// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <cstdint>

#include "harness/case.hpp"

/// Balls of radius 0.08 to 0.12 on a jittered lattice, within walls or free; and what the cases sum
/// up of them, from masses and velocities alone.
namespace validation {

template <int Dim>
struct WalledBox {
    int wide, high;
    double speed = 0.0;  ///< of every ball, in random directions [m/s]
    double spin = 0.0;   ///< of every ball, in random directions [1/s]

    static constexpr double pitch = 0.27, mass = 1.0;

    int count() const { return high * (Dim == 2 ? wide : wide * wide); }
    V<Dim> size() const {
        V<Dim> result = V<Dim>::Constant(wide * pitch);
        result[Dim - 1] = high * pitch;
        return result;
    }
    void add_sides(World<Dim>& world) const {
        for (int axis = 0; axis < Dim - 1; ++axis) {
            world.add_plane(V<Dim>::Zero(), V<Dim>::Unit(axis));
            world.add_plane(size()[axis] * V<Dim>::Unit(axis), -V<Dim>::Unit(axis));
        }
    }
    void add_lid(World<Dim>& world) const {
        world.add_plane(size()[Dim - 1] * up<Dim>(), -up<Dim>());
    }
    void add_balls(World<Dim>& world, std::mt19937_64 rng) const {
        std::uniform_real_distribution<double> radius(0.08, 0.12), jitter(-0.01, 0.01);
        std::normal_distribution<double> normal;
        const auto random_direction = [&](auto v) {
            for (double& x : v) x = normal(rng);
            return v.normalized().eval();
        };
        const int per_layer = Dim == 2 ? wide : wide * wide;
        for (int k = 0; k < count(); ++k) {
            V<Dim> x;
            x[0] = (k % wide + 0.5) * pitch;
            x[1] = ((k / wide) % wide + 0.5) * pitch;
            x[Dim - 1] = (k / per_layer + 0.5) * pitch;
            for (double& c : x) c += jitter(rng);
            const double r = radius(rng);
            const V<Dim> v = speed * random_direction(V<Dim>(V<Dim>::Zero()));
            const W<Dim> w = spin * random_direction(W<Dim>(W<Dim>::Zero()));
            world.add(talus::Ball<Dim>(r), round_inertia<Dim>(mass, r), {x, {}}, {v, w});
        }
    }
};

/// Kinetic energy, and potential energy in the world's gravity, of balls [J].
template <int Dim>
double energy(const World<Dim>& world) {
    const auto& b = world.bodies();
    double sum = 0.0;
    for (std::size_t i = 0; i < b.count(); ++i) {
        if (b.is_obstacle(i)) continue;
        sum += 0.5 * b.mass(i) * b.velocity[i].squaredNorm() +
               0.5 * b.inertia(i)[0] * b.spin[i].squaredNorm() -
               b.mass(i) * world.params().gravity.dot(b.position[i]);
    }
    return sum;
}

/// Largest kinetic plus change of potential energy of a run: what rounding errors are relative to.
class EnergyScale {
  public:
    explicit EnergyScale(double start) : start_(start), largest_(std::abs(start)) {}
    void see(double energy) { largest_ = std::max(largest_, std::abs(energy - start_)); }
    double value() const { return largest_; }

  private:
    double start_, largest_;
};

}  // namespace validation
