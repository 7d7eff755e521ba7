// SPDX-License-Identifier: BSL-1.0
#include "bouncing/bouncing.hpp"

namespace validation {
namespace B01 {

constexpr Fall fall{1.0};
constexpr double duration = 1.0;

/// What the scheme does, without talus: the first midpoint below the floor is the place of rest.
struct Landing {
    double height;  ///< of the lowest point from then on [m]
    double speed;   ///< in the step that lands [m/s]
};
Landing landing(double h) {
    // Midpoint k lies at H - g t_k (t_k + h) / 2, because the step is exact for a constant force.
    for (int k = 0;; ++k) {
        const double t = k * h, height = fall.height - g * t * (t + h) / 2;
        if (height <= 0.0) return {height, g * t};
    }
}

double exact_height(double t) { return t < fall.duration() ? fall.height_at(t) : 0.0; }

template <int Dim>
void drop(Trial<Dim>& trial, double h, Curves& curves) {
    auto world = falling_ball<Dim>(trial, h, 0.0, fall);
    const Landing expected = landing(h);
    const double t_land = expected.speed / g + h;
    Worst speed, height;
    Series path{"h = " + std::to_string(h), {}, {}};
    world.run(duration, [&](const auto& w) {
        path.x.push_back(w.time()), path.y.push_back(ball_height(w));
        if (w.time() < t_land - h / 2) return;
        speed.see(ball_speed_up(w), 0.0);
        height.see(ball_height(w), expected.height);
    });
    curves.series.push_back(path);
    trial.rounding("speed from the step of the impact on", speed, fall.speed(), h);
    // 1/h steps add their rounding errors.
    trial.rounding("height from the step of the impact on", height, 1 / h, h);
    trial.within("penetration / (h v)", -ball_height(world) / (h * expected.speed), 0.5, 0.5,
                 "between 0 and 1: the midpoint before was above the floor, and h v is the way "
                 "between midpoints",
                 h);
}

/// Mean over time and over shifted starts of the distance from the exact position.
template <int Dim>
double position_error(Trial<Dim>& trial, double h) {
    double sum = 0.0;
    for (int k = 0; k < start_count; ++k) {
        const double late = h * start_shift(k);
        auto world = falling_ball<Dim>(trial, h, 0.0, fall, late);
        world.run(duration, [&](const auto& w) {
            sum += h * std::abs(ball_height(w) - exact_height(late + w.time()));
        });
    }
    return sum / start_count;
}

template <int Dim>
void run(Trial<Dim>& trial) {
    trial.within("reference, t_c", fall.duration(), 0.451523641, 5e-10, "digits of the catalogue");
    trial.within("reference, v", fall.speed(), 4.4294, 5e-5, "digits of the catalogue");
    // Penetrations of the catalogue in units of h v. It names no step sizes; these give its digits.
    const std::array<std::array<double, 2>, 4> seen{
        {{1e-2, 0.35}, {3.3e-3, 0.68}, {1e-3, 0.98}, {1e-4, 0.26}}};
    Curves curves{"height of the lowest point", "t [s]", "z [m]", {}};
    for (const auto& [h, ratio] : seen) {
        trial.within("reference, penetration / (h v)", -landing(h).height / (h * fall.speed()),
                     ratio, 6e-3, "digits of the catalogue", h);
        drop<Dim>(trial, h, curves);
    }
    // The catalogue bounds the penetration by h sqrt(2 g H). A ball that arrives late is faster by
    // up to g h / 2, and at this step size it gets deeper than that.
    constexpr double late_step = 7e-3;
    drop<Dim>(trial, late_step, curves);
    trial.holds("reference, penetration exceeds h √{2 g H} and stays below h (√{2 g H} + g h / 2)",
                -landing(late_step).height > late_step * fall.speed() &&
                    -landing(late_step).height < late_step * (fall.speed() + g * late_step / 2),
                {}, late_step);
    Series exact{"exact", {}, {}, true};
    for (int k = 0; k <= 200; ++k) {
        exact.x.push_back(duration * k / 200.0);
        exact.y.push_back(exact_height(exact.x.back()));
    }
    curves.series = {curves.series.front(), exact};
    trial.curves(curves);
    // Never more than h v away, for no longer than the whole run.
    trial.order(
        "position, L1", halvings(9.7e-3, trial.full() ? 8 : 6),
        [&](double h) { return position_error<Dim>(trial, h); }, first_order,
        fall.speed() * duration);
}

const Register b01(
    {.id = "B01",
     .name = "soft-drop",
     .title = "A ball without bounce falls on the floor",
     .gate = 2,
     .setup = "A ball is let go one metre above the floor and watched for a second; restitution is "
              "zero.",
     .reference = {"t_c = √{2 H / g}, at rest from then on",
                   "z_h = H − frac{g t_k (t_k + h)}{2}, k the first for which it is not positive",
                   "− h v < z_h ≤ 0"},
     .compared =
         "The speed from the impact on with zero; the height at which the ball stays with "
         "that of the first midpoint below the floor, z_h, and with its bounds; the order "
         "of the position in h (mean over time and over 16 starts shifted by fractions of a "
         "step).",
     .kind = Class::D1,
     .why =
         "The fall is exact, and so is the place of rest, which is a midpoint; it lies less than "
         "the way of one step below the floor. v is the speed in that step, g t_k, which "
         "exceeds √{2 g H} by less than g h / 2.",
     .source = "Moreau 1988.",
     .catches = {Fault::loose_contact, Fault::begin_point, Fault::end_point_drift,
                 Fault::restitution_weight, Fault::stale_candidates},
     .midpoint_because = "It states the midpoint scheme's own steps around the impact."},
    run<2>, run<3>, __FILE__);

}  // namespace B01
}  // namespace validation
