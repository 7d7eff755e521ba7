// SPDX-License-Identifier: BSL-1.0
// Validation case C02: a rod sliding on its tip where no smooth motion exists.
#include <talus/geometry/aabb.hpp>
#include <talus/measure/energy_ledger.hpp>

#include <boost/test/unit_test.hpp>

#include "common/dimensions.hpp"
#include "experiment.hpp"

BOOST_AUTO_TEST_SUITE(stepping_painleve)

using namespace experiment;

/// A segment of unit length along the first body axis: a shape that the library does not have.
template <int Dim>
struct Rod {
    talus::Aabb<Dim> aabb(const talus::Pose<Dim>& pose) const {
        talus::Aabb<Dim> box;
        box.include(pose.point_world(0.5 * V<Dim>::Unit(0)));
        box.include(pose.point_world(-0.5 * V<Dim>::Unit(0)));
        return box;
    }
    V<Dim> support(const V<Dim>& d) const { return (d[0] < 0 ? -0.5 : 0.5) * V<Dim>::Unit(0); }
};
static_assert(talus::ConvexShape<Rod<2>, 2> && talus::ConvexShape<Rod<3>, 3>);

template <int Dim>
using RodShape = talus::AnyShapeOf<Dim, Rod<Dim>, talus::HalfSpace<Dim>>;
template <int Dim>
using RodSimulation = talus::Simulation<Dim, talus::DefaultLaw<Dim>, RodShape<Dim>>;

/// The rod of the catalogue: tip on the floor, the rest above and behind it, at `angle` to the
/// floor, the tip moving at -1 along the first axis.
template <int Dim>
RodSimulation<Dim> sliding_rod(double angle, double mu, double spin, double h) {
    talus::SimulationParams params;
    params.h = h;
    params.step.contact_tolerance = touching;
    RodSimulation<Dim> sim(law<Dim>(mu), params);
    sim.solver().params.tolerance = solver_tolerance;
    sim.system().gravity = -g * up<Dim>();
    sim.system().add_obstacle(talus::HalfSpace<Dim>{up<Dim>(), 0.0});
    W<Dim> moments = W<Dim>::Constant(1.0 / 12.0);
    if constexpr (Dim == 3) moments[0] = 1e-3;  // about the rod: no torque acts there
    const W<Dim> lean = -rolling_spin<Dim>(angle);
    const V<Dim> centre = in_plane<Dim>(0.5 * std::cos(angle), 0.5 * std::sin(angle));
    const W<Dim> w = -rolling_spin<Dim>(spin);
    const V<Dim> tip = in_plane<Dim>(-1.0, 0.0);
    sim.system().add(Rod<Dim>{}, talus::Inertia<Dim>{1.0, moments},
                     {centre, talus::Rotation<Dim>::exp(lean)},
                     {tip + talus::cross<Dim>(w, centre), w});
    return sim;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(the_inconsistent_rod_jams_with_a_finite_impulse, D, dimensions) {
    constexpr int Dim = D::value;
    const double angle = pi / 3, mu = 2.0, s = std::sin(angle), c = std::cos(angle);
    const double p_n = 0.75 * s * c, p_t = (1 + 3 * c * c) / 4;
    BOOST_CHECK_CLOSE(p_n, 0.324759526, 1e-6);
    BOOST_CHECK_CLOSE(p_t, 0.4375, 1e-6);
    double last_error = 1e9;
    for (double h : {1e-2, 1e-3, 1e-4}) {
        auto sim = sliding_rod<Dim>(angle, mu, 0.0, h);
        const double energy_before = talus::kinetic_energy(sim.system().bodies, 1);
        const auto& data = sim.step();
        BOOST_REQUIRE_EQUAL(data.contact_count(), 1u);
        BOOST_CHECK_LT(data.report.residual, 1e-10);
        // Sticks: the tip stops within the step.
        BOOST_CHECK_SMALL(
            largest(talus::relative_velocity<Dim>(data.problem.jacobian, 0, data.end)), 1e-12);
        const V<Dim> on_rod = -(data.problem.jacobian.frame[0].transpose() * data.impulse[0]);
        // The normal points from the rod (b) to the floor (a): what the rod gets is the opposite.
        const V<Dim> expected = in_plane<Dim>(p_t, p_n);
        const double error = largest(on_rod - expected);
        BOOST_CHECK_LT(error, 100 * h);
        if (last_error < 1e8) {
            BOOST_CHECK_LT(error, 0.15 * last_error);  // order 1: a tenth
        }
        last_error = error;
        const double spin = -sim.system().bodies.twist(1).angular.dot(rolling_spin<Dim>(1.0));
        BOOST_CHECK_SMALL(spin - 1.5 * s, 100 * h);
        const double loss = energy_before - talus::kinetic_energy(sim.system().bodies, 1);
        BOOST_CHECK_SMALL(loss - (1 + 3 * c * c) / 8, 100 * h);
    }
}

BOOST_AUTO_TEST_SUITE_END()
