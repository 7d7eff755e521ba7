// SPDX-License-Identifier: BSL-1.0
#include <talus/law/friction_cone.hpp>

#include <boost/test/unit_test.hpp>

#include "common/dimensions.hpp"
#include "common/random_blocks.hpp"

BOOST_AUTO_TEST_SUITE(friction_cone)
constexpr double rounding = 1e-14;  // some ulps of vectors of length of order one
const std::initializer_list<double> slopes = {0.0, 1e-9, 0.3, 1.0, 7.0, 1e9};

// The projection is the one point with: y in K, x - y in the polar cone, the two orthogonal.
BOOST_AUTO_TEST_CASE_TEMPLATE(projection_has_its_defining_properties, D, dimensions) {
    RandomBlocks random(11);
    for (const double mu : slopes) {
        const talus::FrictionCone<D::value> cone{mu};
        for (int k = 0; k < 2000; ++k) {
            const talus::Vector<D::value> x = random.unit<D::value>();
            const talus::Vector<D::value> y = cone.project(x);
            const talus::Vector<D::value> z = y - x;
            const double t = y.template tail<D::value - 1>().norm();
            BOOST_TEST(t <= mu * y[0] * (1.0 + rounding) + 1e-300);
            BOOST_TEST(mu * z.template tail<D::value - 1>().norm() <= z[0] + rounding * (1.0 + mu));
            BOOST_TEST(std::abs(y.dot(z)) <= rounding);
            BOOST_TEST((cone.project_dual(x) - (x + cone.project(-x))).norm() == 0.0);
        }
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(points_of_the_cone_and_of_its_polar_are_exact, D, dimensions) {
    using Vec = talus::Vector<D::value>;
    const talus::FrictionCone<D::value> frictionless{0.0};
    const Vec down = -Vec::Unit(0);
    BOOST_TEST(frictionless.project(down).norm() == 0.0);
    const Vec up = Vec::Unit(0);
    BOOST_TEST((frictionless.project(up) - up).norm() == 0.0);
    const Vec inside = Vec::Unit(0) + 0.5 * Vec::Unit(1);
    const talus::FrictionCone<D::value> cone{0.5};
    BOOST_TEST(cone.contains(inside));
    BOOST_TEST((cone.project(inside) - inside).norm() == 0.0);
    BOOST_TEST(!cone.contains(down));
    BOOST_TEST(cone.dual_contains(inside));
    BOOST_TEST(!cone.dual_contains(down));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(corrected_velocity_is_dual_iff_normal_is_not_negative, D,
                              dimensions) {
    using Vec = talus::Vector<D::value>;
    const Vec u = 2.0 * Vec::Unit(0) - 3.0 * Vec::Unit(D::value - 1);
    BOOST_TEST((talus::de_saxce_corrected<D::value>(u, 0.5) - (u + 1.5 * Vec::Unit(0))).norm() ==
               0.0);
    BOOST_TEST(talus::FrictionCone<D::value>{0.5}.dual_contains(
        talus::de_saxce_corrected<D::value>(u, 0.5)));
    const Vec approaching = u - 2.001 * Vec::Unit(0);
    BOOST_TEST(!talus::FrictionCone<D::value>{0.5}.dual_contains(
        talus::de_saxce_corrected<D::value>(approaching, 0.5)));
}

BOOST_AUTO_TEST_SUITE_END()
