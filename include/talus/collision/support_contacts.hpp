// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/feature_code.hpp>
#include <talus/collision/gjk.hpp>
#include <talus/geometry/half_space.hpp>
#include <talus/geometry/shape_view.hpp>

#include <cmath>
#include <numbers>
#include <vector>

namespace talus {

namespace detail {

/// The separation of two convex sets along a direction, s(n) = n . w(n) with w = support of A along
/// -n minus support of B along n, and its maximum over unit n. Smooth sets have the gradient w, so
/// that the part of w across n vanishes at the maximum.
template <int Dim, class Support>
class Separation {
  public:
    Separation(const Support& support, double size) : support_(support), size_(size) {}

    Vector<Dim> w(const Vector<Dim>& n) const { return support_(-n).difference(); }
    double operator()(const Vector<Dim>& n) const { return n.dot(w(n)); }

    /// The best of evenly spread directions, improved until it moves by rounding only.
    Vector<Dim> best_direction() const {
        Vector<Dim> best = direction(0);
        for (int i = 1; i < direction_count; ++i)
            if ((*this)(direction(i)) > (*this)(best)) best = direction(i);
        return improved(best);
    }

  private:
    static constexpr int direction_count = Dim == 2 ? 64 : 256;

    /// Directions of the unit circle; of the sphere by the golden spiral.
    static Vector<Dim> direction(int i) {
        if constexpr (Dim == 2) {
            const double angle = 2.0 * std::numbers::pi * i / direction_count;
            return {std::cos(angle), std::sin(angle)};
        } else {
            const double z = (2.0 * i + 1.0) / direction_count - 1.0;
            const double angle = 2.0 * std::numbers::pi * i / std::numbers::phi;
            const double r = std::sqrt(1.0 - z * z);
            return {r * std::cos(angle), r * std::sin(angle), z};
        }
    }
    static Eigen::Matrix<double, Dim, Dim - 1> tangents(const Vector<Dim>& n) {
        Eigen::Matrix<double, Dim, Dim - 1> t;
        t.col(0) = n.unitOrthogonal();
        if constexpr (Dim == 3) t.col(1) = n.cross(t.col(0));
        return t;
    }
    /// Newton's method on the tangential gradient, its derivative by differences; where Newton does
    /// not climb, a step along the gradient that is halved until it does.
    Vector<Dim> improved(Vector<Dim> n) const {
        constexpr double step = 1e-5;  // balances truncation and rounding of a first difference
        for (int k = 0; k < 100; ++k) {
            const auto t = tangents(n);
            const double s = (*this)(n);
            const Vector<Dim - 1, double> g = t.transpose() * w(n);
            if (g.norm() <= 1e-13 * size_) break;
            Eigen::Matrix<double, Dim - 1, Dim - 1> slope;
            for (int c = 0; c < Dim - 1; ++c) {
                const Vector<Dim> up = n + step * t.col(c), down = n - step * t.col(c);
                slope.col(c) = t.transpose() * (w(up) - w(down)) / (2.0 * step);
            }
            // On the sphere the second derivative is slope - s; negative at a maximum.
            slope.diagonal().array() -= s;
            const Eigen::Matrix<double, Dim - 1, 1> newton = -slope.inverse() * g;
            Vector<Dim> next = (n + t * newton).normalized();
            if (!(newton.norm() < 0.5) || !((*this)(next) >= s)) {
                double length = 0.1 / g.norm();
                do {
                    next = (n + t * (length * g)).normalized();
                    length *= 0.5;
                } while (!((*this)(next) > s) && length * g.norm() > 1e-12);
                if (!((*this)(next) > s)) break;
            }
            n = next;
        }
        return n;
    }

    const Support& support_;
    double size_;
};

}  // namespace detail

namespace detail {

/// Contact of a convex shape with a half-space: its lowest point, code 0.
template <int Dim>
void append_lowest_point(const ShapeView<Dim>& a, const Pose<Dim>& pose_a, const HalfSpace<Dim>& b,
                         const Pose<Dim>& pose_b, double margin,
                         std::vector<ContactPoint<Dim>>& out) {
    const HalfSpace<Dim> wall = b.placed(pose_b);
    const Vector<Dim> x =
        pose_a.point_world(a.support(pose_a.rotation.transpose_times(-wall.normal())));
    const double gap = wall.normal().dot(x) - wall.offset();
    if (gap <= margin) out.push_back({x - 0.5 * gap * wall.normal(), wall.normal(), gap, {}});
}

}  // namespace detail

/// Contact of two shapes with support mappings by these alone: one point, of code 0. Apart,
/// the nearest points; overlapping, the direction in which the least displacement separates them,
/// accurate to 1e-10 of their size for smooth shapes. Shapes with corners deserve a routine of
/// their own (see PairContacts): one point does not hold a face still. B may be a half-space.
template <int Dim>
void append_support_contact(const ShapeView<Dim>& a, const Pose<Dim>& pose_a,
                            const ShapeView<Dim>& b, const Pose<Dim>& pose_b, double margin,
                            std::vector<ContactPoint<Dim>>& out) {
    if (b.kind() == ShapeKind::half_space)
        return detail::append_lowest_point<Dim>(a, pose_a, b.template as<HalfSpace<Dim>>(), pose_b,
                                                margin, out);
    const Aabb<Dim> box_a = a.aabb(pose_a), box_b = b.aabb(pose_b);
    if (margin >= 0.0 && !box_a.expanded(margin).overlaps(box_b)) return;
    const Vector<Dim> origin = 0.5 * (box_a.low + box_a.high);
    const auto support = [&](const Vector<Dim>& d) {
        return DifferencePoint<Dim>{
            pose_a.point_world(a.support(pose_a.rotation.transpose_times(d))) - origin,
            pose_b.point_world(b.support(pose_b.rotation.transpose_times(-d))) - origin};
    };
    const double size = std::min((box_a.high - box_a.low).norm(), (box_b.high - box_b.low).norm());
    const Vector<Dim> apart = origin - 0.5 * (box_b.low + box_b.high);
    const auto near = nearest_points<Dim>(
        support, apart.isZero(0.0) ? Vector<Dim>(Vector<Dim>::Unit(0)) : apart, size);
    if (near.distance > 1e-8 * size) {
        if (near.distance <= margin)
            out.push_back(
                {origin + 0.5 * (near.a + near.b), near.apart / near.distance, near.distance, {}});
        return;
    }
    const detail::Separation<Dim, decltype(support)> separation(support, size);
    const Vector<Dim> n = separation.best_direction();
    const DifferencePoint<Dim> touching = support(-n);
    const double gap = n.dot(touching.difference());
    if (gap <= margin) out.push_back({origin + 0.5 * (touching.a + touching.b), n, gap, {}});
}

}  // namespace talus
