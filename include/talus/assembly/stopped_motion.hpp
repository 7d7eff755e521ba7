// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/assembly/body_image.hpp>
#include <talus/collision/contact_point.hpp>
#include <talus/collision/passage.hpp>
#include <talus/core/column.hpp>
#include <talus/core/instantiate.hpp>
#include <talus/dynamics/bodies.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

namespace talus {

/// Where bodies get to in the steps that Foresight looks ahead if contacts already decided on, its
/// stops, hold them up: without friction, without a change of their turning, and by a few sweeps
/// alone. A guess that tells by which side others are met; what bodies really do is the solver's.
///
/// A body that lands on its corner will turn, and its other corners will go down; but what stops
/// those is the same floor. With turning the guess would take the tops of its tiles for lost.
template <int Dim>
requires SpaceDimension<Dim>
class StoppedMotion {
  public:
    /// Starts from the motion over one step as if nothing were in the way.
    void begin(const Bodies<Dim>& bodies, std::span<const Twist<Dim>> free) {
        bodies_ = &bodies;
        motion_.assign(free);
        newest_.assign(bodies.count(), none);
        released_.assign(bodies.count(), false);
        changed_.assign(bodies.count(), false);
        stops_.clear();
        stops_.reserve(256);  // of a few bodies
    }
    /// Lets stops change the motion of the body, unless it is an obstacle. Until then it goes on as
    /// it does: what carries it is not among the stops.
    void release(BodyIndex i) {
        const auto k = static_cast<std::size_t>(i);
        released_[k] = !bodies_->is_obstacle(k);
    }
    bool is_released(BodyIndex i) const { return released_[static_cast<std::size_t>(i)]; }
    /// The contact, of which one body at least is released, is to hold up its bodies from the next
    /// `settle` on. Displacements below `noise` [m] do not matter. In a periodic cell it is with an
    /// image of b. True if it has to.
    bool add(BodyIndex a, BodyIndex b, const ContactPoint<Dim>& point, double noise,
             const BodyImage<Dim>& image = {});
    /// Lets all stops of the body act.
    void settle(BodyIndex i);
    bool is_changed(BodyIndex i) const { return changed_[static_cast<std::size_t>(i)]; }
    const Twist<Dim>& motion(BodyIndex i) const { return motion_[static_cast<std::size_t>(i)]; }

  private:
    static constexpr int sweeps = 4;
    static constexpr std::size_t none = static_cast<std::size_t>(-1);
    struct Stop {
        std::array<BodyIndex, 2> body;
        Vector<Dim> normal;
        double turning;  ///< what turns, and the cell, add to the distance in a step [m]
        double least;    ///< least change of the distance in a step [m]
        double noise;    ///< [m]
        double push;     ///< so far [kg m]
        std::array<std::size_t, 2> next;  ///< older stop of the same body
    };
    double change(const Stop& s) const {
        return s.normal.dot(motion_[static_cast<std::size_t>(s.body[0])].linear -
                            motion_[static_cast<std::size_t>(s.body[1])].linear) +
               s.turning - s.least;
    }
    bool act(Stop& stop);

    const Bodies<Dim>* bodies_ = nullptr;
    Column<Twist<Dim>> motion_;
    Column<std::size_t> newest_;  ///< stop of each free body
    Column<bool> released_;
    Column<bool> changed_;  ///< the body's motion is not the free one
    Column<Stop> stops_;
};

template <int Dim>
requires SpaceDimension<Dim>
bool StoppedMotion<Dim>::add(BodyIndex a, BodyIndex b, const ContactPoint<Dim>& point, double noise,
                             const BodyImage<Dim>& image) {
    const double least = -std::max(point.gap, 0.0) / Foresight::steps;
    Stop stop{{a, b}, point.normal, -point.normal.dot(image.motion), least, noise, 0.0, {}};
    for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
        const auto i = static_cast<std::size_t>(stop.body[k]);
        const double sign = k == 0 ? 1.0 : -1.0;
        if (is_released(stop.body[k])) stop.next[k] = std::exchange(newest_[i], stops_.size());
        if (motion_[i].angular.norm() > Foresight::most_turn) continue;  // ends nobody knows where
        Vector<Dim> centre = bodies_->position[i];
        if (k == 1) centre += image.offset;
        const Vector<Dim> arm = point.point - 0.5 * sign * point.slide - centre;
        stop.turning += sign * point.normal.dot(cross<Dim>(motion_[i].angular, arm));
    }
    stops_.push_back(stop);
    return change(stop) < -noise;
}

template <int Dim>
requires SpaceDimension<Dim>
bool StoppedMotion<Dim>::act(Stop& stop) {
    const auto a = static_cast<std::size_t>(stop.body[0]);
    const auto b = static_cast<std::size_t>(stop.body[1]);
    const auto direction = [&](std::size_t i) {
        return bodies_->locked[i].any() ? bodies_->locked[i].free_part(stop.normal) : stop.normal;
    };
    const auto mobility = [&](std::size_t i) {
        if (!released_[i]) return 0.0;
        return bodies_->inverse_mass[i] *
               (bodies_->locked[i].any() ? direction(i).squaredNorm() : 1.0);
    };
    const double inverse_a = mobility(a), inverse_b = mobility(b);
    if (!(inverse_a + inverse_b > 0.0)) return false;
    const double push = std::max(stop.push - change(stop) / (inverse_a + inverse_b), 0.0);
    const double more = push - stop.push;
    if (std::abs(more) * (inverse_a + inverse_b) <= stop.noise) return false;
    stop.push = push;
    if (released_[a]) motion_[a].linear += more * bodies_->inverse_mass[a] * direction(a);
    if (released_[b]) motion_[b].linear -= more * bodies_->inverse_mass[b] * direction(b);
    changed_[a] = changed_[a] || released_[a];
    changed_[b] = changed_[b] || released_[b];
    return true;
}

template <int Dim>
requires SpaceDimension<Dim>
void StoppedMotion<Dim>::settle(BodyIndex i) {
    for (int k = 0; k < sweeps; ++k) {
        bool acted = false;
        for (std::size_t s = newest_[static_cast<std::size_t>(i)]; s != none;) {
            Stop& stop = stops_[s];
            acted |= act(stop);
            s = stop.next[stop.body[0] == i ? 0 : 1];
        }
        if (!acted) return;
    }
}

}  // namespace talus

TALUS_IN_PLANE(class talus::StoppedMotion<2>)
TALUS_IN_SPACE(class talus::StoppedMotion<3>)
