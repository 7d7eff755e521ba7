// SPDX-License-Identifier: BSL-1.0
#include "lagrangian/table.hpp"

namespace validation {
namespace F04 {

constexpr double gamma = 1.5, frequency = 5.0;
const BallOnTable table = BallOnTable::of(gamma, frequency, 0.0);

const double leaving = std::asin(1 / gamma);
double flight() {
    return gsl::root(
        [](double s) {
            return std::sin(leaving) + std::cos(leaving) * s - s * s / (2 * gamma) -
                   std::sin(leaving + s);
        },
        1.0, 6.0);
}

struct Seen {
    double landing = std::nan("");  ///< phase
    double lowest = 0.0;            ///< least gap at a midpoint, over h times the speed of landing
    double carried = 0.0;           ///< largest distance to the table while it carries the ball [m]
    Series path;
};
/// Two periods of the table, begun at `phase`.
Seen watch(Trial<2>& trial, double h, double phase) {
    const double t = phase / table.w;
    Machine<BallOnTable> machine(trial, table, One(table.height(t)), One(table.speed(t)), {.h = h},
                                 t);
    Seen seen;
    double highest = 0.0;
    machine.run(1.0 / frequency, [&](const auto& data) {
        const double apart = data.q_mid[0] - table.height(data.t_mid);
        const double now = table.w * data.t_mid;
        seen.path.x.push_back(now);
        seen.path.y.push_back(data.q_mid[0]);
        highest = std::max(highest, apart);
        seen.lowest = std::min(seen.lowest, apart);
        if (now < leaving || now > leaving + flight() + 0.3)
            seen.carried = std::max(seen.carried, std::abs(apart));
        // In the air it is up to a centimetre off.
        if (highest > 1e-3 && std::isnan(seen.landing) && data.contact_count() > 0)
            seen.landing = now;
    });
    return seen;
}

void run(Trial<2>& trial) {
    const double landing = leaving + flight();
    trial.within("reference, leaves at", leaving, 0.729727656, 5e-10, "digits");
    trial.within("reference, flies for", flight(), 3.566216737, 5e-10, "digits");
    trial.within("reference, lands at", landing, 4.295944393, 5e-10, "digits");
    const double fall = table.a * table.w * std::cos(leaving) - g * flight() / table.w -
                        table.speed(landing / table.w);
    const auto steps = halvings(2e-3, 6);
    trial.order(
        "phase of landing, mean over shifted starts", steps,
        [&](double h) {
            return mean_over_shifts(8, [&](double shift) {
                return std::abs(watch(trial, h, table.w * h * shift).landing - landing);
            });
        },
        first_order_irregular, 2 * table.w);
    for (const double h : steps) {
        const Seen seen = watch(trial, h, 0.0);
        // What it lands with, and what a table that accelerates leaves it by: (h/2) of its speed.
        const double most = h * (std::abs(fall) + table.a * table.w);
        trial.within("deepest midpoint, over its bound", -seen.lowest / most, 0.5, 0.5,
                     "between 0 and 1", h);
        trial.within("off the table while carried [m]", seen.carried, 0.0, most + 10 * g * h * h,
                     "that, and hops of g h^2", h);
        if (h != steps.front()) continue;
        Series exact{"table", {}, {}, true};
        for (int k = 0; k <= 100; ++k)
            exact.x.push_back(2 * pi * k / 100),
                exact.y.push_back(table.height(exact.x.back() / table.w));
        trial.curves({"heights", "w t", "[m]", {seen.path, exact}});
    }
}

const Register f04(
    {.id = "F04",
     .name = "inelastic-ball-on-table",
     .title = "A ball that does not bounce on a table that shakes",
     .gate = 1,
     .setup = "A ball rests on a table a sin(w t) of 5 Hz with a w^2 = 1.5 g; soft impacts.",
     .reference = {"leaves when sin φ_0 = frac{1}{Γ}",
                   "flies for s: sin φ_0 + s cos φ_0 − frac{s^2}{2 Γ} = sin(φ_0 + s)"},
     .compared =
         "The phase of landing, a mean over eight starts shifted by fractions of a step; how "
         "far the ball is from the table while that carries it.",
     .kind = Class::D1,
     .why = "It is seen up to a step late to leave and to land. Carried, it hops: positions are "
            "compared, not contacts.",
     .source = "Mehta and Luck 1990.",
     .catches = {Fault::obstacle_velocity_forgotten, Fault::loose_contact}},
    run, nullptr, __FILE__);

}  // namespace F04
}  // namespace validation
