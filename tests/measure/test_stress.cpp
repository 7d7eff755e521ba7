// SPDX-License-Identifier: BSL-1.0
#include <talus/measure/stress.hpp>
#include <talus/spatial/local_frame.hpp>

#include <boost/test/unit_test.hpp>

#include <vector>

#include "common/dimensions.hpp"

BOOST_AUTO_TEST_SUITE(measure_stress)

/// A ball of radius r, body 1, squeezed along the first axis with force f between bodies 0 and 2.
template <int Dim>
talus::ContactJacobian<Dim> squeezed(double r) {
    using V = talus::Vector<Dim>;
    talus::ContactJacobian<Dim> j;
    j.resize(2);
    j.a = {0, 1};
    j.b = {1, 2};
    const V x = V::Unit(0);
    // Normals from b to a: -x at the left contact, -x at the right one.
    for (auto& f : j.frame) f = talus::local_frame<Dim>(V(-x));
    j.arm_a = {V::Zero(), r * x};
    j.arm_b = {-r * x, V::Zero()};
    return j;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_squeezed_ball_is_compressed_along_the_push, D, dimensions) {
    constexpr int Dim = D::value;
    using V = talus::Vector<Dim>;
    const double r = 0.3, force = 7.0, h = 1e-2;
    const auto j = squeezed<Dim>(r);
    const std::vector<V> impulses(2, V(force * h * V::Unit(0)));
    std::vector<V> forces;
    talus::contact_forces<Dim>(j, impulses, h, forces);
    BOOST_CHECK_SMALL((forces[1] + force * V::Unit(0)).norm(), 1e-12);
    std::vector<talus::Matrix<Dim>> moments;
    talus::internal_moments<Dim>(j, forces, 3, moments);
    talus::Matrix<Dim> expected = talus::Matrix<Dim>::Zero();
    expected(0, 0) = -2 * r * force;
    BOOST_CHECK_SMALL((moments[1] - expected).norm(), 1e-12);
    const auto by_branches =
        talus::branch_moment<Dim>(j, forces, [](std::size_t i) { return i == 1; });
    BOOST_CHECK_SMALL((by_branches - expected).norm(), 1e-12);
    BOOST_CHECK_EQUAL(
        talus::branch_moment<Dim>(j, forces, [](std::size_t) { return false; }).norm(), 0.0);
}

BOOST_AUTO_TEST_CASE(forces_need_a_step_size) {
    std::vector<talus::Vector<2>> forces;
    BOOST_CHECK_THROW(talus::contact_forces<2>(talus::ContactJacobian<2>{},
                                               std::vector<talus::Vector<2>>{}, 0.0, forces),
                      talus::input_error);
}

BOOST_AUTO_TEST_SUITE_END()
