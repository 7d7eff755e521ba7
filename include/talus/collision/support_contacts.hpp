// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/feature_code.hpp>
#include <talus/collision/gjk.hpp>
#include <talus/collision/wall_contacts.hpp>
#include <talus/core/column.hpp>
#include <talus/core/input.hpp>
#include <talus/geometry/half_space.hpp>
#include <talus/geometry/round_hole.hpp>
#include <talus/geometry/shape_view.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace talus {

namespace detail {

/// The hull of some points of A - B, grown by supports where it comes nearest to the origin (the
/// expanding polytope [VanDenBergen2001]): no direction has a depth below the least distance of its
/// facets, so that none is missed, however flat the sets.
template <int Dim, class Support>
class InnerHull {
  public:
    explicit InnerHull(const Support& support) : support_(support) {}

    /// The direction of least depth, up to `accuracy` of the depth or the capacity.
    Vector<Dim> best_direction() {
        begin();
        while (facet_count_ > 0 && point_count_ < capacity) {
            Facet* const first = facets_.data();
            Facet* const found = std::min_element(
                first, first + facet_count_,
                [](const Facet& f, const Facet& g) { return f.distance < g.distance; });
            const Facet nearest = *found;
            if (nearest.distance >= (1.0 - accuracy) * best_depth_) break;
            const Vector<Dim> w = farthest(nearest.normal);
            // A facet of A - B itself: what is left of its depth is rounding.
            if (!(nearest.normal.dot(w) - nearest.distance > rounding * size_)) break;
            std::swap(*found, facets_[--facet_count_]);
            grow(nearest, w);
        }
        return best_;
    }

  private:
    /// Points it may have: what the accuracy takes for balls one in the other.
    static constexpr std::size_t capacity = Dim == 2 ? 64 : 256;
    /// Two directions as near to each other in depth may be mistaken; a smaller one costs more
    /// points where the sets are round, their number growing as one over it.
    static constexpr double accuracy = 1e-3;
    static constexpr double rounding = 1e-14;  // of the size of A - B

    struct Facet {
        std::array<std::size_t, Dim> corner;
        Vector<Dim> normal;  ///< outwards
        double distance;     ///< of its plane from the origin, positive if that is inside
    };

