// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/geometry/any_shape_of.hpp>
#include <talus/geometry/ball.hpp>
#include <talus/geometry/box.hpp>
#include <talus/geometry/capsule.hpp>
#include <talus/geometry/convex_polytope.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace talus {

/// A compound has at most this many children, so that they fit a contact's code.
inline constexpr std::size_t max_child_count = std::size_t{1} << 12;

/// Several convex shapes held together: a clump of balls, a cross of boxes, any non-convex body.
template <int Dim>
requires SpaceDimension<Dim>
class Compound {
  public:
    using Child = AnyShapeOf<Dim, Ball<Dim>, Capsule<Dim>, Box<Dim>, ConvexPolytope<Dim>>;
    /// A child and its pose in the frame of the compound.
    struct Placed {
        Child shape;
        Pose<Dim> pose;
    };

    /// Mass properties are the sums over the children: where children overlap, what they share
    /// counts once for each. Give `mass_properties` to say otherwise. Throws input_error without
    /// children or with more than 4096.
    explicit Compound(const std::vector<Placed>& children,
                      std::optional<MassProperties<Dim>> mass_properties = {}) {
        require_in("child count of the compound", static_cast<double>(children.size()), 1.0,
                   static_cast<double>(max_child_count));
        Data data;
        for (const Placed& c : children) data.children.push_back(c.shape.placed(c.pose));
        data.mass = mass_properties ? *mass_properties : sum(data.children);
        data_ = share(std::move(data));
    }

    /// The children, seen from the frame of the compound.
    const std::vector<Child>& children() const { return data_->children; }
    /// Centre and radius of a ball around child i [m].
    const Vector<Dim>& centre(std::size_t i) const { return data_->centres[i]; }
    double bound(std::size_t i) const { return data_->bounds[i]; }

    Aabb<Dim> aabb(const Pose<Dim>& pose) const {
        Aabb<Dim> box;
        for (const Child& c : children()) box.include(c.aabb(pose));
        return box;
    }
    MassProperties<Dim> mass_properties() const { return data_->mass; }
    Compound placed(const Pose<Dim>& pose) const {
        Data data;
        for (const Child& c : children()) data.children.push_back(c.placed(pose));
        data.mass = talus::placed(data_->mass, pose);
        Compound result = *this;
        result.data_ = share(std::move(data));
        return result;
    }

  private:
    struct Data {
        std::vector<Child> children;
        std::vector<Vector<Dim>> centres;
        std::vector<double> bounds;
        MassProperties<Dim> mass;
    };

    static std::shared_ptr<const Data> share(Data&& data) {
        for (const Child& child : data.children)
            std::visit(
                [&]<class S>(const S& s) {
                    if constexpr (std::same_as<S, Ball<Dim>>) {
                        data.centres.push_back(s.centre());
                        data.bounds.push_back(s.radius());
                    } else {
                        data.centres.push_back(s.core().centre);
                        data.bounds.push_back(s.core().bound);
                    }
                },
                child.held());
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

static_assert(SolidShape<Compound<2>, 2> && SolidShape<Compound<3>, 3>);
static_assert(!ConvexShape<Compound<2>, 2> && !ConvexShape<Compound<3>, 3>);

}  // namespace talus
