// SPDX-License-Identifier: BSL-1.0
// A run with stops makes the bits of one without; a file is whole or refused.
#include <talus/io/checkpoint/checkpoint.hpp>
#include <talus/io/write_file.hpp>
#include <talus/law/rolling_coulomb.hpp>
#include <talus/measure/energy_ledger.hpp>
#include <talus/sample/random.hpp>
#include <talus/solver/solver_registry.hpp>
#include <talus/stepping/simulation.hpp>

#include <boost/test/unit_test.hpp>

#include <chrono>
#include <concepts>
#include <csignal>
#include <cstring>
#include <limits>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include "common/dimensions.hpp"
#include "common/random.hpp"
#include "temporary_folder.hpp"

BOOST_AUTO_TEST_SUITE(io_checkpoint)

template <int Dim>
using V = talus::Vector<Dim>;

/// With any solver, and the law for which talus::compiled has them all.
template <int Dim>
struct AnyTypes : talus::SimulationTypes<Dim> {
    using Law = talus::Coulomb<Dim>;
    using Solver = talus::AnySolver<Dim, Law>;
};
/// A hopper's worth of everything: bodies of every shape, a floor that stands, a belt, a table that
/// shakes (made of functions), a wall by a record, a plate that turns; bodies come and go.
template <int Dim, class Types = talus::SimulationTypes<Dim>>
class Yard {
  public:
    using Sim = talus::Simulation<Dim, Types>;

    explicit Yard(typename Sim::Solver solver = talus::default_solver<Dim, Types>(),
                  double h = 2e-3)
        : sim(with_friction<typename Types::Law>(), {.h = h}, std::move(solver)), random(5) {
        auto& system = sim.system();
        const V<Dim> up = V<Dim>::Unit(Dim - 1), x = V<Dim>::Unit(0);
        system.gravity = -9.81 * up;
        system.add_obstacle(talus::HalfSpace<Dim>(up, 0.0));
        system.add_obstacle(talus::HalfSpace<Dim>(x, 0.0));
        system.add_obstacle(talus::HalfSpace<Dim>(-x, -0.9),
                            talus::PrescribedMotion<Dim>::of_displacements(
                                {}, {0.0, 0.1, 0.3}, {V<Dim>::Zero(), 0.02 * x, V<Dim>::Zero()}));
        if constexpr (Dim == 3) {
            system.add_obstacle(talus::HalfSpace<3>(V<3>::Unit(1), 0.0));
            system.add_obstacle(talus::HalfSpace<3>(-V<3>::Unit(1), -0.3));
        }
        V<Dim> thin = V<Dim>::Constant(0.2);
        thin[Dim - 1] = 0.01;
        system.add_obstacle(talus::Box<Dim>(thin), shaking().named("table"));
        talus::AngularVector<Dim> spin = talus::AngularVector<Dim>::Zero();
        spin[spin.size() - 1] = 0.5;
        system.add_obstacle(
            talus::Box<Dim>(thin),
            talus::PrescribedMotion<Dim>::uniform({at(0.65, 0.1), {}}, {V<Dim>::Zero(), spin}));
        for (int k = 0; k < 20; ++k) drop(0.1 + 0.16 * (k % 5), 0.3 + 0.12 * (k / 5));
    }

