// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/assembly/anticipated_contacts.hpp>
#include <talus/assembly/image_pairs.hpp>
#include <talus/assembly/shape_list.hpp>
#include <talus/collision/concepts.hpp>
#include <talus/collision/contact_set.hpp>
#include <talus/collision/narrow_phase.hpp>
#include <talus/core/column.hpp>
#include <talus/core/matrix_functions.hpp>
#include <talus/dynamics/bodies.hpp>
#include <talus/dynamics/periodic_cell.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
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
    /// side. Bodies whose groups do not meet, and pairs `ignored`, have no contacts. With a `cell`,
    /// bodies also meet images of others, which move by `strain` times their offsets over the step.
    /// Throws input_error naming a pair of the broad phase that is none.
    void detect(const Bodies<Dim>& bodies, const ShapeList<Dim, ShapeType>& list, double skin,
                std::span<const double> reach, std::span<const Twist<Dim>> motion, double tolerance,
                const IgnoredPairs& ignored, ContactSet<Dim>& contacts,
                const std::optional<PeriodicCell<Dim>>& cell = std::nullopt,
                const Matrix<Dim>& strain = Matrix<Dim>::Zero()) {
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
            if (cell) image = image_of(*cell, images_[k], strain);
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
        if (!motion.empty()) anticipated_.finish(contacts, cell.has_value());
    }

    std::span<const CandidatePair> candidates() const { return candidates_; }
    /// Of the second body of each candidate; empty without a cell.
    std::span<const ImageShift> images() const { return images_; }

  private:
    static BodyImage<Dim> image_of(const PeriodicCell<Dim>& cell, const ImageShift& shift,
                                   const Matrix<Dim>& strain) {
        if (shift.is_zero()) return {};
        const Vector<Dim> offset = cell.offset(shift);
        return {shift, offset, strain * offset};
    }

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
            throw input_error(detail::numbered("bodies", a, detail::numbered(" and", b)) + ": " +
                              error.what());
        }
        if (shifted)
            for (ContactPoint<Dim>& point : points_) point.point += half;
    }

    /// As below, in a cell. Displacements count from where the deformation of the cell alone would
    /// have brought a body: with F what the cell went through since, s' = F s + d_b - d_a for what
    /// two bodies are apart. So gaps close by |F - 1| |s| + |d_a| + |d_b| at most; of pairs with
    /// |s| up to 2 (R + room) of both that is charged to the two, and with |F - 1| <= 1/2 those
    /// farther apart do not touch. What has no bounds has no images, and others move past it.
    bool left_a_box(const Bodies<Dim>& bodies, std::span<const double> radius,
                    std::span<const double> reach,
                    const std::optional<PeriodicCell<Dim>>& cell) const {
        if (cell.has_value() != cell_.has_value()) return true;
        if (!cell) return left_a_box(bodies, radius, reach);
        if (cell->periodic() != cell_->periodic() || box_.size() != reach.size()) return true;
        const Matrix<Dim> change = (cell->lattice() - cell_->lattice()) * inverse_lattice_;
        constexpr double most_strain = 0.5;
        const double strain = change.norm();
        if (!(strain <= most_strain)) return true;
        if (unbounded_ && left_a_box(bodies, radius, reach)) return true;
        for (std::size_t i = 0; i < reach.size(); ++i) {
            if (free_[i] == bodies.is_obstacle(i)) return true;
            if (!std::isfinite(radius[i])) continue;
            const double turn = bodies.rotation[i].distance(rotation_[i]) * radius[i];
            const Vector<Dim> way =
                (bodies.position[i] - position_[i]) - Vector<Dim>(change * position_[i]);
            if (!(way.norm() + turn + reach[i] + 2.0 * strain * (radius[i] + room_[i]) <= room_[i]))
                return true;
        }
        return false;
    }
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
                         std::span<const double> reach,
                         const std::optional<PeriodicCell<Dim>>& cell) {
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
        cell_ = cell;
        images_.clear();
        if (cell) {
            inverse_lattice_ = inverted(cell->lattice()).inverse;
            unbounded_ = std::any_of(box_.begin(), box_.end(),
                                     [](const Aabb<Dim>& box) { return !box.bounded(); });
            image_pairs_.find(broad_, *cell, box_, free_, candidates_, images_);
            return;
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
    std::optional<PeriodicCell<Dim>> cell_;  // when the boxes were made
    Matrix<Dim> inverse_lattice_;
    bool unbounded_ = false;  // some box is
    Column<ImageShift> images_;
    ImagePairs<Dim> image_pairs_;
};

}  // namespace talus
