// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/assembly/anticipated_contacts.hpp>
#include <talus/assembly/candidate_boxes.hpp>
#include <talus/assembly/cell_images.hpp>
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
    /// side. Bodies whose groups do not meet, and pairs `ignored`, have no contacts. With a `cell`,
    /// bodies also meet images of others, which move by its `strain` times their offsets over the
    /// step. Throws input_error naming a pair of the broad phase that is none.
    void detect(const Bodies<Dim>& bodies, const ShapeList<Dim, ShapeType>& list, double skin,
                std::span<const double> reach, std::span<const Twist<Dim>> motion, double tolerance,
                const IgnoredPairs& ignored, ContactSet<Dim>& contacts,
                const StepCell<Dim>& cell = {}) {
        const std::span<const ShapeType> shapes = list.shapes;
        if (!found_ || list.version != version_ ||
            left_a_box(bodies, list.bounding_radius, reach, cell)) {
            found_ = false;  // so that a failure on the way leaves nothing that looks found
            find_candidates(bodies, shapes, skin, reach, cell);
            version_ = list.version;
            found_ = true;
        }
        contacts.clear();
        contacts.body = bodies.id;
        if (!motion.empty()) anticipated_.begin(bodies, motion, list.routines, tolerance);
        for (std::size_t k = 0; k < candidates_.size(); ++k) {
            const CandidatePair& pair = candidates_[k];
            const auto a = static_cast<std::size_t>(pair.a);
            const auto b = static_cast<std::size_t>(pair.b);
            if (!may_meet(bodies.groups[a], bodies.groups[b])) continue;
            if (!ignored.empty() && ignored.contains(bodies.id[a], bodies.id[b])) continue;
            BodyImage<Dim> image;
            if (cell) image = (images_.*cell.routines->image)(*cell.cell, k, cell.strain);
            find_points(bodies, list, a, b, reach[a] + reach[b], image);
            if (!motion.empty()) {
                anticipated_.add(pair.a, shapes[a], pair.b, shapes[b], reach[a] + reach[b],
                                 std::span<const ContactPoint<Dim>>(points_), image);
                continue;
            }
            sort_by_feature(points_);
            for (const ContactPoint<Dim>& point : points_)
                if (cell)
                    contacts.push_back(pair.a, pair.b, point, image.shift, image.offset);
                else
                    contacts.push_back(pair.a, pair.b, point);
        }
        if (!motion.empty()) anticipated_.finish(contacts, static_cast<bool>(cell));
    }

    std::span<const CandidatePair> candidates() const { return candidates_; }
    /// Of the second body of each candidate; empty without a cell.
    std::span<const ImageShift> images() const { return images_.images(); }

  private:
    /// Fills `points_`. Body and image are each moved by half of what they are apart, so that gap
    /// and normal have the same bits whichever of the two is seen as the image.
    void find_points(const Bodies<Dim>& bodies, const ShapeList<Dim, ShapeType>& list,
                     std::size_t a, std::size_t b, double margin, const BodyImage<Dim>& image) {
        points_.clear();
        Pose<Dim> pose_a = bodies.pose(a), pose_b = bodies.pose(b);
        const bool shifted = !image.shift.is_zero();
        const Vector<Dim> half = 0.5 * image.offset;
        if (shifted) {
            pose_a.position -= half;
            pose_b.position += half;
        }
        try {
            contact_points<Dim>(list.shapes[a], pose_a, list.shapes[b], pose_b, margin, points_,
                                list.routines);
        } catch (const input_error& error) {
            throw input_error(detail::joined(
                {detail::numbered("bodies", a, detail::numbered(" and", b)), ": ", error.what()}));
        }
        if (shifted)
            for (ContactPoint<Dim>& point : points_) point.point += half;
    }

    bool left_a_box(const Bodies<Dim>& bodies, std::span<const double> radius,
                    std::span<const double> reach, const StepCell<Dim>& cell) const {
        if (static_cast<bool>(cell) != images_.has_cell()) return true;
        return cell ? (images_.*cell.routines->left)(*cell.cell, boxes_, bodies, radius, reach)
                    : boxes_.left(bodies, radius, reach);
    }

    void find_candidates(const Bodies<Dim>& bodies, std::span<const ShapeType> shapes, double skin,
                         std::span<const double> reach, const StepCell<Dim>& cell) {
        const std::size_t n = bodies.count();
        boxes_.box.resize(n);
        boxes_.room.resize(n);
        boxes_.free.resize(n);
        boxes_.position = bodies.position;
        boxes_.rotation = bodies.rotation;
        for (std::size_t i = 0; i < n; ++i) {
            boxes_.free[i] = !bodies.is_obstacle(i);
            boxes_.room[i] = reach[i] + 0.5 * skin;
            boxes_.box[i] = shapes[i].aabb(bodies.pose(i)).expanded(boxes_.room[i]);
        }
        images_.forget();
        const PairSearch<Dim> search(broad_);
        if (cell)
            (images_.*cell.routines->find)(*cell.cell, boxes_, search, candidates_);
        else
            search(boxes_.box, boxes_.free, candidates_);
    }

    Broad broad_;
    CandidateBoxes<Dim> boxes_;
    CellImages<Dim> images_;
    std::uint64_t version_ = 0;  // of the shapes
    bool found_ = false;         // candidates, of this version
    Column<CandidatePair> candidates_;
    Column<ContactPoint<Dim>> points_;
    AnticipatedContacts<Dim> anticipated_;
};

}  // namespace talus
