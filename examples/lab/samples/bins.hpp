// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/geometry/box.hpp>
#include <talus/geometry/half_space.hpp>

#include <cstddef>
#include <utility>

#include "../picture.hpp"

namespace lab {

/// Bins in a row along the first axis, open above, on a flat floor at height 0; in space as deep as
/// they are wide. Up is the last axis.
template <int Dim>
class Bins {
  public:
    using V = talus::Vector<Dim>;

    /// Inner width and height [m].
    Bins(std::size_t count, double width, double height)
        : count_(count), width_(width), height_(height) {}

    template <class System>
    void add_to(System& system) const {
        system.add_obstacle(talus::HalfSpace<Dim>(V::Unit(Dim - 1), 0.0));
        for (std::size_t k = 0; k <= count_; ++k) {
            V half = V::Constant(width_), centre = V::Zero();
            half[0] = 0.5 * wall();
            half[Dim - 1] = height_;
            centre[0] = left(k) - half[0];
            centre[Dim - 1] = 0.5 * height_;
            if (Dim == 3) centre[1] = 0.5 * width_;
            system.add_obstacle(talus::Box<Dim>(half), {{centre, {}}});
        }
        for (int axis = 1; axis < Dim - 1; ++axis) {
            system.add_obstacle(talus::HalfSpace<Dim>(V::Unit(axis), 0.0));
            system.add_obstacle(talus::HalfSpace<Dim>(-V::Unit(axis), -width_));
        }
    }
    /// Corners of a bin, as far from its walls as `margin` [m].
    std::pair<V, V> inside(std::size_t k, double margin) const {
        V low = V::Constant(margin), high = V::Constant(width_ - margin);
        low[0] += left(k);
        high[0] += left(k);
        high[Dim - 1] = height_;
        return {low, high};
    }
    /// What a picture shows of them: from the front, in space from above.
    std::pair<Point, Point> window() const {
        return {{-wall(), Dim == 2 ? -wall() : 0.0},
                {left(count_), Dim == 2 ? 0.7 * height_ : width_}};
    }

  private:
    double wall() const { return 0.05 * width_; }
    double left(std::size_t k) const { return static_cast<double>(k) * (width_ + wall()); }

    std::size_t count_;
    double width_, height_;
};

}  // namespace lab