    /// The support of A - B along m.
    Vector<Dim> farthest(const Vector<Dim>& m) {
        const Vector<Dim> w = support_(m).difference();
        if (const double depth = m.dot(w); depth < best_depth_) {
            best_depth_ = depth;
            best_ = -m;
        }
        return w;
    }
    /// A simplex of points far from each other. There is none, and no facet, if A - B is flat: then
    /// the direction across has been tried.
    void begin() {
        std::array<Vector<Dim>, 2 * static_cast<std::size_t>(Dim)> w;
        for (std::size_t i = 0; i < w.size(); ++i)
            w[i] = farthest((i % 2 == 0 ? 1.0 : -1.0) * Vector<Dim>::Unit(static_cast<int>(i / 2)));
        for (const Vector<Dim>& p : w)
            for (const Vector<Dim>& q : w)
                if ((p - q).norm() > size_) {
                    size_ = (p - q).norm();
                    points_[0] = p;
                    points_[1] = q;
                }
        if (size_ == 0.0) return;
        const Vector<Dim> along = (points_[1] - points_[0]) / size_;
        Vector<Dim> off = Vector<Dim>::Zero();
        const auto consider = [&](const Vector<Dim>& p) {
            const Vector<Dim> from = p - points_[0], q = from - along * along.dot(from);
            if (q.norm() <= off.norm()) return;
            off = q;
            points_[2] = p;
        };
        for (const Vector<Dim>& p : w) consider(p);
        const Vector<Dim> across = along.unitOrthogonal();
        consider(farthest(across));
        consider(farthest(-across));
        if constexpr (Dim == 3) {
            consider(farthest(along.cross(across)));
            consider(farthest(across.cross(along)));
        }
        if (off.norm() <= rounding * size_) return;
        if constexpr (Dim == 3) {
            const Vector<3> n = along.cross(off).normalized();
            const Vector<3> up = farthest(n), down = farthest(-n);
            const double over = n.dot(up - points_[0]), under = n.dot(points_[0] - down);
            if (std::max(over, under) <= rounding * size_) return;
            points_[3] = over > under ? up : down;
        }
        point_count_ = Dim + 1;
        for (std::size_t skip = 0; skip <= Dim; ++skip) {
            std::array<std::size_t, Dim> corner{};
            for (std::size_t i = 0, k = 0; i <= Dim; ++i)
                if (i != skip) corner[k++] = i;
            const Facet f = facet(corner);
            if (f.normal.dot(points_[skip]) > f.distance) std::swap(corner[0], corner[1]);
            facets_[facet_count_++] = facet(corner);
        }
    }
    Facet facet(const std::array<std::size_t, Dim>& c) const {
        Vector<Dim> n;
        const Vector<Dim> side = points_[c[1]] - points_[c[0]];
        if constexpr (Dim == 2)
            n = Vector<2>(side[1], -side[0]);
        else
            n = side.cross(points_[c[2]] - points_[c[0]]);
        // One without extent looks nowhere: it is never the nearest and never gives way.
        if (!(n.squaredNorm() > 0.0)) return {c, n, std::numeric_limits<double>::infinity()};
        n.normalize();
        return {c, n, n.dot(points_[c[0]])};
    }
    /// The facet `from`, which is taken out already, and those around it that the new point is
    /// outside of as well give way to those that join it with their outline. Only what hangs
    /// together: where rounding shows the point outside of other facets, which are flush with it,
    /// an outline of their own would be joined the wrong way round.
    void grow(const Facet& from, const Vector<Dim>& w) {
        outline_count_ = 0;
        add_to_outline(from);
        for (bool more = true; more;) {
            more = false;
            for (std::size_t i = 0; i < facet_count_;) {
                const Facet f = facets_[i];
                if (!(f.normal.dot(w) > f.distance) || !borders_outline(f)) {
                    ++i;
                    continue;
                }
                add_to_outline(f);
                facets_[i] = facets_[--facet_count_];
                more = true;
            }
        }
        const std::size_t added = point_count_++;
        points_[added] = w;
        for (std::size_t i = 0; i < outline_count_ && facet_count_ < facets_.size(); ++i) {
            const auto [p, q] = outline_[i];
            if constexpr (Dim == 2)
                facets_[facet_count_++] = q == 0 ? facet({p, added}) : facet({added, p});
            else
                facets_[facet_count_++] = facet({p, q, added});
        }
    }

    /// What two facets share, the one way round in one of them and the other in the other: an edge
    /// from corner to corner; in the plane a corner, at the first or the second place.
    using Ridge = std::array<std::size_t, 2>;
    static std::array<Ridge, Dim> ridges(const Facet& f) {
        if constexpr (Dim == 2)
            return {Ridge{f.corner[0], 0}, Ridge{f.corner[1], 1}};
        else
            return {Ridge{f.corner[0], f.corner[1]}, Ridge{f.corner[1], f.corner[2]},
                    Ridge{f.corner[2], f.corner[0]}};
    }
    static Ridge reversed(const Ridge& r) {
        if constexpr (Dim == 2)
            return {r[0], 1 - r[1]};
        else
            return {r[1], r[0]};
    }
    /// Where the outline has it; its end if it has not.
    Ridge* in_outline(const Ridge& r) {
        return std::find(outline_.data(), outline_.data() + outline_count_, r);
    }
    bool borders_outline(const Facet& f) {
        for (const Ridge& r : ridges(f))
            if (in_outline(reversed(r)) != outline_.data() + outline_count_) return true;
        return false;
    }
    /// What the facet shares with one that the outline surrounds is no part of it any more.
    void add_to_outline(const Facet& f) {
        for (const Ridge& r : ridges(f)) {
            Ridge* const other = in_outline(reversed(r));
            if (other != outline_.data() + outline_count_)
                *other = outline_[--outline_count_];
            else if (outline_count_ < outline_.size())
                outline_[outline_count_++] = r;
        }
    }

