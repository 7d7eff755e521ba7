// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/narrow_phase.hpp>
#include <talus/core/column.hpp>
#include <talus/geometry/any_shape.hpp>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <limits>
#include <vector>

#include "common/random_geometry.hpp"

/// What any pair of convex shapes must obey, whatever routine serves it.
template <int Dim>
class PairTester {
  public:
    using Shape = talus::AnyShape<Dim>;
    using Contacts = talus::Column<talus::ContactPoint<Dim>>;
    using Vector = talus::Vector<Dim>;
    using Pose = talus::Pose<Dim>;

    /// Shapes of size about `scale` [m].
    PairTester(Shape a, Shape b, double scale) : a_(a), b_(b), scale_(scale) {}

    Contacts contacts(const Pose& at_a, const Pose& at_b, double margin) const {
        Contacts out;
        talus::contact_points<Dim>(a_, at_a, b_, at_b, margin, out);
        return out;
    }

    void check(const Pose& at_a, const Pose& at_b, double margin) const {
        const Contacts found = contacts(at_a, at_b, margin);
        check_separation(found, at_a, at_b, margin);
        for (const auto& c : found) check_contact(c, at_a, at_b, margin);
        check_codes(found);
        check_exchange(found, at_a, at_b, margin);
        check_motion(found, at_a, at_b, margin);
    }

    /// Farthest extent of a placed shape along n [m].
    static double extent(const Shape& shape, const Pose& at, const Vector& n) {
        return shape.visit([&]<class S>(const S& s) {
            if constexpr (talus::ConvexShape<S, Dim>)
                return n.dot(at.point_world(s.support(at.rotation.transpose_times(n))));
            else
                return std::numeric_limits<double>::quiet_NaN();
        });
    }
    double separation(const Pose& at_a, const Pose& at_b, const Vector& n) const {
        return -extent(a_, at_a, -n) - extent(b_, at_b, n);
    }
    /// Largest separation over all directions: dense sampling, then a pattern search around the
    /// best few. A lower bound, and in all but contrived cases exact.
    double best_separation(const Pose& at_a, const Pose& at_b) const {
        std::vector<std::pair<double, Vector>> tried;
        const int count = Dim == 2 ? 360 : 1500;
        for (int i = 0; i < count; ++i) {
            const Vector n = spread(i, count);
            tried.emplace_back(separation(at_a, at_b, n), n);
        }
        std::ranges::sort(tried, [](auto& x, auto& y) { return x.first > y.first; });
        double best = tried.front().first;
        for (std::size_t k = 0; k < 12; ++k)
            best = std::max(best, climbed(at_a, at_b, tried[k].second, Dim == 2 ? 0.02 : 0.1));
        return best;
    }

  private:
    // Half the square of NarrowPhaseTolerance::alignment, by which gaps may exceed the shortest
    // way.
    static constexpr double slant = 5.1e-5;
    // Twice the tolerance of preference, for lengths of the order of the shapes.
    static constexpr double preference = 4e-6;

    static Vector spread(int i, int count) {
        if constexpr (Dim == 2) {
            const double angle = 2.0 * std::numbers::pi * i / count;
            return {std::cos(angle), std::sin(angle)};
        } else {
            const double z = (2.0 * i + 1.0) / count - 1.0, r = std::sqrt(1.0 - z * z);
            const double angle = i * 2.399963229728653;
            return {r * std::cos(angle), r * std::sin(angle), z};
        }
    }
    double climbed(const Pose& at_a, const Pose& at_b, Vector n, double step) const {
        double best = separation(at_a, at_b, n);
        random_geometry::Generator g(7);
        while (step > 1e-9) {
            bool better = false;
            for (int k = 0; k < (Dim == 2 ? 2 : 24); ++k) {
                Vector d = random_geometry::direction<Dim>(g);
                if constexpr (Dim == 2) d = (k == 0 ? 1.0 : -1.0) * n.unitOrthogonal();
                const Vector m = (n + step * d).normalized();
                const double s = separation(at_a, at_b, m);
                if (s > best) best = s, n = m, better = true;
            }
            if (!better) step *= 0.8;
        }
        return best;
    }

