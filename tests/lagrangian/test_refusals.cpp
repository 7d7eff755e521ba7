// SPDX-License-Identifier: BSL-1.0
#include <Eigen/Core>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "lagrangian/systems.hpp"

BOOST_AUTO_TEST_SUITE(lagrangian_refusals)

using namespace machines;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

namespace {

/// A system that can be spoilt.
struct Spoilt {
    static constexpr int dof = 2;
    double a01 = 0.0, a10 = 0.0, a11 = 1.0, force0 = 0.0, gap = 1.0, row = 0.0, mu = 0.0,
           restitution = 0.0;
    double from = 0.0;  // spoilt from then on
    bool throws = false;

    void mass(double t, const auto&, auto& a) const {
        a << 1.0, 0.0, 0.0, 1.0;
        if (t < from) return;
        a(0, 1) = a01;
        a(1, 0) = a10;
        a(1, 1) = a11;
    }
    void force(double t, const auto&, const auto&, auto& f) const {
        f << 1.0, 2.0;
        if (t >= from) f[0] += force0;
        if (t >= from && throws) throw std::runtime_error("no");
    }
    void contacts(double t, const auto& q, auto& contacts) const {
        const PlaneLaw law = t < from ? PlaneLaw{} : PlaneLaw{{mu}, restitution, 0.0};
        auto& c = contacts.add((t < from ? 1.0 : gap) + q[1], law, "foot");
        c.rows(0, 1) = 1.0;
        if (t >= from) c.rows(1, 0) = row;
    }
};

std::string complaint(const std::function<void()>& f) {
    try {
        f();
    } catch (const talus::input_error& e) {
        return e.what();
    }
    return "nothing";
}
void must_complain(const Spoilt& system, const std::string& words) {
    const std::string text = complaint([&] { talus::LagrangianSimulation(system, Two(0.0, 0.0)); });
    BOOST_TEST(text.find(words) == 0u, text);
}

}  // namespace

BOOST_AUTO_TEST_CASE(what_a_system_gives_is_looked_at) {
    must_complain({}, "nothing");
    must_complain({.a11 = 0.0},
                  "mass matrix is not positive definite: its pivot of coordinate 1 at "
                  "t = 0 s is 0, but must be above 0");
    must_complain({.a11 = -2.0}, "mass matrix is not positive definite: its pivot of coordinate 1");
    must_complain({.a01 = 1.0, .a10 = 1.0}, "mass matrix is not positive definite");
    must_complain({.a01 = 0.5},
                  "mass matrix[1][0] at t = 0 s is 0, but must be that of mass "
                  "matrix[0][1], 0.5");
    must_complain({.a01 = nan}, "mass matrix[0][1] at t = 0 s is nan, but must be finite");
    must_complain({.force0 = nan}, "force[0] at t = 0 s is nan, but must be finite");
    must_complain({.gap = nan}, "gap of contact 0 (foot) at t = 0 s is nan, but must be finite");
    must_complain({.row = nan}, "tangential row 1[0] of contact 0 (foot) at t = 0 s is nan");
    must_complain({.mu = -1.0},
                  "Lagrangian system at t = 0 s: law of contact 0 (foot).mu is -1, but must be "
                  "finite and not negative");
}

BOOST_AUTO_TEST_CASE(what_goes_wrong_within_a_step_leaves_the_state_as_it_was) {
    Spoilt by_mass{.from = 0.0105}, by_force = by_mass, by_throw = by_mass, by_gap = by_mass,
                                    by_law = by_mass;
    by_mass.a11 = -1.0;
    by_force.force0 = nan;
    by_throw.throws = true;
    by_gap.gap = nan;
    by_law.gap = -1.0;
    by_law.mu = -0.5;
    for (const Spoilt& system : {by_mass, by_force, by_throw, by_gap, by_law}) {
        talus::LagrangianSimulation sim(system, Two(0.0, 0.0), {.h = 1e-3});
        BOOST_TEST(sim.run(0.01).certified());
        const Two q = sim.position(), u = sim.velocity();
        const double t = sim.time();
        const auto* data = &sim.data();
        BOOST_CHECK_THROW(sim.step(), std::exception);
        BOOST_TEST((sim.position() == q && sim.velocity() == u));
        BOOST_TEST(sim.time() == t);
        BOOST_TEST(sim.step_count() == 10);
        BOOST_TEST((&sim.data() == data && data->q_end == q));
    }
}

