// SPDX-License-Identifier: BSL-1.0
#include <Eigen/Core>

#include "free_motion/tops.hpp"

namespace validation {
namespace E02 {

const V<3> moments(1, 2, 3);
constexpr double duration = 10.0;

double energy(const World<3>& world) { return talus::kinetic_energy(world.bodies(), 0); }

void turn(Trial<3>& trial, const V<3>& start, const std::string& about) {
    using talus::Gyroscopic;
    const FreeTop exact(moments, start);
    trial.within("reference, start " + about, exact.spin(0.0), start, 1e-15, "closed form");
    std::vector<double> times;
    for (int k = 0; k <= 100; ++k) times.push_back(duration * k / 100);
    const auto path = gsl::ode(
        [](double, std::span<const double> w, std::span<double> dw) {
            dw[0] = (moments[1] - moments[2]) * w[1] * w[2] / moments[0];
            dw[1] = (moments[2] - moments[0]) * w[2] * w[0] / moments[1];
            dw[2] = (moments[0] - moments[1]) * w[0] * w[1] / moments[2];
        },
        {start[0], start[1], start[2]}, times);
    Worst elliptic;
    for (std::size_t k = 0; k < times.size(); ++k)
        elliptic.see(exact.spin(times[k]), V<3>(path[k][0], path[k][1], path[k][2]));
    trial.within("reference, elliptic functions against the ODE " + about, elliptic, 1e-11,
                 "tolerance of the ODE solver");

    for (const auto option : {Gyroscopic::explicit_term, Gyroscopic::momentum_preserving}) {
        const bool kept = option == Gyroscopic::momentum_preserving;
        const std::string name = ", " + about + ", " + name_of(option);
        const double h_curve = 1e-2;
        auto world = free_top(trial, moments, start, h_curve, option);
        const V<3> momentum = angular_momentum(world, moments);
        Worst drift;
        std::array<Series, 3> seen{Series{"1", {}, {}}, Series{"2", {}, {}}, Series{"3", {}, {}}};
        auto curve = seen;
        world.run(duration, [&](const auto& w) {
            drift.see(angular_momentum(w, moments), momentum);
            const V<3> reference = exact.spin(w.time());
            for (std::size_t k = 0; k < 3; ++k) {
                const auto i = static_cast<Eigen::Index>(k);
                seen[k].x.push_back(w.time()), seen[k].y.push_back(w.bodies().spin[0][i]);
                curve[k].x.push_back(w.time()), curve[k].y.push_back(reference[i]);
            }
        });
        for (Series& s : curve) s.exact = true, s.name += ", exact";
        trial.curves({"spin in body axes" + name,
                      "t [s]",
                      "ω [rad/s]",
                      {seen[0], seen[1], seen[2], curve[0], curve[1], curve[2]}});
        // Momenta of order 3 over 1000 turns of rounding.
        if (kept) trial.rounding("angular momentum in space" + name, drift, 30.0, h_curve);

        const auto end_error = [&](double h) {
            auto w = free_top(trial, moments, start, h, option);
            w.run(duration);
            return (w.bodies().spin[0] - exact.spin(w.time())).norm();
        };
        trial.order("spin after 10 s" + name, halvings(1e-2, 6), end_error,
                    kept ? second_order : first_order);
        const auto energy_error = [&](double h) {
            auto w = free_top(trial, moments, start, h, option);
            const double before = energy(w);
            w.run(duration);
            return energy(w) / before - 1;
        };
        // The implicit map keeps the energy up to a bounded wiggle of second order.
        if (!kept)
            trial.order("energy after 10 s" + name, halvings(1e-2, 6), energy_error, first_order);
        const auto momentum_error = [&](double h) {
            auto w = free_top(trial, moments, start, h, option);
            const V<3> before = angular_momentum(w, moments);
            w.run(duration);
            return (angular_momentum(w, moments) - before).norm();
        };
        if (!kept)
            trial.order("angular momentum in space" + name, halvings(1e-2, 6), momentum_error,
                        first_order);
        if (!kept && about == "about axis 3") {
            trial.within("growth of the energy" + name, energy_error(1e-2), 1.1e-2, 5e-4,
                         "digits given", 1e-2, Class::D1);
            trial.within("growth of the energy" + name, energy_error(5e-3), 5.4e-3, 5e-5,
                         "digits given", 5e-3, Class::D1);
            trial.within("growth of the energy" + name, energy_error(2.5e-3), 2.7e-3, 5e-5,
                         "digits given", 2.5e-3, Class::D1);
        }
    }
}

void run(Trial<3>& trial) {
    const V<3> third(0.5, 0, 0.9), first(0.9, 0, 0.3);
    trial.within("reference, m about axis 3", FreeTop(moments, third).m(), 0.102880658, 5e-10,
                 "digits given");
    trial.within("reference, m about axis 1", FreeTop(moments, first).m(), 1. / 3, 1e-15,
                 "closed form");
    trial.within("reference, period about axis 3", 4 * FreeTop(moments, third).quarter(),
                 7.172075084, 5e-10, "digits given");
    trial.within("reference, period about axis 1", 4 * FreeTop(moments, first).quarter(),
                 13.347698406, 5e-10, "digits given");
    turn(trial, third, "about axis 3");
    turn(trial, first, "about axis 1");
}

const Register e02(
    {.id = "E02",
     .name = "torque-free-asymmetric",
     .title = "A body of three different moments turns freely",
     .setup = "A body of moments 1, 2 and 3 kg m^2 turns without torque, from (0.5, 0, 0.9) rad/s, "
              "around its third axis, and from (0.9, 0, 0.3) rad/s, around its first; with the "
              "gyroscopic term taken explicitly and with the update that keeps momentum.",
     .reference = {"ω_1 = a_1 cn, ω_2 = a_2 sn, ω_3 = a_3 dn for L^2 > 2 T I_2",
                   "a_1^2 = frac{2 T I_3 − L^2}{I_1 (I_3 − I_1)}",
                   "a_2^2 = frac{2 T I_3 − L^2}{I_2 (I_3 − I_2)}",
                   "a_3^2 = frac{L^2 − 2 T I_1}{I_3 (I_3 − I_1)}",
                   "rate^2 = frac{(I_3 − I_2)(L^2 − 2 T I_1)}{I_1 I_2 I_3}",
                   "m = frac{(I_2 − I_1)(2 T I_3 − L^2)}{(I_3 − I_2)(L^2 − 2 T I_1)}",
                   "with 1 and 3 exchanged otherwise"},
     .compared = "The order of the spin in body axes after 10 s; the growth of the energy by the "
                 "explicit term and its order; the angular momentum in space, by its order with "
                 "the explicit term and to rounding with the other.",
     .kind = Class::D1,
     .why = "The explicit term is taken at the velocity of the beginning: order 1, and energy "
            "grows. The other update is time-reversible, hence of order 2, and keeps the momentum "
            "in space to rounding.",
     .source = "Jacobi 1849; Landau and Lifshitz, section 37.",
     .catches = {Fault::gyroscopic_dropped}},
    nullptr, run, __FILE__);

}  // namespace E02
}  // namespace validation