    const Support& support_;
    std::array<Vector<Dim>, capacity> points_;
    std::array<Facet, 2 * capacity> facets_;
    std::array<Ridge, 6 * capacity> outline_;
    std::size_t point_count_ = 0, facet_count_ = 0, outline_count_ = 0;
    double size_ = 0.0;
    Vector<Dim> best_ = Vector<Dim>::Unit(0);
    double best_depth_ = std::numeric_limits<double>::infinity();
};

/// Two overlapping convex sets, and the least displacement that separates them: the maximum over
/// unit n of s(n) = n . w(n), where w(n) is the support of A along -n minus that of B along n.
///
/// Moved apart by d - s(n) along n the sets are d away from each other along n, hence at least d in
/// all, and if m is the direction of their nearest points then s(m) >= s(n): the distance is
/// d' = s(m) + (d - s(n)) m.n >= d, where m.n <= 1. So n -> m climbs, whatever the sets, and the
/// nearest points of the sets moved apart, moved back, are where they meet: also on faces, where a
/// support is a corner far away.
template <int Dim, class Support>
class Overlap {
  public:
    /// `size` is that of the smaller set.
    Overlap(const Support& support, double size)
        : support_(support), size_(size), away_(0.1 * size) {}

    struct Contact {
        Vector<Dim> normal;
        double gap;
        DifferencePoint<Dim> points;  ///< of A and B that the normal pushes upon each other
    };

    Contact deepest() const { return climb(InnerHull<Dim, Support>(support_).best_direction()); }

    /// The contact at the maximum that n -> m leads to: on flat sets in a step or two, on round
    /// ones the slower the nearer the depth comes to their radii.
    Contact climb(Vector<Dim> n) const {
        double s = separation(n);
        Contact contact = step(n, s);
        Vector<Dim> move = Vector<Dim>::Zero();
        for (int k = 0; k < 30; ++k) {
            const double next = separation(contact.normal);
            if (!(next > s + 1e-15 * size_)) break;
            const double before = move.norm();
            move = contact.normal - n;
            n = contact.normal;
            s = next;
            // Near a smooth maximum the moves shrink by a constant factor: all that are to come in
            // one, or less where that is beyond an edge.
            if (const double q = move.norm() / before; q < 1.0) {
                Vector<Dim> rest = q / (1.0 - q) * move;
                for (int j = 0; j < 6; ++j, rest *= 0.25) {
                    const Vector<Dim> beyond = (n + rest).normalized();
                    if (const double there = separation(beyond); there > s) {
                        n = beyond;
                        s = there;
                        break;
                    }
                }
            }
            contact = step(n, s);
        }
        return contact;
    }

    double away() const { return away_; }

  private:
    double separation(const Vector<Dim>& n) const { return n.dot(support_(-n).difference()); }

    /// From n, where the sets are s apart, to the next direction, with gap and points along it.
    Contact step(const Vector<Dim>& n, double s) const {
        const Vector<Dim> shift = (away_ - s) * n;
        const auto near = nearest_points<Dim>(
            [&](const Vector<Dim>& d) {
                const DifferencePoint<Dim> p = support_(d);
                return DifferencePoint<Dim>{p.a + shift, p.b};
            },
            n, size_);
        if (!(near.distance > 0.0)) return {n, s, support_(-n)};
        const Vector<Dim> m = near.apart / near.distance;
        const DifferencePoint<Dim> points{near.a - shift, near.b};
        return {m, m.dot(points.difference()), points};
    }

