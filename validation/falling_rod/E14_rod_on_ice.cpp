// SPDX-License-Identifier: BSL-1.0
#include "falling_rod/rod.hpp"

namespace validation {
namespace E14 {

constexpr double start = 10 * degree;

double exact_rate2(double th) {
    const double s = std::sin(th);
    return 12 * g * (std::cos(start) - std::cos(th)) / (rod_length * (1 + 3 * s * s));
}
/// Time from the release to the angle th, integrated over s with th = start + s^2.
double exact_time(double th) {
    if (th <= start) return 0.0;
    return gsl::integral(
               [](double s) {
                   const double angle = start + s * s, sine = std::sin(angle);
                   const double fall =
                       2 * std::sin(start + s * s / 2) * std::sin(s * s / 2);  // of the cosines
                   return 2 * s / std::sqrt(12 * g * fall / (rod_length * (1 + 3 * sine * sine)));
               },
               1e-9, std::sqrt(th - start)) +
           1e-9 * 2 /
               std::sqrt(12 * g * std::sin(start) /
                         (rod_length * (1 + 3 * std::sin(start) * std::sin(start))));
}

/// Angle and rate a time `delay` after the release.
std::vector<double> exact_state(double delay) {
    std::vector<double> y{start, 0.0};
    if (delay <= 0.0) return y;
    const std::array times{0.0, delay};
    return gsl::ode(
               [](double, std::span<const double> s, std::span<double> ds) {
                   // d/dth of rate^2 / 2.
                   const double sin = std::sin(s[0]), cos = std::cos(s[0]);
                   const double d = 1 + 3 * sin * sin;
                   ds[0] = s[1];
                   ds[1] = (6 * g / rod_length * sin - 3 * s[1] * s[1] * sin * cos) / d;
               },
               y, times)
        .back();
}

struct Landing {
    double time = 0.0, rate = 0.0;
    double sideways = 0.0;  ///< largest of the centre [m]
    Series path{"measured", {}, {}};
};

template <int Dim>
Landing fall(Trial<Dim>& trial, double h, double delay = 0.0) {
    const auto y = exact_state(delay);
    auto world = leaning_rod(trial, 0.0, h, y[0], y[1]);
    // Without friction the centre has no velocity along the floor.
    world.bodies().velocity[1] = -rod_length / 2 * y[1] * std::sin(y[0]) * up<Dim>();
    const double x = world.bodies().position[1][0];
    Landing landing;
    double rate_before = y[1];
    world.run(1.0, [&](const auto& w) {
        const double th = rod_angle(w), rate = rod_rate(w);
        landing.sideways = std::max(landing.sideways, std::abs(w.bodies().position[1][0] - x));
        landing.path.x.push_back(w.time() + delay), landing.path.y.push_back(th / degree);
        // Taken from the last step that the other end cannot have touched in.
        const double left = (pi / 2 - th) / rate;
        if (left < h) {
            landing.time = w.time() + delay + left;
            landing.rate = rate + (rate - rate_before) * left / h;
            return false;
        }
        rate_before = rate;
        return true;
    });
    return landing;
}

/// Time of landing by a program of its own, which knows nothing of contacts: height of the centre
/// and angle; where the foot is on the floor at the midpoint its downward velocity is taken away.
double landing_by_hand(double h) {
    const double half = rod_length / 2, inertia = rod_mass * rod_length * rod_length / 12;
    double y = half * std::cos(start), th = start, v = 0.0, rate = 0.0;
    for (double t = 0.0;; t += h) {
        if (rate > 0 && (pi / 2 - th) / rate < h) return t + (pi / 2 - th) / rate;
        y += h / 2 * v, th += h / 2 * rate;
        v -= h * g;
        const double arm = half * std::sin(th), foot = v + arm * rate;
        if (y - half * std::cos(th) <= touching && foot < 0) {
            const double impulse = -foot / (1 / rod_mass + arm * arm / inertia);
            v += impulse / rod_mass, rate += arm * impulse / inertia;
        }
        y += h / 2 * v, th += h / 2 * rate;
    }
}

/// As wide as that of first order at irregular events.
constexpr Band second_order_irregular{1.8, 2.2};

template <int Dim>
void run(Trial<Dim>& trial) {
    const double t_land = exact_time(pi / 2), rate = std::sqrt(exact_rate2(pi / 2));
    trial.within("reference, time of landing", t_land, 0.516571661, 5e-10, "digits given");
    trial.within("reference, rate at landing", rate, 5.383576151, 5e-10, "digits given");
    trial.within("reference, quadrature against the ODE", exact_state(t_land)[0], pi / 2, 1e-10,
                 "two ways to compute it");
    for (const double h : {2.3e-3, 1e-3}) {
        const Landing landing = fall(trial, h);
        trial.rounding("centre sideways", landing.sideways, 0.0, 1.0, h);
        // Rounding of some hundred steps, passed on from hop to hop.
        trial.rounding("time of landing, by hand", landing.time, landing_by_hand(h), 100.0, h);
        trial.within("end of the step of the landing", h * std::ceil(landing.time / h), t_land, h,
                     "h, where the step lies", h, Class::D1);
        if (h == 1e-3) {
            Series exact{"exact", {}, {}, true};
            for (int k = 0; k <= 100; ++k) {
                const double th = start + (pi / 2 - start) * k / 100;
                exact.x.push_back(exact_time(th)), exact.y.push_back(th / degree);
            }
            trial.curves({"angle from the vertical", "t [s]", "θ [deg]", {landing.path, exact}});
        }
    }
    trial.order(
        "time of landing, mean over shifted starts", halvings(2e-3, 6),
        [&](double h) {
            return mean_over_shifts(16, [&](double shift) {
                return std::abs(fall(trial, h, shift * h).time - t_land);
            });
        },
        second_order_irregular);
    trial.order(
        "rate at landing, mean over shifted starts", halvings(2e-3, 6),
        [&](double h) {
            return mean_over_shifts(
                16, [&](double shift) { return std::abs(fall(trial, h, shift * h).rate - rate); });
        },
        second_order_irregular);
}

const Register e14(
    {.id = "E14",
     .name = "rod-on-ice",
     .title = "A rod falls over on ice",
     .setup = "A uniform rod of 1 m stands on a frictionless floor, 10 degrees from the vertical, "
              "and is let go.",
     .reference = {"the centre falls straight down",
                   "ω^2 = frac{12 g (cos θ_0 − cos θ)}{L (1 + 3 sin^2 θ)}",
                   "t = ∫ frac{dθ}{ω}: lies flat at 0.516572 s with ω = 5.383576 rad/s"},
     .compared = "The centre's place along the floor at every step; the step of the landing; the "
                 "time and the rate of turning at landing, found between two steps, by their "
                 "order, and the time against the same method written out by hand.",
     .kind = Class::D1,
     .why = "Nothing pushes sideways: rounding. To know the step of the landing is of first "
            "order. Between the steps the event is better than that: the foot's tiny hops about "
            "the floor leave errors of second order, irregular, whose mean over sixteen starts "
            "shifted by fractions of a step is fitted.",
     .source = "Classical.",
     .catches = {Fault::tilted_normal, Fault::short_arm, Fault::begin_point},
     .midpoint_because = "It states the midpoint scheme's own steps up to the landing."},
    run<2>, run<3>, __FILE__);

}  // namespace E14
}  // namespace validation
