// SPDX-License-Identifier: BSL-1.0
#include <talus/geometry/superellipsoid.hpp>
#include <talus/measure/layer_profile.hpp>
#include <talus/measure/regions.hpp>
#include <talus/measure/stress.hpp>
#include <talus/stepping/simulation.hpp>

#include <boost/test/unit_test.hpp>

#include <numbers>
#include <random>
#include <vector>

#include "common/dimensions.hpp"

BOOST_AUTO_TEST_SUITE(measure_regions)

template <int Dim>
using V = talus::Vector<Dim>;

template <int Dim>
talus::Simulation<Dim> nothing() {
    return talus::Simulation<Dim>({talus::Coulomb<Dim>{.mu = 0.3}},
                                  talus::SimulationParams{.h = 1e-3});
}

template <int Dim>
talus::Rotation<Dim> turned() {
    if constexpr (Dim == 2)
        return talus::Rotation<2>::exp(talus::AngularVector<2>(0.4));
    else
        return talus::Rotation<3>::exp(talus::AngularVector<3>(0.4, -0.3, 0.7));
}

/// A point is covered by a shape if no direction separates it: tried in many of them.
BOOST_AUTO_TEST_CASE_TEMPLATE(a_shape_covers_what_no_direction_separates, D, dimensions) {
    constexpr int Dim = D::value;
    std::mt19937_64 rng(7);
    std::uniform_real_distribution<double> coordinate(-0.55, 0.55);
    std::normal_distribution<double> normal;
    const std::vector<talus::AnyShape<Dim>> shapes{talus::Ball<Dim>(0.5),
                                                   talus::Box<Dim>(V<Dim>::Constant(0.3)),
                                                   talus::Capsule<Dim>(0.3, 0.2)};
    const talus::Pose<Dim> pose{V<Dim>::Constant(0.1), turned<Dim>()};
    for (const auto& any : shapes) {
        const auto shape = talus::view_of<Dim>(any);
        int inside = 0;
        for (int k = 0; k < 300; ++k) {
            V<Dim> x;
            for (int d = 0; d < Dim; ++d) x[d] = pose.position[d] + coordinate(rng);
            const V<Dim> seen = pose.point_body(x);
            // The largest distance by which a direction separates it, found by following it.
            double apart = -1e9;
            for (int trial = 0; trial < 2000; ++trial) {
                V<Dim> n;
                for (int d = 0; d < Dim; ++d) n[d] = normal(rng);
                n.normalize();
                apart = std::max(apart, n.dot(seen - shape.support(n)));
            }
            if (std::abs(apart) < 0.02) continue;  // too near to the surface for so few directions
            BOOST_TEST(talus::covers(shape, pose, x) == (apart < 0.0));
            inside += apart < 0.0;
        }
        BOOST_TEST(inside > 20);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(walls_and_holes_cover_what_is_behind_them, D, dimensions) {
    constexpr int Dim = D::value;
    const talus::HalfSpace<Dim> floor(V<Dim>::Unit(Dim - 1), 0.0);
    const talus::Pose<Dim> up{0.5 * V<Dim>::Unit(Dim - 1), {}};
    BOOST_TEST(talus::covers(talus::view_of<Dim>(floor), up, V<Dim>(0.4 * V<Dim>::Unit(Dim - 1))));
    BOOST_TEST(!talus::covers(talus::view_of<Dim>(floor), up, V<Dim>(0.6 * V<Dim>::Unit(Dim - 1))));
    const talus::Superellipsoid<Dim> own(V<Dim>::Constant(0.5), 3.0);
    BOOST_TEST(!talus::covers(talus::view_of<Dim>(own), {}, V<Dim>(V<Dim>::Zero())));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(the_solid_part_of_a_region_is_counted, D, dimensions) {
    constexpr int Dim = D::value;
    auto sim = nothing<Dim>();
    auto& system = sim.system();
    const double pi = std::numbers::pi, r = 0.5;
    const double ball = Dim == 2 ? pi * r * r : 4.0 / 3 * pi * r * r * r;
    system.add(talus::Ball<Dim>(r), 1000.0, {V<Dim>::Zero(), {}});
    const talus::BoxRegion<Dim> box(V<Dim>::Constant(-1.0), V<Dim>::Constant(1.0));
    const double spacing = 0.02;
    const auto solid = [&](const auto& region) {
        return talus::solid_fraction<Dim>(region, system.bodies, system.shapes(), spacing);
    };
    BOOST_TEST(solid(box) == ball / std::pow(2.0, Dim), boost::test_tools::tolerance(1e-2));
    // Half of a ball that reaches out; a region within it.
    V<Dim> low = V<Dim>::Constant(-1.0);
    low[0] = 0.0;
    BOOST_TEST(solid(talus::BoxRegion<Dim>(low, V<Dim>::Constant(1.0))) ==
                   0.5 * ball / std::pow(2.0, Dim - 1),
               boost::test_tools::tolerance(1e-2));
    BOOST_TEST(solid(talus::BallRegion<Dim>(V<Dim>::Zero(), 0.4)) == 1.0);
    // What two bodies cover counts once; obstacles do not, but where they are asked for.
    system.add(talus::Box<Dim>(V<Dim>::Constant(0.3)), 1000.0, {V<Dim>::Zero(), {}});
    BOOST_TEST(solid(box) == ball / std::pow(2.0, Dim), boost::test_tools::tolerance(2e-2));
    system.add_obstacle(talus::HalfSpace<Dim>(V<Dim>::Unit(0), -0.6));
    BOOST_TEST(solid(box) == ball / std::pow(2.0, Dim), boost::test_tools::tolerance(2e-2));
    BOOST_TEST(talus::solid_fraction<Dim>(box, system.bodies, system.shapes(), spacing,
                                          [](std::size_t i) { return i == 2; }) == 0.2,
               boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(the_stress_of_a_region_is_that_of_its_grains, D, dimensions) {
    constexpr int Dim = D::value;
    auto sim = nothing<Dim>();
    for (int k = 0; k < 4; ++k)
        sim.system().add(talus::Ball<Dim>(0.1), 1000.0, {0.5 * k * V<Dim>::Unit(0), {}});
    std::vector<talus::Matrix<Dim>> moments;
    for (int k = 0; k < 4; ++k)
        moments.push_back(talus::Matrix<Dim>(std::pow(10.0, k) * talus::Matrix<Dim>::Identity()));
    const talus::BallRegion<Dim> region(0.75 * V<Dim>::Unit(0), 0.4);  // bodies 1 and 2
    const std::span<const talus::Matrix<Dim>> all(moments);
    const auto stress = talus::mean_stress<Dim>(region, sim.system().bodies, all);
    BOOST_TEST(stress(0, 0) == 110.0 / region.volume(), boost::test_tools::tolerance(1e-12));
    BOOST_TEST(talus::mean_stress<Dim>(region, sim.system().bodies, all, 2.0)(1, 1) == 55.0);
    BOOST_CHECK_THROW(talus::mean_stress<Dim>(region, sim.system().bodies, all.first(2)),
                      talus::input_error);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(regions_that_are_none_are_refused, D, dimensions) {
    constexpr int Dim = D::value;
    BOOST_CHECK_THROW(talus::BallRegion<Dim>(V<Dim>::Zero(), 0.0), talus::input_error);
    BOOST_CHECK_THROW(talus::BoxRegion<Dim>(V<Dim>::Zero(), V<Dim>::Unit(0)), talus::input_error);
    auto sim = nothing<Dim>();
    const talus::BallRegion<Dim> region(V<Dim>::Zero(), 1.0);
    for (const double spacing : {0.0, -1.0, 1e-9, std::nan("")})
        BOOST_CHECK_THROW(
            talus::solid_fraction<Dim>(region, sim.system().bodies, sim.system().shapes(), spacing),
            talus::input_error);
}

/// Layers that shear, each with two bodies of different mass.
BOOST_AUTO_TEST_CASE_TEMPLATE(layers_have_their_own_averages, D, dimensions) {
    constexpr int Dim = D::value;
    auto sim = nothing<Dim>();
    auto& system = sim.system();
    const V<Dim> up = V<Dim>::Unit(Dim - 1), along = V<Dim>::Unit(0);
    for (int k = 0; k < 3; ++k)
        for (const double mass : {1.0, 3.0})
            system.add(talus::Ball<Dim>(0.1),
                       talus::Inertia<Dim>{mass, talus::AngularVector<Dim>::Constant(1.0)},
                       {(k + 0.5) * up, {}}, {V<Dim>((k + (mass > 2.0 ? 0.4 : 0.0)) * along), {}});
    talus::LayerProfile<Dim> profile(V<Dim>(2.0 * up), 0.0, 4.0, 4);
    profile.record(system.bodies);
    profile.record(system.bodies);
    for (std::size_t k = 0; k < 3; ++k) {
        BOOST_TEST(profile.middle(k) == static_cast<double>(k) + 0.5);
        BOOST_TEST(profile.mass_per_length(k) == 4.0);
        BOOST_TEST(profile.velocity(k)[0] == static_cast<double>(k) + 0.3,
                   boost::test_tools::tolerance(1e-12));
        // Of 0.4 times a variable that is 1 three times in four.
        BOOST_TEST(profile.temperature(k) == 0.16 * 3.0 / 16.0 / Dim,
                   boost::test_tools::tolerance(1e-9));
    }
    BOOST_TEST(profile.mass_per_length(3) == 0.0);
    BOOST_TEST(profile.velocity(3).norm() == 0.0);

    talus::LayerProfile<Dim> again(up, 0.0, 4.0, 4);
    again.restore(talus::record_of(profile));
    again.record(system.bodies);
    profile.record(system.bodies);
    BOOST_TEST(talus::record_of(again).integers == talus::record_of(profile).integers);
    BOOST_TEST(talus::record_of(again).reals == talus::record_of(profile).reals);
    talus::LayerProfile<Dim> other(up, 0.0, 4.0, 5);
    BOOST_CHECK_THROW(other.restore(talus::record_of(profile)), talus::input_error);
    BOOST_TEST(other.records() == 0u);
    BOOST_CHECK_THROW(talus::LayerProfile<Dim>(up, 1.0, 1.0, 4), talus::input_error);
    BOOST_CHECK_THROW(talus::LayerProfile<Dim>(up, 0.0, 1.0, 0), talus::input_error);
    BOOST_CHECK_THROW(talus::LayerProfile<Dim>(V<Dim>(V<Dim>::Zero()), 0.0, 1.0, 1),
                      talus::input_error);
}

BOOST_AUTO_TEST_SUITE_END()
