// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/geometry/box.hpp>
#include <talus/stepping/simulation.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include "upright.hpp"

namespace lab {

/// A dry-stone wall: boxes in courses on the floor, each second of which begins and ends with half
/// a stone; along axis 0, in space across axis 1. Its stones are bodies one after another.
template <int Dim>
class RunningBond {
  public:
    using V = talus::Vector<Dim>;
    static constexpr int across = Dim - 2;  ///< the axis of what it is asked to withstand

    /// How many courses and stones in each; of a stone the length, height and depth [m], and the
    /// density [kg/m^Dim].
    RunningBond(double courses, double stones, double length, double height, double depth,
                double density)
        : courses_(static_cast<std::size_t>(courses)),
          stones_(stones),
          length_(length),
          height_(height),
          depth_(depth),
          density_(density) {}

    void build(talus::System<Dim>& system) {
        first_ = system.bodies.count();
        const double end = 0.5 * stones_ * length_;
        for (std::size_t course = 0; course < courses_; ++course) {
            const double z = (static_cast<double>(course) + 0.5) * height_;
            double x = -end;
            while (x < end - 1e-9 * length_) {
                const bool half = course % 2 == 1 && (x == -end || x > end - 0.75 * length_);
                const double length = half ? 0.5 * length_ : length_;
                system.add(talus::Box<Dim>(upright_half<Dim>(length, height_, depth_)), density_,
                           upright_pose<Dim>(x + 0.5 * length, z));
                course_.push_back(course);
                built_.push_back(system.bodies.position[system.bodies.count() - 1]);
                x += length;
            }
        }
    }
    /// Of each course the mean way from where it was built, against a ground that is now there, and
    /// at last the deepest fall of a stone [m].
    std::vector<double> residual(const talus::Bodies<Dim>& bodies, const V& ground) const {
        std::vector<double> way(courses_ + 1, 0.0), count(way.size(), 0.0);
        for (std::size_t k = 0; k < course_.size(); ++k) {
            const V moved = bodies.position[first_ + k] - built_[k] - ground;
            way[course_[k]] += moved[across];
            count[course_[k]] += 1.0;
            way.back() = std::max(way.back(), -moved[Dim - 1]);
        }
        for (std::size_t k = 0; k < courses_; ++k) way[k] /= count[k];
        return way;
    }
    /// A gust of wind: a pressure [N/m^(Dim-1)] that grows and fades as the square of a sine, on
    /// what is the wall's face before anything has moved, stone by stone.
    talus::ForceField<Dim> gust(const talus::System<Dim>& system, double pressure, double begin,
                                double duration) const {
        double face = 0.0;
        std::vector<double> area(course_.size(), 0.0);  // [m^(Dim-1)]
        const auto low = [&](std::size_t k) {
            const std::size_t i = first_ + k;
            return talus::view_of<Dim>(system.shapes()[i]).aabb(system.bodies.pose(i)).low[across];
        };
        for (std::size_t k = 0; k < area.size(); ++k) face = std::min(face, low(k));
        for (std::size_t k = 0; k < area.size(); ++k) {
            const double thick = 2.0 * (built_[k][across] - low(k));
            if (low(k) < face + 0.1 * thick)
                area[k] = system.bodies.mass(first_ + k) / density_ / thick;
        }
        return [=, first = first_](double t, const talus::Bodies<Dim>& bodies,
                                   std::span<talus::Wrench<Dim>> wrenches) {
            if (t < begin || t > begin + duration) return;
            const double wave = std::sin(std::numbers::pi * (t - begin) / duration);
            for (std::size_t k = 0; k < area.size() && first + k < bodies.count(); ++k)
                wrenches[first + k].force[across] += pressure * wave * wave * area[k];
        };
    }

  private:
    std::size_t courses_, first_ = 0;
    double stones_, length_, height_, depth_, density_;
    std::vector<std::size_t> course_;  // of each stone
    std::vector<V> built_;             // where [m]
};

}  // namespace lab
