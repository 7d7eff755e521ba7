// SPDX-License-Identifier: BSL-1.0
// A world that loses bodies: names that stay, warm starts that stay, and the bits of a world in
// which those that are gone never were.
#include <talus/measure/contact_network.hpp>
#include <talus/measure/cuts.hpp>
#include <talus/measure/energy_ledger.hpp>
#include <talus/measure/force_chains.hpp>
#include <talus/measure/rings.hpp>
#include <talus/measure/stress.hpp>
#include <talus/stepping/equilibrium.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/dimensions.hpp"
#include "heap.hpp"

using namespace experiment;

BOOST_AUTO_TEST_SUITE(stepping_removal)

template <int Dim>
std::vector<talus::BodyId> ids(const talus::Bodies<Dim>& bodies) {
    return {bodies.id.begin(), bodies.id.end()};
}

BOOST_AUTO_TEST_CASE_TEMPLATE(what_is_left_goes_on_as_if_alone, D, dimensions) {
    constexpr int Dim = D::value;
    auto sim = heap<Dim>(4, 4, law<Dim>(0.4), 2e-3);
    BOOST_TEST(sim.run(0.3).certified());
    const auto gone = [&](std::size_t i) {
        return !sim.system().bodies.is_obstacle(i) && i % 5 == 2;
    };
    std::vector<std::size_t> left;
    for (std::size_t i = 0; i < sim.system().bodies.count(); ++i)
        if (!gone(i)) left.push_back(i);
    const talus::System<Dim> before = sim.system();
    const std::size_t removed = sim.system().remove_if(gone);
    BOOST_TEST(removed + left.size() == before.bodies.count());
    BOOST_TEST(sim.system().shapes().size() == left.size());

    // The same bodies in a system that never had the others.
    talus::System<Dim> fresh(law<Dim>(0.4));
    fresh.gravity = before.gravity;
    fresh.place_obstacles(sim.time());
    for (const std::size_t i : left) {
        const auto& b = before.bodies;
        if (b.is_obstacle(i))
            fresh.add_obstacle(before.shapes()[i], b.pose(i));
        else
            fresh.add(before.shapes()[i], talus::Inertia<Dim>{b.mass(i), b.inertia(i)}, b.pose(i));
    }
    for (std::size_t k = 0; k < left.size(); ++k) {
        fresh.bodies.velocity[k] = before.bodies.velocity[left[k]];
        fresh.bodies.spin[k] = before.bodies.spin[left[k]];
        fresh.bodies.inverse_mass[k] = before.bodies.inverse_mass[left[k]];
        fresh.bodies.inverse_inertia[k] = before.bodies.inverse_inertia[left[k]];
    }
    talus::Simulation<Dim> alone(fresh, sim.params());
    BOOST_TEST(alone.time() == sim.time());
    alone.impulse_cache() = sim.impulse_cache();
    BOOST_TEST(alone.impulse_cache().size() > 10u);
    for (int k = 0; k < 60; ++k) {
        sim.step();
        alone.step();
        BOOST_REQUIRE(sim.data().recalled == alone.data().recalled);
        BOOST_REQUIRE(
            equal_bits(everything(sim.system().bodies), everything(alone.system().bodies)));
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(names_stay_and_stale_ones_are_refused, D, dimensions) {
    constexpr int Dim = D::value;
    auto sim = heap<Dim>(3, 2, law<Dim>(0.4), 2e-3);
    auto& system = sim.system();
    const std::vector<talus::BodyId> all = ids(system.bodies);
    const std::size_t n = all.size();
    const V<Dim> last = system.bodies.position[n - 1];
    system.remove(std::vector{all[n - 2], all[n - 4]});
    BOOST_TEST(system.bodies.count() == n - 2);
    BOOST_TEST(static_cast<std::size_t>(system.bodies.index(all[n - 1])) == n - 3);
    BOOST_TEST((system.bodies.position[system.bodies.index(all[n - 1])] == last));
    BOOST_TEST(!system.bodies.find(all[n - 2]).has_value());
    BOOST_CHECK_THROW(system.bodies.index(all[n - 2]), talus::input_error);
    // None of those is taken out where one is wrong.
    BOOST_CHECK_THROW(system.remove(std::vector{all[n - 1], all[n - 4]}), talus::input_error);
    BOOST_CHECK_THROW(system.remove(talus::BodyId{}), talus::input_error);
    BOOST_TEST(system.bodies.count() == n - 2);
    // A name is not given again.
    system.remove(all[n - 1]);
    const auto next = system.add(talus::Ball<Dim>(0.05), 1000.0, {9.0 * up<Dim>(), {}});
    BOOST_TEST((system.bodies.id[next] > all[n - 1]));
    BOOST_TEST(!system.bodies.find(all[n - 1]).has_value());
    sim.step();
}

BOOST_AUTO_TEST_CASE_TEMPLATE(warm_starts_of_the_others_stay, D, dimensions) {
    constexpr int Dim = D::value;
    talus::Simulation<Dim> sim(law<Dim>(0.4));
    auto& system = sim.system();
    system.gravity = -g * up<Dim>();
    const auto far = system.add(talus::Ball<Dim>(0.1), 1000.0, {50.0 * up<Dim>(), {}});
    const auto far_id = system.bodies.id[far];
    system.add_obstacle(talus::HalfSpace<Dim>{up<Dim>(), 0.0});
    for (int k = 0; k < 5; ++k)
        system.add(talus::Box<Dim>(V<Dim>::Constant(0.5)), 1000.0, {(k + 0.5) * up<Dim>(), {}});
    for (int k = 0; k < 5; ++k) sim.step();
    auto untouched = sim;
    const std::size_t contacts = sim.data().contact_count();
    system.remove(far_id);
    sim.step();
    untouched.step();
    BOOST_TEST(sim.data().contact_count() == contacts);
    BOOST_TEST(sim.data().recalled == untouched.data().recalled);
    BOOST_TEST(sim.data().recalled > contacts / 2);
    BOOST_TEST(sim.data().report.iterations == untouched.data().report.iterations);
    // The topmost box goes: its contacts are forgotten, the others are not.
    system.remove(system.bodies.id.back());
    BOOST_TEST(sim.impulse_cache().size() == contacts / 5 * 4);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(obstacles_go_too_and_the_others_keep_their_motion, D, dimensions) {
    constexpr int Dim = D::value;
    talus::Simulation<Dim> sim(law<Dim>(0.4), {.h = 1e-2});
    auto& system = sim.system();
    const auto wall = system.add_obstacle(talus::HalfSpace<Dim>{up<Dim>(), -5.0});
    const auto wall_id = system.bodies.id[wall];
    talus::Twist<Dim> rising;
    rising.linear = 0.5 * up<Dim>();
    const auto lift = system.bodies.id[system.add_obstacle(
        talus::Box<Dim>(V<Dim>::Constant(1.0)), talus::PrescribedMotion<Dim>::uniform({}, rising))];
    sim.step();
    system.remove(wall_id);
    for (int k = 0; k < 9; ++k) sim.step();
    BOOST_TEST(system.obstacles.size() == 1u);
    BOOST_CHECK_CLOSE(system.bodies.position[system.bodies.index(lift)][Dim - 1], 0.05, 1e-10);
    // Moved by hand it is still noticed.
    system.bodies.position[0] += up<Dim>();
    BOOST_CHECK_THROW(sim.step(), talus::input_error);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_source_and_a_sink, D, dimensions) {
    constexpr int Dim = D::value;
    talus::Simulation<Dim> sim(law<Dim>(0.4), {.h = 5e-3});
    auto& system = sim.system();
    system.gravity = -g * up<Dim>();
    system.add_obstacle(talus::Box<Dim>(V<Dim>::Constant(0.3)), talus::Pose<Dim>{});
    std::size_t most = 0, removed = 0;
    for (int k = 0; k < 600; ++k) {
        if (k % 20 == 0)
            system.add(talus::Ball<Dim>(0.05 + 1e-4 * (k % 7)), 1000.0,
                       {0.9 * up<Dim>() + 0.32 * V<Dim>::Unit(0), {}});
        sim.step();
        most = std::max(most, system.bodies.count());
        removed += system.remove_if(
            [&](std::size_t i) { return system.bodies.position[i][Dim - 1] < -2.0; });
    }
    BOOST_TEST(removed > 10u);
    BOOST_TEST(most < 25u);
    double mean = 0.0;
    for (std::size_t i = 1; i < system.bodies.count(); ++i)
        mean += system.bounding_radius()[i] / static_cast<double>(system.bodies.count() - 1);
    BOOST_CHECK_CLOSE(system.mean_bounding_radius(), mean, 1e-12);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(what_reads_a_step_knows_whose_it_is, D, dimensions) {
    constexpr int Dim = D::value;
    auto sim = heap<Dim>(3, 3, law<Dim>(0.4), 2e-3);
    BOOST_TEST(sim.run(0.3).certified());
    auto& system = sim.system();
    const auto& data = sim.data();
    const auto& jacobian = data.problem.jacobian;
    std::vector<talus::Vector<Dim>> forces;
    talus::contact_forces<Dim>(jacobian, data.impulse, data.h, forces);
    std::vector<talus::Matrix<Dim>> moments;
    const auto chains = [&] {
        moments.assign(system.bodies.count(), -talus::Matrix<Dim>::Identity());
        const std::vector<double> volume(system.bodies.count(), 1.0);
        return talus::force_chains<Dim>(system.bodies, data.contacts, data.impulse, moments,
                                        volume);
    };
    const auto all = [&](talus::RunSummary& summary) {
        summary.record(system, data);
        (void)talus::contact_network<Dim>(system.bodies, data.contacts, data.impulse);
        (void)chains();
    };
    talus::RunSummary before, after;
    all(before);
    // A body that is added, a ball or a wall in motion, had no part in the step.
    system.add(talus::Ball<Dim>(0.05), 1000.0, {5.0 * talus::Vector<Dim>::Ones(), {}});
    system.add_obstacle(talus::Ball<Dim>(0.05), talus::PrescribedMotion<Dim>::uniform(
                                                    {9.0 * talus::Vector<Dim>::Ones(), {}},
                                                    {500.0 * talus::Vector<Dim>::Ones(), {}}));
    all(after);
    BOOST_TEST(to_string(after) == to_string(before));
    // One that is removed makes all later indices those of others.
    const talus::BodyId gone = system.bodies.id[system.bodies.count() - 6];
    system.remove(std::vector{gone});
    const auto says_which = [&](const talus::input_error& error) {
        return std::string(error.what()).find(std::to_string(gone.serial)) != std::string::npos;
    };
    BOOST_CHECK_THROW((void)sim.data(), talus::input_error);
    talus::RunSummary refused;
    BOOST_CHECK_EXCEPTION(refused.record(system, data), talus::input_error, says_which);
    BOOST_TEST(refused.steps == 0);
    BOOST_CHECK_EXCEPTION(
        (void)talus::contact_network<Dim>(system.bodies, data.contacts, data.impulse),
        talus::input_error, says_which);
    BOOST_CHECK_EXCEPTION((void)chains(), talus::input_error, says_which);
    // Where there are no ids, at least nothing is read that is not there.
    system.remove_if([&](std::size_t i) { return i > 3; });
    talus::ContactSet<Dim> by_hand = data.contacts;
    by_hand.body.clear();
    BOOST_CHECK_THROW((void)talus::contact_network<Dim>(system.bodies, by_hand, data.impulse),
                      talus::input_error);
    BOOST_CHECK_THROW(
        talus::internal_moments<Dim>(jacobian, forces, system.bodies.count(), moments),
        talus::input_error);
    talus::GroundPressure<Dim> pressure(talus::Rings<Dim>(talus::Vector<Dim>::Zero(), 0.1, 3));
    BOOST_CHECK_THROW(pressure.record(jacobian, forces, system.bodies, [](auto) { return true; }),
                      talus::input_error);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(who_is_asked_whom_to_remove_changes_nothing_else, D, dimensions) {
    constexpr int Dim = D::value;
    auto sim = heap<Dim>(3, 3, law<Dim>(0.4), 2e-3);
    auto& system = sim.system();
    const std::size_t n = system.bodies.count();
    BOOST_CHECK_THROW(system.remove_if([&](std::size_t i) {
        if (i == 2) system.add(talus::Ball<Dim>(0.05), 1000.0, {talus::Vector<Dim>::Ones(), {}});
        return i == 4;
    }),
                      talus::input_error);
    BOOST_TEST(system.bodies.count() == n + 1);
    BOOST_CHECK_THROW(system.remove_if([&](std::size_t i) {
        if (i == 2) system.remove(std::vector{system.bodies.id[n]});
        return i == 4;
    }),
                      talus::input_error);
    BOOST_TEST(system.bodies.count() == n);
    BOOST_TEST(system.shapes().size() == n);
    BOOST_TEST(sim.run(0.1).certified());
}

BOOST_AUTO_TEST_CASE(states_that_cannot_be_are_refused) {
    auto sim = heap<2>(3, 3, law<2>(0.4), 2e-3);
    const auto good = sim.state();
    const auto refuses = [&](auto&& spoil) {
        auto bad = good;
        spoil(bad);
        BOOST_CHECK_THROW(sim.restore(bad), talus::input_error);
        BOOST_CHECK(sim.state().bodies.id == good.bodies.id);
    };
    refuses([](auto& s) { s.bodies.id[4] = s.bodies.id[3]; });
    refuses([](auto& s) { s.bodies.id[4].serial = 1000; });
    refuses([](auto& s) { s.bodies.id[0].serial = -1; });
    refuses([](auto& s) { s.bodies.position[4][0] = std::numeric_limits<double>::quiet_NaN(); });
    BOOST_CHECK_NO_THROW(sim.restore(good));
}

BOOST_AUTO_TEST_CASE(a_step_without_removals_has_data_again) {
    auto sim = heap<2>(3, 3, law<2>(0.4), 2e-3);
    sim.system().remove_if([](std::size_t i) { return i == 4; });
    BOOST_TEST(sim.run(0.01).certified());
    BOOST_TEST(sim.data().end.size() == sim.system().bodies.count());
    // What takes out nothing, or only adds, changes no index.
    sim.system().remove_if([](std::size_t) { return false; });
    sim.system().add(talus::Ball<2>(0.05), 1000.0, {{5.0, 5.0}, {}});
    BOOST_CHECK_NO_THROW((void)sim.data());
    sim.system().remove_if([](std::size_t i) { return i == 5; });
    BOOST_CHECK_THROW((void)sim.data(), talus::input_error);
    sim.step();
    BOOST_TEST(sim.data().end.size() == sim.system().bodies.count());
}

BOOST_AUTO_TEST_CASE_TEMPLATE(summaries_of_parts_add_up_to_that_of_the_whole, D, dimensions) {
    constexpr int Dim = D::value;
    auto whole = heap<Dim>(3, 3, law<Dim>(0.4), 2e-3);
    auto parts = whole;
    talus::RunSummary sum;
    for (int k = 0; k < 5; ++k) sum.add(parts.run(0.06));
    talus::RunSummary all;
    const talus::RunSummary at_once =
        whole.run(0.3, [&](const auto& s) { all.record(s.system(), s.data()); });
    BOOST_TEST(to_string(sum) == to_string(at_once));
    BOOST_TEST(to_string(all) == to_string(at_once));
    BOOST_TEST(sum.steps == 150);
    talus::RunSummary bad;
    bad.residual.value = std::numeric_limits<double>::quiet_NaN();
    bad.missed = 1;
    sum.add(bad);
    BOOST_TEST(std::isnan(sum.residual.value));
    BOOST_TEST(!sum.certified());
}

BOOST_AUTO_TEST_CASE_TEMPLATE(books_close_over_bodies_that_come_and_go, D, dimensions) {
    constexpr int Dim = D::value;
    auto sim = heap<Dim>(3, 3, law<Dim>(0.4), 2e-3);
    auto& system = sim.system();
    talus::EnergyLedger<Dim> books(system.bodies, system.gravity);
    talus::Vector<Dim> place = talus::Vector<Dim>::Constant(0.1);
    for (int k = 0; k < 200; ++k) {
        sim.step();
        books.record(sim.data(), system.bodies);
        if (k % 20 == 7) {
            place[Dim - 1] = 1.0 + 0.1 * k;
            system.add(talus::Ball<Dim>(0.04), 1000.0, {place, {}},
                       {-talus::Vector<Dim>::Unit(Dim - 1), {}});
        }
        if (k % 50 == 49)
            system.remove_if(
                [&](std::size_t i) { return !system.bodies.is_obstacle(i) && i % 6 == 3; });
        if (k == 77) {
            BOOST_CHECK_NO_THROW(books.record_exchange(system.bodies));  // nothing came: nothing
        }
        if (k % 20 == 7 || k % 50 == 49) {
            BOOST_CHECK_THROW(talus::EnergyLedger<Dim>(books).record(sim.data(), system.bodies),
                              talus::input_error);
            books.record_exchange(system.bodies);
        }
    }
    BOOST_TEST(std::abs(books.flows().exchange) > 1.0);
    BOOST_TEST(books.closure() < 1e-12);
    const auto same = talus::from_record<talus::EnergyLedger<Dim>>(talus::record_of(books));
    BOOST_TEST(same.flows().exchange == books.flows().exchange);
}

BOOST_AUTO_TEST_CASE(what_throws_removes_nothing) {
    auto sim = heap<2>(3, 3, law<2>(0.4), 2e-3);
    sim.step();
    const auto before = everything(sim.system().bodies);
    const auto names = ids(sim.system().bodies);
    BOOST_CHECK_THROW(sim.system().remove_if([](std::size_t i) -> bool {
        if (i == 5) throw std::runtime_error("no");
        return true;
    }),
                      std::runtime_error);
    BOOST_TEST(equal_bits(before, everything(sim.system().bodies)));
    BOOST_TEST((names == ids(sim.system().bodies)));
    sim.system().forces.push_back(
        [&](double, const auto&, auto) { sim.system().remove(names[7]); });
    BOOST_CHECK_THROW(sim.step(), talus::input_error);
    BOOST_TEST((names == ids(sim.system().bodies)));
}

BOOST_AUTO_TEST_SUITE_END()
