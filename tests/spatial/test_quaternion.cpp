// SPDX-License-Identifier: BSL-1.0
// The oracle is Eigen's quaternion, component by component.
#include <talus/spatial/quaternion.hpp>
#include <talus/spatial/rotation.hpp>

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>

#include <limits>

#include "common/random.hpp"

BOOST_AUTO_TEST_SUITE(spatial_quaternion)

// Some roundings of numbers of order 1: with fused multiplications and additions, the two may
// differ by them.
constexpr double rounding = 4.0 * std::numeric_limits<double>::epsilon();

double largest(const Eigen::MatrixXd& m) { return m.cwiseAbs().maxCoeff(); }

Eigen::Quaterniond any_quaternion(std::mt19937& rng) {
    const auto c = random_input::vector<talus::Vector<4>>(rng);
    return {c[0], c[1], c[2], c[3]};
}

BOOST_AUTO_TEST_CASE(operations_are_those_of_eigen) {
    std::mt19937 rng(31);
    for (int k = 0; k < 200; ++k) {
        const Eigen::Quaterniond p = any_quaternion(rng), q = any_quaternion(rng);
        const talus::Quaternion a(p), b(q);
        BOOST_TEST((a.w() == p.w() && a.x() == p.x() && a.y() == p.y() && a.z() == p.z()));
        BOOST_TEST(largest((a * b).coeffs() - (p * q).coeffs()) <= rounding * p.norm() * q.norm());
        BOOST_TEST(largest(a.conjugate().coeffs() - p.conjugate().coeffs()) == 0.0);
        BOOST_TEST(std::abs(a.norm() - p.norm()) <= rounding * p.norm());
        BOOST_TEST(largest(a.normalized().coeffs() - p.normalized().coeffs()) <= rounding);
        const Eigen::Matrix3d m = p.normalized().toRotationMatrix();
        BOOST_TEST(largest(a.normalized().matrix() - m) <= rounding);
    }
    BOOST_TEST(largest(talus::Quaternion(0.0, 0.0, 0.0, 0.0).normalized().coeffs()) == 0.0);
}

/// Turns by nearly half a circle about each axis take the branches for a small trace.
BOOST_AUTO_TEST_CASE(a_matrix_gives_the_quaternion_that_eigen_finds) {
    std::mt19937 rng(32);
    for (int axis = 0; axis < 3; ++axis)
        for (const double angle : {0.3, 2.0, 3.1, 3.2}) {
            Eigen::Quaterniond turn = any_quaternion(rng);
            turn.vec() *= 0.05;
            turn.vec()[axis] += std::sin(0.5 * angle);
            turn.w() = std::cos(0.5 * angle);
            const Eigen::Matrix3d m = turn.normalized().toRotationMatrix();
            const Eigen::Quaterniond found(m);
            const auto own = talus::Quaternion::of_matrix(m);
            BOOST_TEST(largest(own.coeffs() - found.coeffs()) <= rounding);
            BOOST_TEST(largest(own.matrix() - m) <= 4.0 * rounding);
        }
}

BOOST_AUTO_TEST_CASE(rotations_take_and_give_those_of_eigen) {
    std::mt19937 rng(33);
    const Eigen::Quaterniond q = any_quaternion(rng);
    const talus::Rotation<3> r(q);
    const Eigen::Quaterniond back = r.quaternion();
    BOOST_TEST(largest(back.coeffs() - q.normalized().coeffs()) <= rounding);
    const auto v = random_input::vector<talus::Vector<3>>(rng);
    BOOST_TEST(largest(r * v - q.normalized() * Eigen::Vector3d(v)) <= 2.0 * rounding);
}

BOOST_AUTO_TEST_SUITE_END()
