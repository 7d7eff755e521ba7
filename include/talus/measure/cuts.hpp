// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/cross.hpp>
#include <talus/core/input.hpp>
#include <talus/dynamics/bodies.hpp>
#include <talus/problem/contact_problem.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>

namespace talus {

/// Imagined surfaces that divide a heap, as [Moreau] sections 3.4 and 3.5 draw them: each says of a
/// straight way whether it leads through, and to which side.
template <class S, int Dim>
concept CutSurface = requires(const S& surface, const Vector<Dim>& x) {
    /// 1 if the way from x to another point leads through to the side that the normal points to, -1
    /// if it leads back, 0 if it does not lead through.
    { surface.crossing(x, x) } -> std::same_as<int>;
    { surface.normal_at(x) } -> std::convertible_to<Vector<Dim>>;  ///< near x, of length 1
    { surface.area() } -> std::convertible_to<double>;             ///< [m^(Dim-1)]
    { surface.centre() } -> std::convertible_to<Vector<Dim>>;      ///< to take moments about [m]
};

/// In the plane a segment, in space a disc; infinite: the whole line or plane.
template <int Dim>
requires SpaceDimension<Dim>
class FlatCut {
  public:
    /// Half the length, or the radius [m]. Throws input_error unless the normal has a direction and
    /// the size is positive.
    FlatCut(const Vector<Dim>& centre, const Vector<Dim>& normal,
            double half_size = std::numeric_limits<double>::infinity())
        : centre_(centre), half_size_(half_size) {
        require_finite("centre of the cut", centre);
        require_finite("normal of the cut", normal);
        if (!(normal.norm() > 0.0))
            detail::reject("length of the normal of the cut", normal.norm(), "positive");
        if (!(half_size > 0.0)) detail::reject("half size of the cut", half_size, "positive");
        normal_ = normal.normalized();
    }

    int crossing(const Vector<Dim>& from, const Vector<Dim>& to) const {
        const double before = normal_.dot(from - centre_), after = normal_.dot(to - centre_);
        if ((before < 0.0) == (after < 0.0)) return 0;
        const Vector<Dim> at = from + before / (before - after) * (to - from) - centre_;
        if (!((at - normal_ * normal_.dot(at)).norm() <= half_size_)) return 0;
        return before < 0.0 ? 1 : -1;
    }
    double area() const {
        constexpr std::array unit{2.0, std::numbers::pi};  // of half length, of radius 1
        return unit[Dim - 2] * std::pow(half_size_, Dim - 1);
    }
    const Vector<Dim>& centre() const { return centre_; }
    const Vector<Dim>& normal_at(const Vector<Dim>&) const { return normal_; }

  private:
    Vector<Dim> centre_, normal_;
    double half_size_;
};

/// The side of an upright cylinder between two heights along its axis, the normal outwards.
class CylinderCut {
  public:
    /// The axis goes through `foot` along `axis`; heights are from there [m]. Throws input_error
    /// unless the axis has a direction, the radius is positive and `low` below `high`.
    CylinderCut(const Vector<3>& foot, const Vector<3>& axis, double radius,
                double low = -std::numeric_limits<double>::infinity(),
                double high = std::numeric_limits<double>::infinity())
        : foot_(foot), radius_(radius), low_(low), high_(high) {
        require_finite("foot of the cylinder", foot);
        require_finite("axis of the cylinder", axis);
        if (!(axis.norm() > 0.0))
            detail::reject("length of the axis of the cylinder", axis.norm(), "positive");
        require_positive("radius of the cylinder", radius);
        if (!(low < high)) detail::reject("lower end of the cylinder", low, "below the upper one");
        axis_ = axis.normalized();
    }