BOOST_AUTO_TEST_CASE(laws_of_closed_contacts_are_looked_at_in_each_step) {
    Spoilt by_mu{.gap = -1.0, .mu = -0.5, .from = 0.0102}, by_nan = by_mu, by_restitution = by_mu;
    by_nan.mu = nan;
    by_restitution.mu = 0.0;
    by_restitution.restitution = 3.0;
    const std::string item = "Lagrangian system at t = 0.0105 s: law of contact 0 (foot)";
    for (const auto& [system, words] :
         {std::pair{by_mu, ".mu is -0.5, but must be finite and not negative"},
          std::pair{by_nan, ".mu is nan, but must be finite and not negative"},
          std::pair{by_restitution, ".restitution_normal is 3, but must be in [0, 1]"}}) {
        talus::LagrangianSimulation sim(system, Two(0.0, 0.0), {.h = 1e-3});
        BOOST_TEST(sim.run(0.01).certified());
        BOOST_TEST(complaint([&] { (void)sim.run(0.01); }) == item + words);
        BOOST_TEST(sim.step_count() == 10);
        // What is mended goes on with the bits of what was never bad.
        sim.system() = {.gap = -1.0, .from = 0.0102};
        talus::LagrangianSimulation good(sim.system(), Two(0.0, 0.0), {.h = 1e-3});
        BOOST_TEST(sim.run(0.01).certified());
        BOOST_TEST(good.run(0.02).certified());
        BOOST_TEST((sim.position() == good.position() && sim.velocity() == good.velocity()));
    }
    // Of an open contact the law is no matter before it closes.
    talus::LagrangianSimulation open(Spoilt{.gap = 1.0, .mu = -0.5, .from = 0.0102}, Two(0.0, 0.0),
                                     {.h = 1e-3});
    BOOST_TEST(open.run(0.02).certified());
}

BOOST_AUTO_TEST_CASE(states_and_settings) {
    const auto words = [](const std::string& text, const std::string& wanted) {
        BOOST_TEST(text.find(wanted) == 0u, text);
    };
    words(complaint([] { talus::LagrangianSimulation(Spoilt{}, Two(0.0, nan)); }),
          "q[1] is nan, but must be finite");
    words(complaint([] { talus::LagrangianSimulation(Spoilt{}, Two(0.0, 0.0), {.h = 0.0}); }),
          "step size h is 0, but must be finite and positive");
    words(complaint([] {
              talus::LagrangianSimulation(Spoilt{}, Two(0.0, 0.0), {.contact_tolerance = -1.0});
          }),
          "contact tolerance is -1");
    words(complaint([] {
              talus::LagrangianSimulation(Spoilt{}, Two(0.0, 0.0), {.coordinate_scale = 0.0});
          }),
          "coordinate scale is 0, but must be finite and positive");
    const Eigen::VectorXd three = Eigen::VectorXd::Ones(3), two = Eigen::VectorXd::Ones(2);
    words(complaint([&] { talus::LagrangianSimulation(Stack{}, three, two); }),
          "number of velocities is 2, but must be that of coordinates, 3");
    words(complaint([&] { talus::LagrangianSimulation(Stack{}, Eigen::VectorXd()); }),
          "number of coordinates is 0, but must be positive");
    talus::LagrangianSimulation sim(Stack{}, three);
    words(complaint([&] { (void)sim.run(-1.0); }), "duration is -1");
    words(complaint([&] { sim.set_state(three, nan * three); }), "u[0] is nan");
    BOOST_TEST((sim.position() == three));
}

BOOST_AUTO_TEST_SUITE_END()