    const Support& support_;
    double size_;
    /// d above [m]: small, so that few steps are needed, yet so large that the rounding of places
    /// does not turn the direction of the nearest points.
    double away_;
};

/// The support of a placed shape along d. Throws input_error if it is no number, which no test of a
/// margin would show.
template <int Dim>
Vector<Dim> placed_support(const ShapeView<Dim>& shape, const Pose<Dim>& pose,
                           const Vector<Dim>& d) {
    const Vector<Dim> along = pose.rotation.transpose_times(d), point = shape.support(along);
    if (!point.allFinite()) {
        std::string direction;
        for (int k = 0; k < Dim; ++k) direction += (k > 0 ? ", " : "") + text_of(along[k]);
        reject("support of a shape along (" + direction + ")", point.sum(), "finite");
    }
    return pose.point_world(point);
}

/// Contact of a convex shape with a half-space: its lowest point, code 0.
template <int Dim>
void append_lowest_point(const ShapeView<Dim>& a, const Pose<Dim>& pose_a, const HalfSpace<Dim>& b,
                         const Pose<Dim>& pose_b, double margin, Column<ContactPoint<Dim>>& out) {
    const HalfSpace<Dim> wall = b.placed(pose_b);
    const Vector<Dim> x = placed_support(a, pose_a, Vector<Dim>(-wall.normal()));
    const double gap = wall.normal().dot(x) - wall.offset();
    if (gap <= margin) out.push_back({x - 0.5 * gap * wall.normal(), wall.normal(), gap, {}});
}

}  // namespace detail

/// Contact of two shapes with support mappings by these alone: one point, of code 0. Apart,
/// the nearest points; overlapping, the direction in which the least displacement separates them,
/// and the places that separate last: the two agree where they meet, at gap 0. The gap is accurate
/// to 1e-10 of the smaller size, a point to 1e-7 of it for equal sizes and to the square root of
/// their ratio times that. Where two ways out are the same to 1e-3 of the depth either may be
/// taken. Shapes with corners deserve a routine of their own (see PairContacts): one point does not
/// hold a face still. B may be a wall.
template <int Dim>
void append_support_contact(const ShapeView<Dim>& a, const Pose<Dim>& pose_a,
                            const ShapeView<Dim>& b, const Pose<Dim>& pose_b, double margin,
                            Column<ContactPoint<Dim>>& out) {
    if (b.kind() == ShapeKind::half_space)
        return detail::append_lowest_point<Dim>(a, pose_a, b.template as<HalfSpace<Dim>>(), pose_b,
                                                margin, out);
    if (b.kind() == ShapeKind::hole)
        return append_hole_contact_by_support<Dim>(a, pose_a, b.template as<RoundHole<Dim>>(),
                                                   pose_b, margin, out);
    const Aabb<Dim> box_a = a.aabb(pose_a), box_b = b.aabb(pose_b);
    if (margin >= 0.0 && !box_a.expanded(margin).overlaps(box_b)) return;
    const double size_a = (box_a.high - box_a.low).norm(), size_b = (box_b.high - box_b.low).norm();
    const double size = std::min(size_a, size_b);
    const Vector<Dim> centre_a = 0.5 * (box_a.low + box_a.high),
                      centre_b = 0.5 * (box_b.low + box_b.high);
    const Vector<Dim> origin = size_a < size_b ? centre_a : centre_b;
    const auto support = [&](const Vector<Dim>& d) {
        return DifferencePoint<Dim>{detail::placed_support(a, pose_a, d) - origin,
                                    detail::placed_support(b, pose_b, Vector<Dim>(-d)) - origin};
    };
    const Vector<Dim> start =
        centre_a == centre_b ? Vector<Dim>(Vector<Dim>::Unit(0)) : Vector<Dim>(centre_a - centre_b);
    const auto near = nearest_points<Dim>(support, start, size);
    const auto add = [&](const DifferencePoint<Dim>& p, const Vector<Dim>& normal, double gap) {
        if (gap <= margin) out.push_back({origin + 0.5 * (p.a + p.b), normal, gap, {}});
    };
    // Far apart the nearest points are good as they are; nearer, their rounding shows in the
    // normal.
    if (near.distance > std::max(margin, 0.0) + 1e-6 * size) return;
    const detail::Overlap<Dim, decltype(support)> overlap(support, size);
    if (near.distance > overlap.away())
        return add({near.a, near.b}, near.apart / near.distance, near.distance);
    if (near.distance > 0.0) {
        const auto c = overlap.climb(near.apart / near.distance);
        if (c.gap > 0.0) return add(c.points, c.normal, c.gap);
    }
    const auto c = overlap.deepest();
    add(c.points, c.normal, c.gap);
}

}  // namespace talus