    /// Of a way that leads in and out again nothing is left.
    int crossing(const Vector<3>& from, const Vector<3>& to) const {
        const Vector<3> a = across(from), b = across(to);
        const bool inside = a.norm() < radius_, ends_inside = b.norm() < radius_;
        if (inside == ends_inside) return 0;
        // |a + s (b - a)| = radius once for s in [0, 1].
        const Vector<3> way = b - a;
        const double p = way.squaredNorm(), q = a.dot(way), r = a.squaredNorm() - radius_ * radius_;
        const double root = std::sqrt(std::max(q * q - p * r, 0.0));
        const double s = inside ? (root - q) / p : -(q + root) / p;
        const double height = axis_.dot(from + s * (to - from) - foot_);
        if (!(height >= low_ && height < high_)) return 0;
        return inside ? 1 : -1;
    }
    Vector<3> normal_at(const Vector<3>& x) const { return across(x).normalized(); }
    double area() const { return 2.0 * std::numbers::pi * radius_ * (high_ - low_); }
    const Vector<3>& centre() const { return foot_; }

  private:
    Vector<3> across(const Vector<3>& x) const { return x - foot_ - axis_ * axis_.dot(x - foot_); }

    Vector<3> foot_, axis_;
    double radius_, low_, high_;
};

/// What is transmitted across a cut.
template <int Dim>
struct CutResultant {
    /// Of the bodies on the side that the normal points to upon those on the other [N]: over the
    /// area it is the stress vector sigma n, tension positive.
    Vector<Dim> force = Vector<Dim>::Zero();
    AngularVector<Dim> moment = AngularVector<Dim>::Zero();  ///< about the cut's centre [N m]
    /// Around a closed surface forces cancel: their sum along the surface's normals at the places
    /// where it is passed [N]. Of a flat one, force . normal.
    double along_normals = 0.0;
    std::size_t contacts = 0;  ///< that the cut divides
};

/// The resultant of the contact forces that bodies on one side of a surface exert upon those on the
/// other. A contact is divided by it if the line between the centres of its bodies is; of an
/// obstacle, which has no centre that means anything, the contact point stands for it. `forces` are
/// those of `contact_forces`: world axes, on body a [N]. Bodies themselves are not cut: over a
/// surface of few contacts the result scatters by the force of one. In a periodic cell each contact
/// counts once, where its first body is: right for surfaces that lattice vectors shift into
/// themselves; for others there is cell_stress. `couples`, where contacts transmit such beside
/// forces (rolling friction: moment impulses over the duration of the step): on body a, world axes
/// [N m]. O(contacts). Throws input_error unless there is one force per contact, and one couple or
/// none at all, and for contacts of bodies beyond the count.
template <int Dim, CutSurface<Dim> Surface>
CutResultant<Dim> cut_resultant(const Bodies<Dim>& bodies, const ContactJacobian<Dim>& jacobian,
                                std::span<const Vector<Dim>> forces, const Surface& surface,
                                std::span<const AngularVector<Dim>> couples = {}) {
    require_count("forces", forces.size(), "contacts", jacobian.contact_count());
    if (!couples.empty())
        require_count("couples", couples.size(), "contacts", jacobian.contact_count());
    jacobian.require_bodies(bodies.count());
    CutResultant<Dim> result;
    for (std::size_t c = 0; c < forces.size(); ++c) {
        const auto a = static_cast<std::size_t>(jacobian.a[c]);
        const auto b = static_cast<std::size_t>(jacobian.b[c]);
        const Vector<Dim> on_a = bodies.position[a] + jacobian.arm_a[c];
        Vector<Dim> centre_b = bodies.position[b];
        if (!jacobian.offset.empty()) centre_b += jacobian.offset[c];
        const Vector<Dim> on_b = centre_b + jacobian.arm_b[c];
        const Vector<Dim> from = bodies.is_obstacle(a) ? on_a : bodies.position[a];
        const Vector<Dim> to = bodies.is_obstacle(b) ? on_b : centre_b;
        const int side = surface.crossing(from, to);
        if (side == 0) continue;
        const Vector<Dim> force = side * forces[c];
        result.force += force;
        const Vector<Dim> at = 0.5 * (on_a + on_b);
        result.moment += moment<Dim>(Vector<Dim>(at - surface.centre()), force);
        if (!couples.empty()) result.moment += side * couples[c];
        result.along_normals += force.dot(Vector<Dim>(surface.normal_at(at)));
        ++result.contacts;
    }
    return result;
}

}  // namespace talus
