// SPDX-License-Identifier: BSL-1.0
#include <talus/law/friction_cone.hpp>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>

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

// What steep_error leaves out on slopes up to 0.8.
BOOST_AUTO_TEST_CASE_TEMPLATE(gentle_cones_hide_nothing_from_the_natural_map, D, dimensions) {
    constexpr int Dim = D::value;
    using Vec = talus::Vector<Dim>;
    RandomBlocks random(17);
    for (const double mu : {0.0, 0.1, 0.3, 0.5, 0.8})
        for (int k = 0; k < 20000; ++k) {
            const talus::FrictionCone<Dim> cone{mu};
            const double size = std::pow(10.0, -(k % 5));
            Vec u = size * random.normal<Dim>(), r = random.normal<Dim>();
            if (k % 2 == 0) r = cone.project(r);
            if (k % 3 == 0) u[0] = 0.0;
            const double p = std::max(0.0, r[0] - u[0]);
            Vec wanted = r - u;
            wanted[0] = 0.0;
            if (wanted.norm() > mu * p) wanted *= mu * p / wanted.norm();
            wanted[0] = p;
            const double error =
                (r - cone.project(r - talus::de_saxce_corrected<Dim>(u, mu))).norm();
            BOOST_TEST_REQUIRE(0.5 * (r - wanted).norm() <= error + 1e-15);
            BOOST_TEST_REQUIRE(cone.steep_error(u, r, 1.0) == 0.0);
        }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(steep_cones_do_not_hide_what_friction_lacks, D, dimensions) {
    constexpr int Dim = D::value;
    using Vec = talus::Vector<Dim>;
    const talus::FrictionCone<Dim> cone{1000.0};
    // It slides, and presses with 1: friction is 1000, or as much as stops it.
    const Vec slides = 1e4 * Vec::Unit(1), presses = Vec::Unit(0);
    const Vec held = presses - 1000.0 * Vec::Unit(1);
    BOOST_TEST(cone.steep_error(slides, presses, 1.0) == 500.0, boost::test_tools::tolerance(1e-9));
    BOOST_TEST(cone.steep_error(slides, held, 1.0) < 1e-9);
    BOOST_TEST(cone.steep_error(Vec(Vec::Zero()), presses, 1.0) == 0.0);
    // Twice the mass and impulses in the same proportion: twice the error.
    BOOST_TEST(cone.steep_error(slides, Vec(2.0 * presses), 2.0) == 1000.0,
               boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_SUITE_END()
