// SPDX-License-Identifier: BSL-1.0
#include <talus/core/cross.hpp>
#include <talus/spatial/inertia.hpp>
#include <talus/spatial/rotation.hpp>

#include <Eigen/LU>
#include <boost/test/unit_test.hpp>

#include <numbers>

#include "common/dimensions.hpp"
#include "common/random.hpp"

BOOST_AUTO_TEST_SUITE(spatial_rotation)

// Some ten roundings of numbers of order 1.
constexpr double tolerance = 4e-15;

BOOST_AUTO_TEST_CASE_TEMPLATE(the_group_laws_hold, D, dimensions) {
    constexpr int Dim = D::value;
    std::mt19937 rng(11);
    for (int k = 0; k < 50; ++k) {
        const auto a = random_input::rotation<Dim>(rng);
        const auto b = random_input::rotation<Dim>(rng);
        const auto v = random_input::vector<talus::Vector<Dim>>(rng);
        BOOST_CHECK_SMALL(((a * b) * v - a * (b * v)).norm(), tolerance);
        BOOST_CHECK_SMALL((a.inverse() * (a * v) - v).norm(), tolerance);
        BOOST_CHECK_SMALL((a.transpose_times(v) - a.inverse() * v).norm(), tolerance);
        BOOST_CHECK_SMALL((a.matrix() * v - a * v).norm(), tolerance);
        BOOST_CHECK_SMALL((a * v).norm() - v.norm(), tolerance);
        BOOST_CHECK_SMALL(
            (talus::Rotation<Dim>::from_matrix(a.matrix()).matrix() - a.matrix()).norm(),
            tolerance);
        BOOST_CHECK_CLOSE(a.matrix().determinant(), 1.0, 1e-12);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(exp_and_log_are_inverse_also_for_tiny_turns, D, dimensions) {
    constexpr int Dim = D::value;
    using Spin = talus::AngularVector<Dim>;
    std::mt19937 rng(12);
    for (double size : {1e-300, 1e-12, 1e-5, 1.0001e-4, 0.99e-4, 0.1, 1.0, 3.1}) {
        const Spin w = size * random_input::unit<Spin>(rng);
        const Spin back = talus::Rotation<Dim>::exp(w).log();
        BOOST_CHECK_SMALL((back - w).norm() / size, 1e-14);
    }
    BOOST_CHECK(talus::Rotation<Dim>::exp(Spin::Zero()).log().isZero(0.0));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(exp_turns_at_constant_spin, D, dimensions) {
    constexpr int Dim = D::value;
    using Spin = talus::AngularVector<Dim>;
    using talus::Rotation;
    std::mt19937 rng(13);
    const Spin w = random_input::vector<Spin>(rng);
    const auto v = random_input::vector<talus::Vector<Dim>>(rng);
    const auto twice = Rotation<Dim>::exp(w) * Rotation<Dim>::exp(w);
    BOOST_CHECK_SMALL((twice * v - Rotation<Dim>::exp(2.0 * w) * v).norm(), tolerance);
    const double eps = 1e-6;  // central difference: error eps^2 + rounding/eps
    const talus::Vector<Dim> slope =
        (Rotation<Dim>::exp(eps * w) * v - Rotation<Dim>::exp(-eps * w) * v) / (2 * eps);
    BOOST_CHECK_SMALL((slope - talus::cross<Dim>(w, v)).norm(), 1e-9);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(the_distance_bounds_how_far_unit_vectors_part, D, dimensions) {
    constexpr int Dim = D::value;
    std::mt19937 rng(14);
    for (int k = 0; k < 200; ++k) {
        const auto a = random_input::rotation<Dim>(rng);
        const auto b = k % 2 ? random_input::rotation<Dim>(rng)
                             : a * talus::Rotation<Dim>::exp(
                                       random_input::vector<talus::AngularVector<Dim>>(rng, 1e-3));
        const auto v = random_input::unit<talus::Vector<Dim>>(rng);
        BOOST_CHECK_LE((a * v - b * v).norm(), a.distance(b) * (1 + 1e-12) + 1e-15);
        BOOST_CHECK_EQUAL(a.distance(a), 0.0);
    }
}

BOOST_AUTO_TEST_CASE(a_turn_about_z_is_a_turn_of_the_plane) {
    const double angle = 0.7;
    const talus::Rotation<2> plane(angle);
    const auto space = talus::Rotation<3>::exp({0.0, 0.0, angle});
    BOOST_CHECK_SMALL((space.matrix().topLeftCorner<2, 2>() - plane.matrix()).norm(), tolerance);
    BOOST_CHECK_CLOSE(plane.angle(), angle, 1e-12);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(the_inertia_tensor_turns_with_the_body, D, dimensions) {
    constexpr int Dim = D::value;
    using Spin = talus::AngularVector<Dim>;
    std::mt19937 rng(15);
    const auto r = random_input::rotation<Dim>(rng);
    Spin moments = random_input::vector<Spin>(rng).cwiseAbs();
    const Spin w = random_input::vector<Spin>(rng);
    const Spin momentum = r.spin_world(moments.cwiseProduct(r.spin_body(w)));
    BOOST_CHECK_SMALL((talus::tensor_world<Dim>(r, moments) * w - momentum).norm(), tolerance);
}

BOOST_AUTO_TEST_SUITE_END()