    template <class Law>
    static Law with_friction() {
        if constexpr (std::same_as<Law, talus::Coulomb<Dim>>)
            return {0.4};
        else
            return {{0.4}, 0.0, 0.0};
    }
    static talus::PrescribedMotion<Dim> shaking() {
        return talus::PrescribedMotion<Dim>::of_pose([](double t) {
            return talus::Pose<Dim>{at(0.25, 0.1 + 0.01 * std::sin(40.0 * t)), {}};
        });
    }
    static V<Dim> at(double x, double up) {
        V<Dim> p = V<Dim>::Constant(0.15);
        p[0] = x;
        p[Dim - 1] = up;
        return p;
    }
    void drop(double x, double up) {
        auto& system = sim.system();
        const talus::Pose<Dim> pose{at(x, up), {}};
        const double r = random.uniform(0.02, 0.04);
        const double density = 2600.0;
        switch (random.integer(0, 4)) {
            case 0:
                system.add(talus::Ball<Dim>(r), density, pose);
                break;
            case 1:
                system.add(talus::Capsule<Dim>(r, 0.4 * r), density, pose);
                break;
            case 2:
                system.add(talus::Box<Dim>(V<Dim>::Constant(0.7 * r)), density, pose);
                break;
            case 3: {
                std::vector<V<Dim>> corners{V<Dim>::Constant(-0.5 * r)};
                for (int k = 0; k < Dim; ++k)
                    corners.push_back(corners[0] + 1.3 * r * V<Dim>::Unit(k));
                system.add(talus::ConvexPolytope<Dim>(corners), density, pose);
                break;
            }
            default:
                system.add(talus::Compound<Dim>({{talus::Ball<Dim>(0.5 * r), {}},
                                                 {talus::Box<Dim>(V<Dim>::Constant(0.3 * r)),
                                                  {0.6 * r * V<Dim>::Unit(0), {}}}}),
                           density, pose);
        }
    }
    /// One step, and what comes and goes with it.
    void step() {
        sim.step();
        summary.record(sim.system(), sim.data());
        if (sim.step_count() % 17 == 0) drop(random.uniform(0.1, 0.8), 0.8);
        if (sim.step_count() % 40 == 0) {
            const int lot = random.integer(0, 6);
            sim.system().remove_if([&](std::size_t i) {
                return !sim.system().bodies.is_obstacle(i) &&
                       i % 7 == static_cast<std::size_t>(lot);
            });
        }
    }

    Sim sim;
    talus::Random random;
    talus::RunSummary summary;
};

