// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/geometry/principal_shape.hpp>

#include <Eigen/Core>
#include <boost/test/unit_test.hpp>

#include <cmath>

#include "common/random_geometry.hpp"

/// What any solid shape must obey. `inside(x)` is an independent test of membership.
template <int Dim, talus::SolidShape<Dim> S, class Inside>
class ShapeTester {
  public:
    using Vector = talus::Vector<Dim>;
    using Pose = talus::Pose<Dim>;

    ShapeTester(const S& shape, Inside inside) : shape_(shape), inside_(inside) {}

    void check() const {
        check_volume_integrals();
        check_bounds_and_support();
        check_placing();
        check_principal_frame();
        check_record();
    }

  private:
    // Sampling 200^2 or 60^3 midpoints: an error of one cell at the surface, half of that cancels.
    static constexpr double sampling = 0.02;
    static constexpr double rounding = 1e-12;

    static talus::AngularMatrix<Dim> inertia(const talus::Matrix<Dim>& second) {
        if constexpr (Dim == 2)
            return talus::AngularMatrix<2>(second(0, 0) + second(1, 1));
        else
            return second.trace() * talus::Matrix<3>::Identity() - second;
    }
    void check_volume_integrals() const {
        const talus::Aabb<Dim> box = shape_.aabb(Pose{});
        const int count = Dim == 2 ? 200 : 60;
        const Vector cell = (box.high - box.low) / count;
        double volume = 0.0;
        Vector first = Vector::Zero();
        talus::Matrix<Dim> second = talus::Matrix<Dim>::Zero();
        const int total = Dim == 2 ? count * count : count * count * count;
        for (int i = 0; i < total; ++i) {
            Vector x;
            for (int k = 0, rest = i; k < Dim; ++k, rest /= count)
                x[k] = box.low[k] + (rest % count + 0.5) * cell[k];
            if (!inside_(x)) continue;
            volume += cell.prod();
            first += cell.prod() * x;
            second += cell.prod() * x * x.transpose();
        }
        const talus::MassProperties<Dim> m = shape_.mass_properties();
        const double size = (box.high - box.low).norm();
        BOOST_CHECK_CLOSE_FRACTION(m.volume, volume, sampling);
        BOOST_CHECK_SMALL((m.centroid - first / volume).norm(), sampling * size);
        second -= first * first.transpose() / volume;
        BOOST_CHECK_SMALL((m.inertia - inertia(second)).norm(), sampling * volume * size * size);
    }
    /// A shape that was written down, placed or not, is the same to the last bit.
    void check_record() const {
        if constexpr (talus::Recordable<S>) {
            random_geometry::Generator g(9);
            for (const S& s : {shape_, shape_.placed(random_geometry::pose<Dim>(g, 2.0))}) {
                const talus::NumberRecord record = talus::record_of(s);
                const S same = talus::from_record<S>(record);
                BOOST_TEST((talus::record_of(same) == record));
                const Pose at = random_geometry::pose<Dim>(g, 2.0);
                BOOST_TEST((same.aabb(at).low == s.aabb(at).low));
                BOOST_TEST((same.mass_properties().inertia == s.mass_properties().inertia));
            }
        }
    }
    /// The box is tight; no inner point is farther than the support, which is on the shape.
    void check_bounds_and_support() const {
        random_geometry::Generator g(3);
        for (int trial = 0; trial < 20; ++trial) {
            const Pose at = random_geometry::pose<Dim>(g, 2.0);
            const talus::Aabb<Dim> box = shape_.aabb(at);
            if constexpr (talus::ConvexShape<S, Dim>) {
                for (int k = 0; k < Dim; ++k)
                    for (const double sign : {-1.0, 1.0}) {
                        const Vector axis = sign * Vector::Unit(k);
                        const double reach = axis.dot(
                            at.point_world(shape_.support(at.rotation.transpose_times(axis))));
                        const double side = sign > 0.0 ? box.high[k] : -box.low[k];
                        BOOST_CHECK_SMALL(reach - side, rounding);
                    }
                const Vector d = 3.0 * random_geometry::direction<Dim>(g);
                const Vector farthest = shape_.support(d);
                const Vector c = shape_.mass_properties().centroid;
                BOOST_CHECK(inside_(c + (1.0 - 1e-9) * (farthest - c)));
            }
            const talus::Aabb<Dim> rest = shape_.aabb(Pose{});
            for (int i = 0; i < 200; ++i) {
                Vector x;
                for (int k = 0; k < Dim; ++k)
                    x[k] = random_geometry::uniform(g, rest.low[k], rest.high[k]);
                if (!inside_(x)) continue;
                const Vector y = at.point_world(x);
                BOOST_CHECK(((y - box.low).array() >= -rounding).all() &&
                            ((box.high - y).array() >= -rounding).all());
                if constexpr (talus::ConvexShape<S, Dim>) {
                    const Vector d = random_geometry::direction<Dim>(g);
                    BOOST_CHECK_LE(d.dot(x), d.dot(shape_.support(d)) + rounding);
                }
            }
        }
    }
    /// Placing the shape and placing its frame are the same.
    void check_placing() const {
        random_geometry::Generator g(4);
        const Pose inner = random_geometry::pose<Dim>(g, 1.0),
                   at = random_geometry::pose<Dim>(g, 1.0);
        const S moved = shape_.placed(inner);
        const talus::Aabb<Dim> x = moved.aabb(at), y = shape_.aabb(at * inner);
        BOOST_CHECK_SMALL((x.low - y.low).norm() + (x.high - y.high).norm(), rounding);
        const auto m = shape_.mass_properties(), n = moved.mass_properties();
        BOOST_CHECK_CLOSE_FRACTION(m.volume, n.volume, rounding);
        BOOST_CHECK_SMALL((inner.point_world(m.centroid) - n.centroid).norm(), rounding);
        BOOST_CHECK_SMALL(m.inertia.trace() - n.inertia.trace(), rounding * m.inertia.trace());
    }
    void check_principal_frame() const {
        const auto body = talus::in_principal_frame<Dim>(shape_);
        const auto m = body.shape.mass_properties();
        BOOST_CHECK_SMALL(m.centroid.norm(), rounding);
        BOOST_CHECK_SMALL(
            (m.inertia - talus::AngularMatrix<Dim>(body.frame.moments.asDiagonal())).norm(),
            rounding * m.inertia.norm());
        const talus::Aabb<Dim> x = body.shape.aabb(body.frame.pose), y = shape_.aabb(Pose{});
        BOOST_CHECK_SMALL((x.low - y.low).norm() + (x.high - y.high).norm(), rounding);
    }

    S shape_;
    Inside inside_;
};
