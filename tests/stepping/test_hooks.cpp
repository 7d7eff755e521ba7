// SPDX-License-Identifier: BSL-1.0
#include <talus/geometry/any_shape_of.hpp>
#include <talus/geometry/ball.hpp>
#include <talus/geometry/half_space.hpp>
#include <talus/solver/sweeps/gauss_seidel.hpp>
#include <talus/stepping/equilibrium.hpp>
#include <talus/stepping/simulation.hpp>

#include <boost/test/unit_test.hpp>

#include <string>
#include <type_traits>

BOOST_AUTO_TEST_SUITE(stepping_hooks)

using Law = talus::DefaultLaw<2>;
using Shapes = talus::AnyShapeOf<2, talus::Ball<2>, talus::HalfSpace<2>>;

/// Writes down when it was called, and what was known then.
struct Diary : talus::NoHooks {
    std::string* text = nullptr;

    void at_midpoint(auto&, auto& data) { note("mid", data.begin.size()); }
    void matrices_known(auto&, auto& data) {
        note("matrices", data.problem.jacobian.contact_count());
    }
    void forces_known(auto&, auto& data) { note("forces", data.free.size()); }
    void problem_known(auto&, auto& data) { note("problem", data.problem.free_velocity.size()); }
    void solved(auto&, auto& data) { note("solved", data.impulse.size()); }
    void velocities_known(auto&, auto& data) { note("velocities", data.end.size()); }
    void finished(auto&, auto&) { note("finished", 0); }

    void note(const char* stage, std::size_t count) {
        if (text) *text += std::string(stage) + " " + std::to_string(count) + ", ";
    }
};

/// Doubles every impulse before it is applied.
struct Twice : talus::NoHooks {
    void solved(auto&, auto& data) {
        for (auto& r : data.impulse) r *= 2.0;
    }
};

template <class HooksType>
struct Types : talus::SimulationTypes<2> {
    using Shape = Shapes;
    using Hooks = HooksType;
};
template <class Hooks>
using Sim = talus::Simulation<2, Types<Hooks>>;

template <class Hooks>
Sim<Hooks> resting_ball() {
    Sim<Hooks> sim(Law{}, {.h = 1e-2});
    sim.system().gravity = {0.0, -10.0};
    sim.system().add_obstacle(talus::HalfSpace<2>{{0.0, 1.0}});
    sim.system().add(talus::Ball<2>{0.5}, talus::Inertia<2>{1.0, talus::AngularVector<2>(0.1)},
                     {{0.0, 0.5}, {}});
    return sim;
}

BOOST_AUTO_TEST_CASE(hooks_are_called_between_the_stages_in_their_order) {
    std::string text;
    auto sim = resting_ball<Diary>();
    sim.hooks().text = &text;
    sim.step();
    BOOST_CHECK_EQUAL(
        text, "mid 2, matrices 1, forces 2, problem 1, solved 1, velocities 2, finished 0, ");
}

BOOST_AUTO_TEST_CASE(what_a_hook_changes_the_step_goes_on_with) {
    auto plain = resting_ball<talus::NoHooks>();
    plain.step();
    BOOST_CHECK_SMALL(plain.system().bodies.velocity[1][1], 1e-15);
    auto twice = resting_ball<Twice>();
    twice.step();
    BOOST_CHECK_CLOSE(twice.system().bodies.velocity[1][1], 0.1, 1e-10);
}

BOOST_AUTO_TEST_CASE(equilibrium_takes_hooks_too) {
    auto sim = resting_ball<talus::NoHooks>();
    const auto sound = talus::equilibrium(sim.system(), {.h = 1e-2});
    BOOST_CHECK(sound.verdict == talus::Verdict::equilibrium);
    const auto broken =
        talus::equilibrium(sim.system(), {.h = 1e-2}, talus::GaussSeidel<2, Law>(), {}, Twice{});
    BOOST_CHECK(broken.verdict == talus::Verdict::moving);
}

BOOST_AUTO_TEST_CASE(hooks_that_do_nothing_take_no_room) {
    struct Plain {
        double x;
    };
    struct With {
        double x;
        [[no_unique_address]] talus::NoHooks hooks;
    };
    static_assert(std::is_empty_v<talus::NoHooks> && sizeof(With) == sizeof(Plain));
    BOOST_CHECK_EQUAL(sizeof(With), sizeof(Plain));
}

BOOST_AUTO_TEST_SUITE_END()
