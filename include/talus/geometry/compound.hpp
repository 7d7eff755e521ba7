// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/model.hpp>
#include <talus/geometry/any_shape_of.hpp>
#include <talus/geometry/ball.hpp>
#include <talus/geometry/box.hpp>
#include <talus/geometry/capsule.hpp>
#include <talus/geometry/convex_polytope.hpp>
#include <talus/geometry/shape_view.hpp>

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace talus {

/// A compound has at most this many children, so that they fit a contact's code.
inline constexpr std::size_t max_child_count = std::size_t{1} << 12;

/// Exact for balls, that of the box for rounded cores, and for shapes that tell no more than their
/// box the ball around it. Throws input_error if the shape is unbounded.
template <int Dim, Shape<Dim> S>
BoundingBall<Dim> bounding_ball(const S& shape) {
    const ShapeView<Dim> view = view_of<Dim>(shape);
    if (view.has_core()) {
        const CoreView<Dim> core = view.core();
        return {core.centre, core.bound};
    }
    const Aabb<Dim> box = view.aabb(Pose<Dim>{});
    const Vector<Dim> centre = 0.5 * (box.low + box.high);
    const double radius = 0.5 * (box.high - box.low).norm();
    return {require_finite("centre of a child of the compound", centre),
            require_in("radius of a child of the compound", radius, 0.0, 1e300)};
}

/// Whether S is a compound or an AnyShapeOf with one in its list.
template <class S>
inline constexpr bool may_be_compound = is_compound<S>;
template <int Dim, class... Shapes>
inline constexpr bool may_be_compound<AnyShapeOf<Dim, Shapes...>> = (may_be_compound<Shapes> ||
                                                                     ...);

/// Several shapes held together: a clump of balls, a cross of boxes, any non-convex body. `Child`
/// is one type of shape; for mixed children an AnyShapeOf, which may list shapes of one's own.
/// Compounds do not nest: a contact's code has room for one number of a child.
template <int Dim, SolidShape<Dim> Child_>
requires SpaceDimension<Dim>
class CompoundOf {
    static_assert(!may_be_compound<Child_>, "compounds do not nest");

  public:
    using Child = Child_;
    /// A child and its pose in the frame of the compound.
    struct Placed {
        Child shape;
        Pose<Dim> pose;
    };

    /// Mass properties are the sums over the children: where children overlap, what they share
    /// counts once for each. Give `mass_properties` to say otherwise. Throws input_error without
    /// children, with more than 4096, or if one is unbounded.
    explicit CompoundOf(const std::vector<Placed>& children,
                        std::optional<MassProperties<Dim>> mass_properties = {}) {
        require_in("child count of the compound", static_cast<double>(children.size()), 1.0,
                   static_cast<double>(max_child_count));
        Data data;
        for (const Placed& c : children) {
            data.children.push_back(c.shape.placed(c.pose));
            // Before it is turned: a box of what tells no more is thin in the child's own frame.
            data.half_thickness =
                std::min(data.half_thickness, talus::half_thickness<Dim>(c.shape));
        }
        data.mass = mass_properties ? *mass_properties : sum(data.children);
        data_ = share(std::move(data));
    }

    /// The children, seen from the frame of the compound.
    const std::vector<Child>& children() const { return data_->children; }
    /// A ball around each child, in the frame of the compound.
    std::span<const BoundingBall<Dim>> bounds() const { return data_->bounds; }

    Aabb<Dim> aabb(const Pose<Dim>& pose) const {
        Aabb<Dim> box;
        for (const Child& c : children()) box.include(c.aabb(pose));
        return box;
    }
    MassProperties<Dim> mass_properties() const { return data_->mass; }
    /// Of the thinnest child, each in its own frame [m].
    double half_thickness() const { return data_->half_thickness; }
    CompoundOf placed(const Pose<Dim>& pose) const {
        Data data;
        for (const Child& c : children()) data.children.push_back(c.placed(pose));
        data.mass = talus::placed(data_->mass, pose);
        data.half_thickness = data_->half_thickness;
        CompoundOf result = *this;
        result.data_ = share(std::move(data));
        return result;
    }

    void write(NumberRecord& out) const requires Recordable<Child> {
        out.integer(children().size());
        for (const Child& c : children()) c.write(out);
        out.real(data_->mass.volume);
        out.array(data_->mass.centroid);
        out.array(data_->mass.inertia);
        out.real(data_->half_thickness);
    }
    static CompoundOf read(NumberRecordReader& in) requires Recordable<Child> {
        Data data;
        const auto count = in.integer<std::size_t>(1, static_cast<std::int64_t>(max_child_count));
        for (std::size_t k = 0; k < count; ++k) data.children.push_back(Child::read(in));
        data.mass.volume = in.real();
        data.mass.centroid = in.array<Vector<Dim>>();
        data.mass.inertia = in.array<AngularMatrix<Dim>>();
        data.half_thickness = require_non_negative("half thickness of a compound", in.real());
        return CompoundOf(Made{}, share(std::move(data)));
    }

  private:
    /// Immutable once shared, so that copies of a compound cost a pointer.
    struct Data {
        std::vector<Child> children;
        std::vector<BoundingBall<Dim>> bounds;
        MassProperties<Dim> mass;
        double half_thickness = std::numeric_limits<double>::infinity();
    };

    struct Made {};
    CompoundOf(Made, std::shared_ptr<const Data>&& data) : data_(std::move(data)) {}
    static std::shared_ptr<const Data> share(Data&& data) {
        for (const Child& c : data.children) data.bounds.push_back(bounding_ball<Dim>(c));
        return std::make_shared<const Data>(std::move(data));
    }
    /// Sum by the parallel axes theorem.
    static MassProperties<Dim> sum(const std::vector<Child>& children) {
        MassProperties<Dim> total;
        for (const Child& c : children) {
            const MassProperties<Dim> m = c.mass_properties();
            total.volume += m.volume;
            total.centroid += m.volume * m.centroid;
        }
        total.centroid /= total.volume;
        for (const Child& c : children) {
            const MassProperties<Dim> m = c.mass_properties();
            const Vector<Dim> arm = m.centroid - total.centroid;
            total.inertia +=
                m.inertia + m.volume * inertia_of_second_moments<Dim>(arm * arm.transpose());
        }
        return total;
    }

    std::shared_ptr<const Data> data_;
};

template <int Dim, class Child>
inline constexpr bool is_compound<CompoundOf<Dim, Child>> = true;

/// The compound of talus' own convex shapes.
template <int Dim>
using Compound =
    CompoundOf<Dim, AnyShapeOf<Dim, Ball<Dim>, Capsule<Dim>, Box<Dim>, ConvexPolytope<Dim>>>;

TALUS_MODEL(SolidShape<Compound<2>, 2>);
TALUS_MODEL(SolidShape<Compound<3>, 3>);
TALUS_MODEL(!ConvexShape<Compound<2>, 2>);
TALUS_MODEL(!ConvexShape<Compound<3>, 3>);

}  // namespace talus
