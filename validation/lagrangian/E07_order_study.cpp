// SPDX-License-Identifier: BSL-1.0
#include "harness/machine.hpp"

namespace validation {
namespace E07 {

enum class Kind { forced, damped, changing_mass };

/// q'' = -q + cos 2t, the same with a damper of 0.3, and (1 + q^2) q'' = -q q'^2 - q.
struct Oscillator {
    static constexpr int dof = 1;
    Kind kind;

    double inertia(double q) const { return kind == Kind::changing_mass ? 1 + q * q : 1.0; }
    double force(double t, double q, double u) const {
        if (kind == Kind::changing_mass) return -q * u * u - q;
        return -q + std::cos(2 * t) - (kind == Kind::damped ? 0.3 * u : 0.0);
    }
    void mass(double, const auto& q, auto& a) const { a << inertia(q[0]); }
    void force(double t, const auto& q, const auto& u, auto& f) const { f << force(t, q[0], u[0]); }
    void contacts(double, const auto&, auto&) const {}
    double start() const { return kind == Kind::changing_mass ? 0.5 : 0.0; }
};

constexpr double duration = 2.0;

double exact(const Oscillator& o) {
    const auto rhs = [&](double t, std::span<const double> y, std::span<double> dy) {
        dy[0] = y[1];
        dy[1] = o.force(t, y[0], y[1]) / o.inertia(y[0]);
    };
    return gsl::ode(rhs, {1.0, o.start()}, std::vector{0.0, duration}).back()[0];
}

void run(Trial<2>& trial) {
    struct Case {
        Kind kind;
        std::string name;
        double error;  // of the catalogue at h = 0.01
    };
    for (const auto& [kind, name, error] :
         {Case{Kind::forced, "forced", 1.05e-5}, Case{Kind::damped, "damped", 1.27e-3},
          Case{Kind::changing_mass, "A(q)", 7.6e-4}}) {
        const Oscillator oscillator{kind};
        const double end = exact(oscillator);
        const auto off = [&](talus::VelocityForces forces) {
            return [&, forces](double h) {
                Machine<Oscillator> machine(trial, oscillator, One(1.0), One(oscillator.start()),
                                            {.h = h, .velocity_forces = forces});
                machine.run(duration);
                return machine.q()[0] - end;
            };
        };
        const auto begin = off(talus::VelocityForces::explicit_begin);
        trial.within("error at h = 0.01, " + name, std::abs(begin(1e-2)), error, 0.01 * error,
                     "digits of the catalogue", 1e-2);
        trial.order(name + ", F at the velocity of the beginning", halvings(2e-2, 5), begin,
                    kind == Kind::forced ? second_order : first_order);
        trial.order(name + ", F at the mean velocity", halvings(2e-2, 5),
                    off(talus::VelocityForces::implicit_midpoint), second_order);
    }
}

const Register e07(
    {.id = "E07",
     .name = "order-study",
     .title = "Which order the free step has",
     .gate = 1,
     .setup = "Three oscillators without contact for 2 s: a force that depends on time, one that "
              "depends on velocity too, and a mass that depends on position.",
     .reference = {"q'' = −q + cos 2t", "q'' = −q − 0.3 q' + cos 2t",
                   "(1 + q^2) q'' = −q q'^2 − q"},
     .compared = "The position at the end with that of an integration of order 8, by both "
                 "treatments of velocities in F; the size of the error at h = 0.01.",
     .kind = Class::D2,
     .why = "Leapfrog is of order 2; F(t, q, u) at the velocity of the beginning is of order 1, at "
            "the mean velocity of order 2.",
     .source = "Moreau, section 2.3, equation (9).",
     .catches = {Fault::force_at_begin, Fault::end_point_drift, Fault::begin_point}},
    run, nullptr, __FILE__);

}  // namespace E07
}  // namespace validation
