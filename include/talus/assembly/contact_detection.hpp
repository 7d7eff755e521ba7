// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/assembly/anticipated_contacts.hpp>
#include <talus/assembly/shape_list.hpp>
#include <talus/collision/concepts.hpp>
#include <talus/collision/contact_set.hpp>
#include <talus/collision/narrow_phase.hpp>
#include <talus/core/column.hpp>
#include <talus/dynamics/bodies.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace talus {

/// From placed shapes to the sorted set of contacts. Candidate pairs are found with boxes widened
/// by a skin and kept until some body may have left its box; the contacts depend on the
/// configuration alone, not on when the candidates were found.
template <int Dim, class ShapeType, BroadPhase<Dim> Broad>
requires SpaceDimension<Dim> && CanMeet<ShapeType, ShapeType, Dim>
class ContactDetection {
  public:
    /// Finds every contact with gap <= reach[a] + reach[b]. `skin` is the widening of new boxes: a
    /// larger one gives more candidates, kept for longer. All in [m]. If `motion` is given, of each
    /// body over one step [m, rad], contacts are those that it leads to (anticipated_contacts.hpp),
    /// where that differs; of bodies that touch, gap <= `tolerance`, only if they slide past that
    /// side. Bodies whose groups do not meet, and pairs `ignored`, have no contacts. Throws
    /// input_error naming a pair of the broad phase that is none.
    void detect(const Bodies<Dim>& bodies, const ShapeList<Dim, ShapeType>& list, double skin,
                std::span<const double> reach, std::span<const Twist<Dim>> motion, double tolerance,
                const IgnoredPairs& ignored, ContactSet<Dim>& contacts) {
        const std::span<const ShapeType> shapes = list.shapes;
        if (!found_ || list.version != version_ ||
            left_a_box(bodies, list.bounding_radius, reach)) {
            found_ = false;  // so that a failure on the way leaves nothing that looks found
            find_candidates(bodies, shapes, skin, reach);
            version_ = list.version;
            found_ = true;
        }
        contacts.clear();
        contacts.body = bodies.id;
        if (!motion.empty()) anticipated_.begin(bodies, motion, list.routines, tolerance);
        for (const CandidatePair& pair : candidates_) {
            const auto a = static_cast<std::size_t>(pair.a);
            const auto b = static_cast<std::size_t>(pair.b);
            if (!may_meet(bodies.groups[a], bodies.groups[b])) continue;
            if (!ignored.empty() && ignored.contains(bodies.id[a], bodies.id[b])) continue;
            points_.clear();
            try {
                contact_points<Dim>(shapes[a], bodies.pose(a), shapes[b], bodies.pose(b),
                                    reach[a] + reach[b], points_, list.routines);
            } catch (const input_error& error) {
                throw input_error(detail::numbered("bodies", a, detail::numbered(" and", b)) +
                                  ": " + error.what());
            }
            if (!motion.empty()) {
                anticipated_.add(pair.a, shapes[a], pair.b, shapes[b], reach[a] + reach[b],
                                 std::span<const ContactPoint<Dim>>(points_));
                continue;
            }
            sort_by_feature(points_);
            for (const ContactPoint<Dim>& point : points_)
                contacts.push_back(pair.a, pair.b, point);
        }
        if (!motion.empty()) anticipated_.finish(contacts);
    }

    std::span<const CandidatePair> candidates() const { return candidates_; }

  private:
    bool left_a_box(const Bodies<Dim>& bodies, std::span<const double> radius,
                    std::span<const double> reach) const {
        if (box_.size() != reach.size()) return true;
        for (std::size_t i = 0; i < reach.size(); ++i) {
            if (free_[i] == bodies.is_obstacle(i)) return true;
            const double turn = bodies.rotation[i].distance(rotation_[i]);
            const double way =
                (bodies.position[i] - position_[i]).norm() + (turn > 0.0 ? turn * radius[i] : 0.0);
            if (!(way + reach[i] <= room_[i])) return true;
        }
        return false;
    }

    void find_candidates(const Bodies<Dim>& bodies, std::span<const ShapeType> shapes, double skin,
                         std::span<const double> reach) {
        const std::size_t n = bodies.count();
        box_.resize(n);
        room_.resize(n);
        free_.resize(n);
        position_ = bodies.position;
        rotation_ = bodies.rotation;
        for (std::size_t i = 0; i < n; ++i) {
            free_[i] = !bodies.is_obstacle(i);
            room_[i] = reach[i] + 0.5 * skin;
            box_[i] = shapes[i].aabb(bodies.pose(i)).expanded(room_[i]);
        }
        broad_.find_pairs(
            std::span<const Aabb<Dim>>(box_),
            [&](BodyIndex i) { return bodies.is_obstacle(static_cast<std::size_t>(i)); },
            candidates_);
        require_candidates(candidates_, free_);
    }

    Broad broad_;
    Column<Aabb<Dim>> box_;
    Column<Vector<Dim>> position_;    // when the boxes were made
    Column<Rotation<Dim>> rotation_;  // when the boxes were made
    Column<double> room_;             // widening of each box
    std::vector<bool> free_;          // no obstacle; two obstacles are no pair
    std::uint64_t version_ = 0;       // of the shapes
    bool found_ = false;              // candidates, of this version
    Column<CandidatePair> candidates_;
    Column<ContactPoint<Dim>> points_;
    AnticipatedContacts<Dim> anticipated_;
};

}  // namespace talus
