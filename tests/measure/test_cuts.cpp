// SPDX-License-Identifier: BSL-1.0
#include <talus/measure/cuts.hpp>
#include <talus/spatial/local_frame.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <numbers>
#include <vector>

#include "common/dimensions.hpp"

BOOST_AUTO_TEST_SUITE(measure_cuts)

/// Bodies at places and forces between neighbours, on the first of each two.
template <int Dim>
struct Net {
    using V = talus::Vector<Dim>;
    talus::Bodies<Dim> bodies;
    talus::ContactJacobian<Dim> jacobian;
    std::vector<V> forces;

    talus::BodyIndex add(const V& at) {
        return bodies.add({1.0, talus::AngularVector<Dim>::Constant(1.0)}, {at, {}});
    }
    void push(talus::BodyIndex a, talus::BodyIndex b, const V& on_a, const V& at) {
        const std::size_t c = forces.size();
        jacobian.resize(c + 1);
        jacobian.a[c] = a;
        jacobian.b[c] = b;
        jacobian.frame[c] = talus::local_frame<Dim>(V(V::Unit(0)));
        jacobian.arm_a[c] = at - bodies.position[a];
        jacobian.arm_b[c] = at - bodies.position[b];
        forces.push_back(on_a);
    }
    void push(talus::BodyIndex a, talus::BodyIndex b, const V& on_a) {
        push(a, b, on_a, V(0.5 * (bodies.position[a] + bodies.position[b])));
    }
    template <class Surface>
    talus::CutResultant<Dim> across(const Surface& surface) const {
        return talus::cut_resultant<Dim>(bodies, jacobian, forces, surface);
    }
};

BOOST_AUTO_TEST_CASE_TEMPLATE(a_column_hands_down_what_is_above, D, dimensions) {
    constexpr int Dim = D::value;
    using V = talus::Vector<Dim>;
    const V up = V::Unit(Dim - 1);
    Net<Dim> net;
    const auto floor = net.bodies.add_obstacle({});
    for (int k = 0; k < 5; ++k) net.add((k + 0.5) * up);
    // The lower one of two, here the first, is pushed down by all that is above it.
    net.push(floor, 1, -5.0 * up, V::Zero());
    for (int k = 1; k < 5; ++k) net.push(k, k + 1, (k - 5.0) * up);
    for (int k = 1; k < 5; ++k) {
        const auto cut = net.across(talus::FlatCut<Dim>(k * up, 3.0 * up, 0.1));
        BOOST_TEST((cut.force == (k - 5.0) * up));
        BOOST_TEST(cut.along_normals == k - 5.0);
        BOOST_TEST(cut.contacts == 1u);
        BOOST_TEST((net.across(talus::FlatCut<Dim>(k * up, -up)).force == (5.0 - k) * up));
    }
    // Between the floor's surface and the lowest centre, and beside the column.
    BOOST_TEST((net.across(talus::FlatCut<Dim>(0.2 * up, up)).force == -5.0 * up));
    const V aside = 0.2 * V::Unit(0);
    BOOST_TEST(net.across(talus::FlatCut<Dim>(2.0 * up + aside, up, 0.1)).contacts == 0u);
    BOOST_TEST(net.across(talus::FlatCut<Dim>(2.0 * up + aside, up, 0.3)).contacts == 1u);
    // The force of 3, downwards through the column, turns about the cut's centre aside of it.
    const auto moment = net.across(talus::FlatCut<Dim>(2.0 * up + aside, up, 0.3)).moment;
    BOOST_TEST(moment.norm() == 0.6, boost::test_tools::tolerance(1e-14));
}

// (G02) A lattice of equal rows: on every cut the stress vector of its stress tensor.
BOOST_AUTO_TEST_CASE(a_lattice_cut_aslant_has_the_stress_of_its_rows) {
    using V = talus::Vector<2>;
    constexpr int n = 12;
    const double fx = 3.0, fy = 7.0;
    Net<2> net;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) net.add(V(i, j));
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const talus::BodyIndex here = j * n + i;
            if (i + 1 < n) net.push(here, here + 1, V(-fx, 0.0));
            if (j + 1 < n) net.push(here, here + n, V(0.0, -fy));
        }
    const V middle = V::Constant(0.5 * (n - 1) + 0.25);
    const auto cut = net.across(talus::FlatCut<2>(middle, V(1.0, 1.0)));
    BOOST_CHECK_SMALL((cut.force - V(-fx * (n - 1), -fy * (n - 1))).norm(), 1e-12);
    const double side = 4.0;
    const talus::FlatCut<2> part(V(5.5, 5.5), V::Unit(0), 0.5 * side);
    BOOST_CHECK_SMALL((net.across(part).force / part.area() - V(-fx, 0.0)).norm(), 1e-12);
}

BOOST_AUTO_TEST_CASE(a_cylinder_is_pressed_from_all_sides) {
    using V = talus::Vector<3>;
    Net<3> net;
    const auto core = net.add({0.3, 0.2, 1.0});
    const auto above = net.add({0.3, 0.2, 2.5});
    for (int k = 0; k < 8; ++k) {
        const double turn = 0.25 * std::numbers::pi * k;
        const V out(std::cos(turn), std::sin(turn), 0.0);
        const auto ring = net.add(net.bodies.position[core] + out);
        net.push(core, ring, -2.0 * out + 0.1 * V::Unit(2));
        // Neighbours on the ring, whose line cuts the cylinder's disc if it is wide.
        if (k > 0) net.push(ring - 1, ring, V(5.0, 6.0, 7.0));
    }
    net.push(core, above, -9.0 * V::Unit(2));
    const V foot(0.3, 0.2, 0.0);
    for (const double radius : {0.4, 0.95}) {
        const auto cut = net.across(talus::CylinderCut(foot, 2.0 * V::Unit(2), radius));
        BOOST_TEST(cut.contacts == 8u);
        BOOST_CHECK_SMALL((cut.force - 0.8 * V::Unit(2)).norm(), 1e-12);
        BOOST_CHECK_SMALL(cut.along_normals + 16.0, 1e-12);
    }
    BOOST_TEST(net.across(talus::CylinderCut(foot, V::Unit(2), 0.4, 0.5, 1.5)).contacts == 8u);
    BOOST_TEST(net.across(talus::CylinderCut(foot, V::Unit(2), 0.4, 1.5, 2.0)).contacts == 0u);
    BOOST_CHECK_CLOSE(talus::CylinderCut(foot, V::Unit(2), 0.4, 0.5, 1.5).area(),
                      0.8 * std::numbers::pi, 1e-12);
}

BOOST_AUTO_TEST_CASE(what_is_no_cut_is_refused) {
    using V = talus::Vector<3>;
    const V zero = V::Zero(), up = V::Unit(2);
    BOOST_CHECK_THROW(talus::FlatCut<3>(zero, zero), talus::input_error);
    BOOST_CHECK_THROW(talus::FlatCut<3>(zero, up, 0.0), talus::input_error);
    BOOST_CHECK_THROW(talus::FlatCut<3>(V::Constant(NAN), up), talus::input_error);
    BOOST_CHECK_THROW(talus::CylinderCut(zero, zero, 1.0), talus::input_error);
    BOOST_CHECK_THROW(talus::CylinderCut(zero, up, -1.0), talus::input_error);
    BOOST_CHECK_THROW(talus::CylinderCut(zero, up, 1.0, 2.0, 2.0), talus::input_error);
    Net<3> net;
    net.forces.resize(1);
    BOOST_CHECK_THROW(net.across(talus::FlatCut<3>(zero, up)), talus::input_error);
}

BOOST_AUTO_TEST_SUITE_END()