/// All numbers of a state, as they are written down.
template <class Sim>
talus::detail::NamedArrays numbers(const Sim& sim) {
    return talus::detail::arrays_of(sim.state());
}
bool same_bits(const talus::detail::NamedArrays& a, const talus::detail::NamedArrays& b) {
    if (a.integers != b.integers || a.reals.size() != b.reals.size()) return false;
    for (const auto& [name, list] : a.reals) {
        const auto found = b.reals.find(name);
        if (found == b.reals.end() || found->second.size() != list.size() ||
            (!list.empty() && std::memcmp(list.data(), found->second.data(), 8 * list.size()) != 0))
            return false;
    }
    return true;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(goes_on_with_the_same_bits_from_ten_random_moments, D, dimensions) {
    constexpr int Dim = D::value;
    const TemporaryFolder folder("checkpoint");
    constexpr int steps = Dim == 2 ? 400 : 200;
    talus::Random lot(11);
    std::vector<bool> saved(steps, false);
    for (int k = 0; k < 10; ++k) saved[static_cast<std::size_t>(lot.integer(0, steps - 1))] = true;
    Yard<Dim> through;
    Yard<Dim> stopped;  // replaced at each stop by one that knows the file alone
    for (int k = 0; k < steps; ++k) {
        through.step();
        stopped.step();
        if (!saved[static_cast<std::size_t>(k)]) continue;
        talus::save_checkpoint(folder / "yard.h5", stopped.sim, "yard",
                               {{"random", talus::record_of(stopped.random)}});
        Yard<Dim> next;
        const auto records = talus::load_checkpoint(folder / "yard.h5", next.sim, "yard");
        next.random = talus::from_record<talus::Random>(records.at("random"));
        BOOST_REQUIRE(same_bits(numbers(next.sim), numbers(stopped.sim)));
        BOOST_REQUIRE(next.sim.time() == through.sim.time());
        std::swap(stopped.sim, next.sim);
        std::swap(stopped.random, next.random);
    }
    BOOST_TEST(same_bits(numbers(stopped.sim), numbers(through.sim)));
    BOOST_TEST(through.sim.system().bodies.count() > 15u);
    BOOST_TEST(through.summary.missed == 0);
    BOOST_TEST(folder.file_count() == 1);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(every_solver_goes_on_with_the_same_bits, D, dimensions) {
    constexpr int Dim = D::value;
    using Law = talus::Coulomb<Dim>;
    for (const talus::SolverName& name : talus::solver_names<Dim, Law>()) {
        if (name.name == "enumeration") continue;  // for the smallest problems
        const auto fresh = [&] {
            return Yard<Dim, AnyTypes<Dim>>(
                talus::make_solver<Dim, Law>(name.name, {.tolerance = 1e-6}));
        };
        auto through = fresh(), next = fresh();
        for (int k = 0; k < 60; ++k) through.step();
        const auto state = through.sim.state();
        next.sim.restore(state);
        for (int k = 0; k < 15; ++k) {
            through.sim.step();
            next.sim.step();
        }
        BOOST_TEST(same_bits(numbers(next.sim), numbers(through.sim)), name.name);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(books_and_summaries_are_carried_along, D, dimensions) {
    constexpr int Dim = D::value;
    Yard<Dim> yard;
    talus::EnergyLedger<Dim> books(yard.sim.system().bodies, yard.sim.system().gravity);
    const auto go = [](auto& sim, auto& ledger, auto& summary) {
        for (int k = 0; k < 30; ++k) {
            sim.step();
            ledger.record(sim.data(), sim.system().bodies);
            summary.record(sim.system(), sim.data());
        }
    };
    go(yard.sim, books, yard.summary);
    Yard<Dim> next;
    next.sim.restore(yard.sim.state());
    auto same = talus::from_record<talus::EnergyLedger<Dim>>(talus::record_of(books));
    auto summary = talus::from_record<talus::RunSummary>(talus::record_of(yard.summary));
    go(yard.sim, books, yard.summary);
    go(next.sim, same, summary);
    BOOST_TEST((talus::record_of(same) == talus::record_of(books)));
    BOOST_TEST(to_string(summary) == to_string(yard.summary));
    BOOST_TEST(books.closure() < 1e-12);
}

template <int Dim>
struct RollingTypes : talus::SimulationTypes<Dim> {
    using Law = talus::RollingFriction<Dim>;
};

// The moments of rolling friction are written too, and only where there are some.
BOOST_AUTO_TEST_CASE_TEMPLATE(rolling_friction_goes_on_with_the_same_bits, D, dimensions) {
    constexpr int Dim = D::value;
    using V = talus::Vector<Dim>;
    const TemporaryFolder folder("checkpoint_rolling");
    using Simulation = talus::Simulation<Dim, RollingTypes<Dim>>;
    const talus::RollingFriction<Dim> law{.mu = 0.5, .mu_r = 0.1};
    Simulation through(law), next(law);
    auto& system = through.system();
    system.gravity = V(3.0 * V::Unit(0) - 9.81 * V::Unit(Dim - 1));
    system.add_obstacle(talus::HalfSpace<Dim>{V::Unit(Dim - 1), 0.0});
    for (int k = 0; k < 4; ++k)
        system.add(talus::Ball<Dim>{0.1}, 1000.0,
                   {V(0.1 * V::Unit(Dim - 1) + 0.19 * k * V::Unit(0)), {}});
    BOOST_TEST(through.run(0.05).missed == 0);
    talus::save_checkpoint(folder / "balls.h5", through, "balls", {});
    talus::load_checkpoint(folder / "balls.h5", next, "balls");
    BOOST_TEST(numbers(next).reals.contains("contacts/moment_world"));
    BOOST_TEST(!numbers(Yard<Dim>().sim).reals.contains("contacts/moment_world"));
    for (auto* sim : {&through, &next})
        for (int k = 0; k < 50; ++k) (void)sim->step();
    BOOST_TEST(same_bits(numbers(next), numbers(through)));
}

BOOST_AUTO_TEST_CASE(a_record_that_is_not_there_is_refused_by_name) {
    const talus::CheckpointRecords records{{"rain", {}}, {"run", {}}};
    BOOST_CHECK_NO_THROW((void)records.at("rain"));
    BOOST_CHECK_EXCEPTION((void)records.at("snow"), talus::input_error, [](const auto& error) {
        const std::string sentence = error.what();
        return sentence.find("'snow'") != std::string::npos &&
               sentence.find("rain, run") != std::string::npos;
    });
}

BOOST_AUTO_TEST_CASE(a_state_can_be_gone_back_to) {
    Yard<2> yard;
    for (int k = 0; k < 50; ++k) yard.step();
    const auto state = yard.sim.state();
    const auto before = numbers(yard.sim);
    for (int k = 0; k < 30; ++k) yard.step();
    const auto once = numbers(yard.sim);
    BOOST_TEST(!same_bits(before, once));
    yard.sim.restore(state);
    BOOST_TEST(same_bits(before, numbers(yard.sim)));
    // Without the random numbers, which the state does not have, bodies that come differ.
    for (int k = 0; k < 10; ++k) yard.sim.step();
    const auto twice = yard.sim.state();
    yard.sim.restore(state);
    for (int k = 0; k < 10; ++k) yard.sim.step();
    BOOST_TEST(same_bits(talus::detail::arrays_of(twice), numbers(yard.sim)));
}

BOOST_AUTO_TEST_CASE(removed_bodies_leave_their_names_behind) {
    Yard<2> yard;
    auto& system = yard.sim.system();
    const auto last = static_cast<std::size_t>(system.bodies.count() - 1);
    const talus::BodyId gone = system.bodies.id[last];
    system.remove(gone);
    Yard<2> next;
    next.sim.restore(yard.sim.state());
    next.drop(0.5, 0.9);
    BOOST_TEST(!next.sim.system().bodies.find(gone).has_value());
    BOOST_TEST((next.sim.system().bodies.id[last] > gone));
}

/// What loading says, with the simulation as it was.
template <class Sim>
std::string complaint(const std::filesystem::path& path, Sim& sim, const std::string& experiment) {
    const auto before = numbers(sim);
    std::string said;
    try {
        talus::load_checkpoint(path, sim, experiment);
    } catch (const talus::input_error& error) {
        said = error.what();
    }
    BOOST_TEST(same_bits(before, numbers(sim)));
    return said;
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

BOOST_AUTO_TEST_CASE(what_is_not_this_run_is_refused_in_one_sentence) {
    const TemporaryFolder folder("checkpoint-refused");
    const auto path = folder / "yard.h5";
    Yard<2> yard;
    for (int k = 0; k < 20; ++k) yard.step();
    talus::save_checkpoint(path, yard.sim, "yard");
    Yard<2> other;
    BOOST_TEST(has(complaint(path, other.sim, "silo"), "experiment is 'yard', but must be 'silo'"));
    BOOST_TEST(has(complaint(folder / "none.h5", other.sim, "yard"), "cannot be read"));
    Yard<2> coarse(talus::default_solver<2, talus::SimulationTypes<2>>(), 4e-3);
    BOOST_TEST(has(complaint(path, coarse.sim, "yard"), "step size h of the state is 0.002"));
    Yard<3> space;
    BOOST_TEST(has(complaint(path, space.sim, "yard"), "dimension is 2, but must be 3"));
    // A motion made of functions, which nobody gives, or which leads elsewhere.
    talus::Simulation<2> bare(talus::DefaultLaw<2>{{0.4}, 0.0, 0.0}, {.h = 2e-3});
    BOOST_TEST(has(complaint(path, bare, "yard"), "named 'table', but must then be given by name"));
    BOOST_CHECK_THROW(talus::load_checkpoint(path, bare, "yard", {{"table", {}}}),
                      talus::input_error);
    BOOST_TEST(bare.system().bodies.count() == 0u);
    talus::load_checkpoint(path, bare, "yard", {{"table", Yard<2>::shaking()}});
    BOOST_TEST(same_bits(numbers(bare), numbers(yard.sim)));
    BOOST_CHECK_THROW(
        talus::save_checkpoint(path, yard.sim, "yard", {{"a/b", talus::NumberRecord{}}}),
        talus::input_error);
    talus::load_checkpoint(path, other.sim, "yard");  // what was there stays
    BOOST_TEST(same_bits(numbers(other.sim), numbers(yard.sim)));
}

BOOST_AUTO_TEST_CASE(a_motion_of_another_kind_is_noticed) {
    const TemporaryFolder folder("checkpoint-motion");
    const auto build = [](const talus::PrescribedMotion<2>& motion) {
        talus::Simulation<2> sim(talus::DefaultLaw<2>{{0.4}, 0.0, 0.0}, {.h = 1e-3});
        sim.system().add_obstacle(talus::HalfSpace<2>(V<2>::Unit(1), 0.0), motion);
        return sim;
    };
    const talus::PrescribedMotion<2> still;
    const auto conveyor = still.named("conveyor").with_surface([](double) {
        return talus::Twist<2>{V<2>::Unit(0), {}};
    });
    BOOST_TEST(conveyor.name() == "conveyor");
    auto sim = build(conveyor);
    sim.step();
    talus::save_checkpoint(folder / "belt.h5", sim, "belt");
    auto other = build(still.named("conveyor"));
    BOOST_CHECK_THROW(talus::load_checkpoint(folder / "belt.h5", other, "belt"),
                      talus::input_error);
    auto same = build(conveyor);
    BOOST_CHECK_NO_THROW(talus::load_checkpoint(folder / "belt.h5", same, "belt"));
}

BOOST_AUTO_TEST_CASE(within_a_step_nothing_is_restored) {
    Yard<2> yard;
    const auto saved = yard.sim.state();
    for (int k = 0; k < 5; ++k) yard.step();
    const auto before = numbers(yard.sim);
    yard.sim.system().forces.push_back([&](double, const auto&, auto) { yard.sim.restore(saved); });
    BOOST_CHECK_THROW(yard.sim.step(), talus::input_error);
    BOOST_TEST(same_bits(before, numbers(yard.sim)));
}

BOOST_AUTO_TEST_CASE(records_of_impossible_things_are_refused) {
    using Box = talus::Box<3>;
    const auto refused = [](auto change) {
        talus::NumberRecord record = talus::record_of(Box(V<3>(0.1, 0.2, 0.3)));
        change(record);
        BOOST_CHECK_THROW(talus::from_record<Box>(record), talus::input_error);
    };
    // 8 vertices, 6 normals, then the begins of 6 loops: none may wrap around.
    refused([](auto& r) { r.integers[4] = 0xfffffffe; });
    refused([](auto& r) { r.integers[3] = 1; });
    refused([](auto& r) { r.integers.back() = 99; });
    refused([](auto& r) { r.reals[3 + 3 * 8] = 2.0; });  // a normal of another length
    refused([](auto& r) { r.reals[4] = std::numeric_limits<double>::quiet_NaN(); });
    talus::NumberRecord turn = talus::record_of(talus::Rotation<3>());
    turn.reals[3] = 2.0;
    BOOST_CHECK_THROW(talus::from_record<talus::Rotation<3>>(turn), talus::input_error);
    talus::NumberRecord wall = talus::record_of(talus::HalfSpace<2>(V<2>::Unit(1), 0.0));
    wall.reals[1] = 3.0;
    BOOST_CHECK_THROW(talus::from_record<talus::HalfSpace<2>>(wall), talus::input_error);
}

/// What loading says; nothing if it loaded, and then what was saved.
std::string complaint_or_state(const std::filesystem::path& path, Yard<2>& other,
                               const Yard<2>& saved) {
    try {
        talus::load_checkpoint(path, other.sim, "yard");
    } catch (const talus::input_error& error) {
        return error.what();
    }
    BOOST_TEST(same_bits(numbers(other.sim), numbers(saved.sim)));
    return {};
}

BOOST_AUTO_TEST_CASE(a_damaged_file_is_refused) {
    const TemporaryFolder folder("checkpoint-damaged");
    const auto path = folder / "yard.h5", damaged = folder / "damaged.h5";
    Yard<2> yard;
    for (int k = 0; k < 20; ++k) yard.step();
    talus::save_checkpoint(path, yard.sim, "yard", {{"random", talus::record_of(yard.random)}});
    const std::string whole = content_of(path);
    talus::Random lot(3);
    int refused = 0, unharmed = 0;
    for (int trial = 0; trial < 300; ++trial) {
        std::string text = whole;
        const auto where =
            static_cast<std::size_t>(lot.integer(0, static_cast<int>(whole.size()) - 1));
        if (trial % 3 == 0)
            text.resize(where);
        else
            text[where] = static_cast<char>(text[where] ^ (1 << lot.integer(0, 7)));
        talus::write_file(damaged, text);
        Yard<2> other;
        const std::string said = complaint_or_state(damaged, other, yard);
        if (said.empty())
            ++unharmed;  // padding of the format
        else
            refused += has(said, "damaged.h5") ? 1 : 0;
    }
    BOOST_TEST(refused + unharmed == 300);
    BOOST_TEST(refused > 150);
}

BOOST_AUTO_TEST_CASE(numbers_of_a_type_without_bytes_are_refused) {
    const TemporaryFolder folder("checkpoint-types");
    const auto path = folder / "yard.h5", damaged = folder / "damaged.h5";
    const Yard<2> yard;
    talus::save_checkpoint(path, yard.sim, "yard");
    const std::string whole = content_of(path);
    // How HDF5 writes down the types of 8 bytes that a checkpoint has; the fifth byte is the 8.
    int found = 0;
    for (const std::string& type : {std::string("\x11\x20\x3f\x00\x08\x00\x00\x00", 8),
                                    std::string("\x10\x08\x00\x00\x08\x00\x00\x00", 8)})
        for (auto at = whole.find(type); at != std::string::npos; at = whole.find(type, at + 1)) {
            std::string text = whole;
            text[at + 4] = '\0';
            talus::write_file(damaged, text);
            Yard<2> other;
            BOOST_CHECK_THROW(talus::load_checkpoint(damaged, other.sim, "yard"),
                              talus::input_error);
            ++found;
        }
    BOOST_TEST(found > 5);
}

BOOST_AUTO_TEST_CASE(killed_while_it_writes_the_last_whole_file_stays) {
    const TemporaryFolder folder("checkpoint-killed");
    const auto path = folder / "yard.h5";
    Yard<2> yard;
    talus::save_checkpoint(path, yard.sim, "yard");
    talus::Random lot(8);
    for (int trial = 0; trial < 100; ++trial) {
        int said[2];  // a byte for each file that the child begins to write
        BOOST_REQUIRE(::pipe(said) == 0);
        const pid_t child = ::fork();
        BOOST_REQUIRE(child >= 0);
        if (child == 0) {
            for (;;) {
                yard.sim.step();
                if (::write(said[1], "w", 1) != 1) ::_exit(1);
                talus::save_checkpoint(path, yard.sim, "yard");
            }
        }
        char byte = 0;
        for (int k = 0; k < 2; ++k) BOOST_REQUIRE(::read(said[0], &byte, 1) == 1);
        std::this_thread::sleep_for(std::chrono::microseconds(lot.integer(0, 2000)));
        ::kill(child, SIGKILL);
        int status = 0;
        ::waitpid(child, &status, 0);
        ::close(said[0]);
        ::close(said[1]);
        BOOST_TEST(WIFSIGNALED(status));
        Yard<2> next;
        BOOST_CHECK_NO_THROW(talus::load_checkpoint(path, next.sim, "yard"));
        BOOST_TEST(next.sim.step_count() >= yard.sim.step_count());
        std::swap(yard.sim, next.sim);
    }
    BOOST_TEST(yard.sim.step_count() >= 100);
}

BOOST_AUTO_TEST_SUITE_END()
