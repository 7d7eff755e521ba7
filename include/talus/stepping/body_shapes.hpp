// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/assembly/shape_list.hpp>
#include <talus/core/column.hpp>
#include <talus/core/ids.hpp>
#include <talus/core/room.hpp>
#include <talus/geometry/convex_core.hpp>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>

namespace talus {

/// The shapes of all bodies, in the bodies' frames, with their sizes, and a number that changes
/// whenever one of them does.
template <int Dim, class ShapeType>
requires SpaceDimension<Dim>
class BodyShapes {
  public:
    std::span<const ShapeType> shapes() const { return shapes_; }
    /// Of each shape about the body's centre; infinite where it has no bound [m].
    std::span<const double> bounding_radius() const { return bounding_radius_; }
    /// Of each shape at its thinnest part; of what has none the bounding radius [m].
    std::span<const double> half_thickness() const { return half_thickness_; }
    std::size_t count() const { return shapes_.size(); }
    /// Its version is unlike any given before in this program, as shapes may be replaced by others.
    /// Copies share it.
    ShapeList<Dim, ShapeType> list() const {
        return {shapes_, bounding_radius_, version_, routines_};
    }

    /// `needs`: the routines for all shapes that this one may be.
    void push_back(ShapeType shape,
                   const NarrowRoutines<Dim>& needs = narrow_routines<Dim, ShapeType>) {
        const double radius = radius_of(shape), thickness = thickness_of(shape, radius);
        detail::make_room(bounding_radius_, count() + 1);
        detail::make_room(half_thickness_, count() + 1);
        shapes_.push_back(std::move(shape));
        bounding_radius_.push_back(radius);
        half_thickness_.push_back(thickness);
        routines_.add(needs);
        version_ = new_version();
    }
    /// Adds the shape of a body, then the body by `add_body()`, and the shape is gone if that
    /// throws. In this order, as shapes can be refused: a body taken back would be missed.
    template <class S, class AddBody>
    auto add(const S& shape, const AddBody& add_body) {
        push_back(ShapeType(shape), needs<S>());
        try {
            return add_body();
        } catch (...) {
            shapes_.pop_back();
            bounding_radius_.pop_back();
            half_thickness_.pop_back();
            throw;
        }
    }
    template <class S>
    void replace(std::size_t body, const S& given) {
        ShapeType shape(given);
        const double radius = radius_of(shape), thickness = thickness_of(shape, radius);
        shapes_[body] = std::move(shape);
        bounding_radius_[body] = radius;
        half_thickness_[body] = thickness;
        routines_.add(needs<S>());
        version_ = new_version();
    }
    /// Keeps those whose new index `to` is not negative, in their order.
    void move_up(std::span<const BodyIndex> to) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < to.size(); ++i) {
            if (to[i] < 0) continue;
            if (kept != i) shapes_[kept] = std::move(shapes_[i]);
            bounding_radius_[kept] = bounding_radius_[i];
            half_thickness_[kept] = half_thickness_[i];
            ++kept;
        }
        // (Not resize: a shape need not be default-constructible.)
        shapes_.erase(shapes_.begin() + static_cast<std::ptrdiff_t>(kept), shapes_.end());
        bounding_radius_.resize(kept);
        half_thickness_.resize(kept);
        version_ = new_version();
    }

  private:
    /// The routines for a shape given as an S: a type of one's own may hold it as something else.
    template <class S>
    static const NarrowRoutines<Dim>& needs() {
        return narrow_routines<Dim, std::conditional_t<is_any_shape<ShapeType>, S, ShapeType>>;
    }
    static double radius_of(const ShapeType& shape) {
        const Aabb<Dim> box = shape.aabb(Pose<Dim>{});
        return box.bounded() ? box.low.cwiseAbs().cwiseMax(box.high).norm()
                             : std::numeric_limits<double>::infinity();
    }
    static double thickness_of(const ShapeType& shape, double radius) {
        const double half = talus::half_thickness<Dim>(shape);
        return half > 0.0 ? half : radius;
    }
    static std::uint64_t new_version() {
        static std::atomic<std::uint64_t> last{0};
        return ++last;
    }

    Column<ShapeType> shapes_;
    Column<double> bounding_radius_, half_thickness_;
    std::uint64_t version_ = 0;
    // Of the shapes that were given, not of all that a ShapeType may be.
    NarrowRoutines<Dim> routines_{.own = detail::own_pairs<Dim, ShapeType, ShapeType>};
};

}  // namespace talus