    void check_separation(const Contacts& found, const Pose& at_a, const Pose& at_b,
                          double margin) const {
        double best = best_separation(at_a, at_b);
        double least = std::numeric_limits<double>::infinity();
        for (const auto& c : found) {
            least = std::min(least, c.gap);
            best = std::max(best, separation(at_a, at_b, c.normal));
        }
        const double tolerance = slant * std::abs(best) + preference * scale_;
        if (found.empty())
            BOOST_CHECK_GT(best, margin - tolerance);
        else
            BOOST_CHECK_SMALL(least - best, tolerance);
    }
    void check_contact(const talus::ContactPoint<Dim>& c, const Pose& at_a, const Pose& at_b,
                       double margin) const {
        BOOST_CHECK_SMALL(c.normal.norm() - 1.0, 1e-12);
        BOOST_CHECK_LE(c.gap, margin);
        const Vector on_a = c.point + 0.5 * c.gap * c.normal;
        const Vector on_b = c.point - 0.5 * c.gap * c.normal;
        double out_of_a = -1.0, out_of_b = -1.0;
        for (int i = 0; i < 200; ++i) {
            const Vector n = spread(i, 200);
            out_of_a = std::max(out_of_a, n.dot(on_a) - extent(a_, at_a, n));
            out_of_b = std::max(out_of_b, n.dot(on_b) - extent(b_, at_b, n));
        }
        BOOST_CHECK_LE(out_of_a, preference * scale_);
        BOOST_CHECK_LE(out_of_b, preference * scale_);
    }
    void check_codes(const Contacts& found) const {
        for (std::size_t i = 0; i < found.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) BOOST_CHECK(found[i].feature != found[j].feature);
    }
    /// Every contact of `found` has one of `other` at the place, normal and gap it is mapped to.
    template <class Map>
    void check_same(const Contacts& found, const Contacts& other, double ratio, Map map) const {
        BOOST_CHECK_EQUAL(found.size(), other.size());
        for (const auto& c : found) {
            const std::pair<Vector, Vector> mapped = map(c);
            const bool met = std::ranges::any_of(other, [&](const auto& o) {
                return (o.point - mapped.first).norm() <= preference * scale_ * ratio &&
                       (o.normal - mapped.second).norm() <= 2e-2 &&
                       std::abs(o.gap - ratio * c.gap) <=
                           (preference * scale_ + slant * std::abs(c.gap)) * ratio;
            });
            BOOST_CHECK(met);
        }
    }
    void check_exchange(const Contacts& found, const Pose& at_a, const Pose& at_b,
                        double margin) const {
        const Contacts other = PairTester(b_, a_, scale_).contacts(at_b, at_a, margin);
        // Where faces of both are across the axis, each order prefers the face of its own A: the
        // normals then differ by up to the alignment, and the least gap by its slant.
        if (!found.empty() && !other.empty() && (found[0].normal + other[0].normal).norm() > 1e-6) {
            const auto less = [](const auto& x, const auto& y) { return x.gap < y.gap; };
            const double least = std::min_element(found.begin(), found.end(), less)->gap;
            BOOST_CHECK_SMALL(least - std::min_element(other.begin(), other.end(), less)->gap,
                              2.0 * slant * std::abs(least) + preference * scale_);
            return;
        }
        check_same(found, other, 1.0,
                   [](const auto& c) { return std::pair<Vector, Vector>(c.point, -c.normal); });
    }
    void check_motion(const Contacts& found, const Pose& at_a, const Pose& at_b,
                      double margin) const {
        random_geometry::Generator g(11);
        const Pose motion = random_geometry::pose<Dim>(g, 3.0 * scale_);
        check_same(found, contacts(motion * at_a, motion * at_b, margin), 1.0, [&](const auto& c) {
            return std::pair<Vector, Vector>(motion.point_world(c.point),
                                             motion.rotation * c.normal);
        });
    }

    Shape a_, b_;
    double scale_;
};
