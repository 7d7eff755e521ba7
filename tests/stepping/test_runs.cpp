// SPDX-License-Identifier: BSL-1.0
// Whole runs of small heaps: what must hold in each of them, whatever the grains do.
#include <talus/core/column.hpp>
#include <talus/measure/energy_ledger.hpp>
#include <talus/measure/grain_load.hpp>
#include <talus/measure/penetration.hpp>

#include <boost/test/unit_test.hpp>

#include <cstring>
#include <vector>

#include "common/dimensions.hpp"
#include "heap.hpp"

BOOST_AUTO_TEST_SUITE(stepping_runs)

using namespace experiment;

template <int Dim, class Types = talus::SimulationTypes<Dim>>
talus::Simulation<Dim, Types> small_heap(double e = 0.0, talus::SimulationParams params = {}) {
    return heap<Dim, Types>(Dim == 2 ? 6 : 3, Dim == 2 ? 6 : 4, law<Dim>(0.4, e), 2e-3, params);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(the_energy_books_close_in_every_run, D, dimensions) {
    constexpr int Dim = D::value;
    for (double e : {0.0, 0.5}) {
        auto sim = small_heap<Dim>(e);
        talus::EnergyLedger<Dim> ledger(sim.system().bodies, sim.system().gravity);
        const auto run =
            sim.run(1.0, [&](const auto& s) { ledger.record(s.data(), s.system().bodies); });
        BOOST_TEST(run.steps > 0);
        BOOST_CHECK_LT(ledger.closure(), 1e-12);
        BOOST_CHECK_LT(ledger.flows().friction, 0.0);
        BOOST_CHECK_LT(ledger.flows().restitution, 0.0);
        BOOST_CHECK_EQUAL(ledger.flows().walls, 0.0);
        // The heap did fall: the test is about energies that moved.
        BOOST_CHECK_LT(ledger.potential(), 0.95 * ledger.potential_start());
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(the_books_close_with_moving_walls_and_applied_forces, D, dimensions) {
    constexpr int Dim = D::value;
    auto sim = small_heap<Dim>();
    const double w = 2 * pi;
    sim.system().add_obstacle(
        talus::HalfSpace<Dim>{up<Dim>(), 0.0},
        talus::PrescribedMotion<Dim>::of_pose([=](double t) {
            return talus::Pose<Dim>{0.05 * (1 - std::cos(w * t)) * up<Dim>(), {}};
        }).with_surface([=](double t) {
            return talus::Twist<Dim>{0.05 * w * std::sin(w * t) * up<Dim>() +
                                     0.3 * V<Dim>::Unit(0)};
        }));
    sim.system().forces.push_back([](double t, const auto& bodies, auto wrenches) {
        for (std::size_t i = 0; i < bodies.count(); ++i) {
            if (bodies.is_obstacle(i)) continue;
            wrenches[i].force += 0.3 * bodies.mass(i) * std::sin(5 * t) * V<Dim>::Unit(0);
            wrenches[i].torque[0] += 1e-3;
        }
    });
    talus::EnergyLedger<Dim> ledger(sim.system().bodies, sim.system().gravity);
    const auto run =
        sim.run(1.5, [&](const auto& s) { ledger.record(s.data(), s.system().bodies); });
    BOOST_TEST(run.steps > 0);
    BOOST_CHECK_LT(ledger.closure(), 1e-12);
    BOOST_CHECK_GT(std::abs(ledger.flows().walls), 0.1);
    BOOST_CHECK_GT(std::abs(ledger.flows().applied), 1e-3);
}

/// State of all bodies as bytes.
template <int Dim>
std::vector<double> state(const talus::Simulation<Dim>& sim) {
    std::vector<double> all;
    const auto& b = sim.system().bodies;
    for (std::size_t i = 0; i < b.count(); ++i) {
        const auto m = b.rotation[i].matrix();
        all.insert(all.end(), b.position[i].data(), b.position[i].data() + Dim);
        all.insert(all.end(), m.data(), m.data() + Dim * Dim);
        all.insert(all.end(), b.velocity[i].data(), b.velocity[i].data() + Dim);
        all.insert(all.end(), b.spin[i].data(), b.spin[i].data() + b.spin[i].size());
    }
    return all;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(the_same_input_gives_the_same_bits, D, dimensions) {
    constexpr int Dim = D::value;
    auto one = small_heap<Dim>();
    auto two = small_heap<Dim>();
    BOOST_TEST(one.run(0.6).steps > 0);
    BOOST_TEST(two.run(0.6).steps > 0);
    BOOST_CHECK(same_bits(state(one), state(two)));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(grains_of_a_micrometre_move_as_grains_of_a_metre_to_the_bit, D,
                              dimensions) {
    constexpr int Dim = D::value;
    // Lengths by 2^-20 and times by 2^-10, under the same gravity: all roundings are the same.
    const double length = 0x1p-20, time = 0x1p-10, h = 0x1p-9;
    const int wide = Dim == 2 ? 6 : 3;
    auto metre = heap<Dim>(wide, 5, law<Dim>(0.4, 0.3), h);
    auto micrometre = heap<Dim>(wide, 5, law<Dim>(0.4, 0.3), time * h, {}, length);
    for (int k = 0; k < 300; ++k) {
        metre.step();
        micrometre.step();
        BOOST_REQUIRE_EQUAL(metre.data().report.iterations, micrometre.data().report.iterations);
        BOOST_REQUIRE_EQUAL(metre.data().report.residual, micrometre.data().report.residual);
    }
    BOOST_CHECK_GT(metre.data().contact_count(), 20u);
    const auto& large = metre.system().bodies;
    const auto& small = micrometre.system().bodies;
    for (std::size_t i = 0; i < large.count(); ++i) {
        BOOST_CHECK_EQUAL(small.position[i], V<Dim>(length * large.position[i]));
        BOOST_CHECK_EQUAL(small.velocity[i], V<Dim>(length / time * large.velocity[i]));
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(the_candidates_of_the_broad_phase_do_not_show_in_the_bits, D,
                              dimensions) {
    constexpr int Dim = D::value;
    talus::SimulationParams wide, narrow;
    wide.step.skin = 1.0;
    narrow.step.skin = 0.0;
    auto one = small_heap<Dim>(0.0, wide);
    auto two = small_heap<Dim>(0.0, narrow);
    BOOST_TEST(one.run(0.6).steps > 0);
    BOOST_TEST(two.run(0.6).steps > 0);
    BOOST_CHECK(same_bits(state(one), state(two)));
}

BOOST_TEST_DECORATOR(*boost::unit_test::label("long"))
BOOST_AUTO_TEST_CASE_TEMPLATE(every_step_meets_the_tolerance_and_the_floor_carries_the_weight, D,
                              dimensions) {
    constexpr int Dim = D::value;
    const double tolerance = 1e-5;  // Gauss-Seidel may cycle for ever at some 1e-7 in such heaps
    for (auto scheme : {talus::Scheme::midpoint, talus::Scheme::gap_anticipating}) {
        talus::SimulationParams params;
        params.step.scheme = scheme;
        auto sim = small_heap<Dim>(0.0, params);
        sim.solver().params.tolerance = tolerance;
        sim.solver().params.max_iterations = 100000;
        double worst = 0.0, deepest = 0.0;
        int missed = 0;
        const auto run = sim.run(3.0, [&](const auto& s) {
            worst = std::max(worst, s.data().report.residual);
            deepest = std::max(deepest, talus::penetration(s.data().contacts).max);
            missed += s.data().report.status != talus::SolveStatus::converged;
        });
        BOOST_TEST(run.missed == 0);
        BOOST_CHECK_LE(worst, tolerance);
        BOOST_CHECK_EQUAL(missed, 0);
        double weight = 0.0;
        const auto& bodies = sim.system().bodies;
        for (std::size_t i = 0; i < bodies.count(); ++i)
            if (!bodies.is_obstacle(i)) weight += bodies.mass(i) * g;
        const auto& data = sim.data();
        const V<Dim> support =
            talus::impulse_from<Dim>(data.problem.jacobian, data.impulse,
                                     [&](std::size_t i) { return bodies.is_obstacle(i); });
        BOOST_CHECK_CLOSE(support[Dim - 1] / data.h, weight, 0.01);
        // Midpoint: up to h times the speed of impact; anticipating: what rolling and new contacts
        // add.
        BOOST_CHECK_LT(deepest, scheme == talus::Scheme::midpoint ? 2e-3 * 3.0 : 2e-3 * 0.5);
    }
}

BOOST_AUTO_TEST_CASE(balls_confined_to_a_plane_move_as_discs) {
    // Spheres with the mass and the inertia of discs, all centres in the plane y = 0.
    talus::SimulationParams params;
    params.h = 1e-3;
    params.step.contact_tolerance = 0.0;  // the default follows bounding radii, which differ
    auto flat = heap<2>(5, 5, law<2>(0.4, 0.3), 1e-3, params);
    talus::Simulation<3> space(law<3>(0.4, 0.3), params);
    for (auto* solver : {&flat.solver().params, &space.solver().params}) {
        solver->tolerance = 1e-13;
        solver->max_iterations = 100000;
    }
    const auto lift = [](const V<2>& v) { return V<3>(v[0], 0.0, v[1]); };
    space.system().gravity = lift(flat.system().gravity);
    for (const auto& [normal, offset] :
         {std::pair{V<2>(0, 1), 0.0}, {V<2>(1, 0), 0.0}, {V<2>(-1, 0), -0.65}})
        space.system().add_obstacle(talus::HalfSpace<3>{lift(normal), offset});
    const auto& b2 = flat.system().bodies;
    for (std::size_t i = 3; i < b2.count(); ++i)
        space.system().add(talus::Ball<3>{flat.system().bounding_radius()[i] / std::sqrt(2.0)},
                           talus::Inertia<3>{b2.mass(i), V<3>::Constant(b2.inertia(i)[0])},
                           {lift(b2.position[i]), {}});
    double apart = 0.0;
    for (int k = 0; k < 250; ++k) {
        flat.step();
        space.step();
        BOOST_REQUIRE_EQUAL(flat.data().contact_count(), space.data().contact_count());
        for (std::size_t i = 0; i < b2.count(); ++i)
            apart =
                std::max(apart, largest(space.system().bodies.position[i] - lift(b2.position[i])));
    }
    BOOST_CHECK_GT(flat.data().contact_count(), 10u);
    // Rounding and solver error, amplified by collisions.
    BOOST_CHECK_LT(apart, 1e-8);
}

BOOST_TEST_DECORATOR(*boost::unit_test::label("long"))
BOOST_AUTO_TEST_CASE_TEMPLATE(a_gap_correction_removes_overlap_without_making_energy, D,
                              dimensions) {
    constexpr int Dim = D::value;
    auto corrected = small_heap<Dim, Corrected<Dim>>();
    auto plain = small_heap<Dim>();
    talus::EnergyLedger<Dim> ledger(corrected.system().bodies, corrected.system().gravity);
    double highest = -1e9;
    const double start = ledger.kinetic() + ledger.potential();
    const auto run = corrected.run(1.5, [&](const auto& s) {
        ledger.record(s.data(), s.system().bodies);
        highest = std::max(highest, ledger.kinetic() + ledger.potential());
    });
    BOOST_TEST(run.steps > 0);
    BOOST_TEST(plain.run(1.5).steps > 0);
    BOOST_CHECK_LE(highest, start * (1 + 1e-12));
    BOOST_CHECK_LT(ledger.closure(), 1e-12);
    BOOST_CHECK_GT(ledger.flows().correction, 0.0);
    BOOST_CHECK_LT(talus::penetration(corrected.data().contacts).mean,
                   0.05 * talus::penetration(plain.data().contacts).mean);
}

// Turned at constant spin in space, a body of three moments would gain or lose energy.
BOOST_AUTO_TEST_CASE(a_spinning_box_that_is_moved_out_of_the_floor_keeps_its_energy) {
    talus::Simulation<3, Corrected<3>> sim(law<3>(0.4), talus::SimulationParams{.h = 1e-3});
    auto& system = sim.system();
    system.gravity.setZero();
    system.add_obstacle(talus::HalfSpace<3>{up<3>(), 0.0});
    const auto box = system.add(talus::Box<3>{{0.5, 0.1, 0.05}}, 1000.0, {0.04 * up<3>(), {}});
    auto& bodies = system.bodies;
    // Off its principal axes, and so that it leaves the floor.
    bodies.velocity[static_cast<std::size_t>(box)] = 2.0 * up<3>();
    bodies.spin[static_cast<std::size_t>(box)] = {1.0, -2.0, 0.5};
    bodies.rotation[static_cast<std::size_t>(box)] = talus::Rotation<3>::exp({0.0, 0.05, 0.0});
    sim.gap_correction().params.fraction = 0.5;
    const double start = talus::kinetic_energy(bodies);
    const auto from = bodies.position[static_cast<std::size_t>(box)];
    double loss = 0.0, highest = 0.0;
    for (int k = 0; k < 10; ++k) {
        sim.step();
        loss = std::max(loss, start - talus::kinetic_energy(bodies));
        highest = std::max(highest, talus::kinetic_energy(bodies) - start);
    }
    // It was moved, by more than its velocity does, and nothing but the steps' own order shows.
    BOOST_CHECK_GT((bodies.position[static_cast<std::size_t>(box)] - from).norm(), 0.021);
    BOOST_CHECK_LT(highest, 1e-5 * start);
    BOOST_CHECK_LT(loss, 1e-5 * start);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_run_stops_when_the_observer_says_so, D, dimensions) {
    constexpr int Dim = D::value;
    auto sim = small_heap<Dim>();
    const auto run = sim.run(1.0, [](const auto& s) { return s.step_count() < 7; });
    BOOST_TEST(run.stopped);
    BOOST_TEST(run.steps == 7);
    BOOST_CHECK_EQUAL(sim.step_count(), 7);
    BOOST_CHECK_CLOSE(sim.time(), 7 * 2e-3, 1e-12);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_force_that_is_not_finite_is_named_and_nothing_moves, D,
                              dimensions) {
    constexpr int Dim = D::value;
    auto sim = small_heap<Dim>();
    BOOST_TEST(sim.run(0.1).steps > 0);
    const auto before = state(sim);
    sim.system().forces.push_back(
        [](double, const auto&, auto wrenches) { wrenches[9].force[1] = std::nan(""); });
    BOOST_CHECK_EXCEPTION(sim.step(), talus::input_error, [](const auto& e) {
        return std::string(e.what()).find("body 9") != std::string::npos;
    });
    const auto after = state(sim);
    double moved = 0.0;
    for (std::size_t i = 0; i < before.size(); ++i)
        moved = std::max(moved, std::abs(after[i] - before[i]));
    BOOST_CHECK_LT(moved, 1e-14);  // there and back by half a step
    BOOST_CHECK_EQUAL(sim.step_count(), 50);
}

/// A broad phase of one's own: every pair of which not both are obstacles, boxes or no boxes.
struct EveryPair {
    template <int Dim, class IsObstacle>
    void find_pairs(std::span<const talus::Aabb<Dim>> boxes, const IsObstacle& is_obstacle,
                    talus::Column<talus::CandidatePair>& pairs) const {
        pairs.clear();
        const auto n = static_cast<talus::BodyIndex>(boxes.size());
        for (talus::BodyIndex a = 0; a < n; ++a)
            for (talus::BodyIndex b = a + 1; b < n; ++b)
                if (!is_obstacle(a) || !is_obstacle(b)) pairs.push_back({a, b});
    }
};
template <int Dim>
struct WithEveryPair : talus::SimulationTypes<Dim> {
    using BroadPhase = EveryPair;
};

BOOST_AUTO_TEST_CASE_TEMPLATE(an_own_broad_phase_changes_no_bit, D, dimensions) {
    constexpr int Dim = D::value;
    auto own = small_heap<Dim, WithEveryPair<Dim>>();
    auto usual = small_heap<Dim>();
    BOOST_TEST(own.run(0.3).steps > 0);
    BOOST_TEST(usual.run(0.3).steps > 0);
    BOOST_CHECK_GT(usual.data().contact_count(), 10u);
    const auto &a = own.system().bodies, &b = usual.system().bodies;
    for (std::size_t i = 0; i < a.count(); ++i)
        BOOST_CHECK(a.position[i] == b.position[i] && a.velocity[i] == b.velocity[i]);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(settings_out_of_range_are_rejected, D, dimensions) {
    constexpr int Dim = D::value;
    const auto with_h = [](double h) {
        talus::SimulationParams params;
        params.h = h;
        return talus::Simulation<Dim>(law<Dim>(0.4), params);
    };
    for (double bad : {0.0, -1e-3, std::nan("")})
        BOOST_CHECK_THROW(with_h(bad), talus::input_error);
    auto sim = with_h(1e-3);
    BOOST_CHECK_THROW(sim.system().add(talus::Ball<Dim>{0.1}, -1.0, {}), talus::input_error);
    BOOST_CHECK_THROW(sim.system().add(talus::Ball<Dim>{0.1}, 1.0, {}, {}, 1), talus::input_error);
    BOOST_CHECK_EQUAL(sim.system().bodies.count(), 0u);
    talus::Simulation<Dim, Corrected<Dim>> corrected(law<Dim>(0.4));
    corrected.gap_correction().params.fraction = 1.5;
    BOOST_CHECK_THROW(corrected.step(), talus::input_error);
    BOOST_CHECK_EQUAL(corrected.step_count(), 0);
}

BOOST_AUTO_TEST_SUITE_END()
