// SPDX-License-Identifier: BSL-1.0
#include "harness/machine.hpp"

namespace validation {
namespace E08 {

/// A pendulum of 1 m and 1 kg, by its angle from the vertical.
struct Pendulum {
    static constexpr int dof = 1;

    void mass(double, const auto&, auto& a) const { a << 1.0; }
    void force(double, const auto& q, const auto&, auto& f) const { f << -g * std::sin(q[0]); }
    void contacts(double, const auto&, auto&) const {}
};

void run(Trial<2>& trial) {
    const double start = 120 * degree,
                 period = 4 / std::sqrt(g) * gsl::ellint_K(std::sin(60 * degree));
    trial.within("reference, period [s]", period, 2.754089829, 5e-10, "digits");
    // At the bottom, where an error in phase is one in angle; at a turning point it is its square.
    const auto bottom = [&](double h) {
        Machine<Pendulum> machine(trial, {}, One(start), One(0.0), {.h = h});
        machine.run(period / 4);
        return machine.q()[0];
    };
    for (const auto& [steps, error] :
         {std::pair{64, 8.835e-5}, std::pair{128, 2.209e-5}, std::pair{256, 5.522e-6}}) {
        const double h = period / 4 / steps;
        trial.within("angle at the bottom [rad]", std::abs(bottom(h)), error, 1e-3 * error,
                     "digits of the catalogue", h);
    }
    trial.order("angle at the bottom", halvings(period / 4 / 32, 6), bottom, second_order);
    // The whole swing, by Jacobi's functions of the time from the bottom.
    const double h = period / 1000, k = std::sin(start / 2);
    Machine<Pendulum> machine(trial, {}, One(start), One(0.0), {.h = h});
    Series exact{"exact", {}, {}, true}, seen{"talus, h = T / 1000", {}, {}};
    Worst worst;
    machine.run(2 * period, [&](const auto& data) {
        const double u = std::sqrt(g) * (data.t_end() + period / 4);
        const double angle = 2 * std::asin(k * gsl::jacobi(u, k * k).sn);
        worst.see(data.q_end[0], angle);
        exact.x.push_back(data.t_end()), exact.y.push_back(angle / degree);
        seen.x.push_back(data.t_end()), seen.y.push_back(data.q_end[0] / degree);
    });
    trial.curves({"two swings", "t [s]", "angle [degrees]", {exact, seen}});
    trial.within("angle in two swings [rad]", worst, 20 * h * h, "20 h^2", h);
}

const Register e08(
    {.id = "E08",
     .name = "large-pendulum",
     .title = "A wide swing",
     .gate = 1,
     .setup = "A pendulum of 1 m let go at 120°.",
     .reference = {"T = 4 √{L/g} K(sin frac{θ_0}{2})",
                   "sin frac{θ}{2} = k sn(√{g/L} t + K), k = sin frac{θ_0}{2}"},
     .compared = "The angle at the bottom after a quarter of the period, its order and its size; "
                 "the angle throughout two swings.",
     .kind = Class::D2,
     .why = "Leapfrog. Not measured at a turning point, where the error in angle is of order 4.",
     .source = "Legendre; Jacobi.",
     .catches = {Fault::force_at_begin, Fault::end_point_drift, Fault::begin_point}},
    run, nullptr, __FILE__);

}  // namespace E08
}  // namespace validation
