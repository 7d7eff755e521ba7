// SPDX-License-Identifier: BSL-1.0
#include <map>

#include "bouncing/bouncing.hpp"

namespace validation {
namespace B03 {

constexpr Fall fall{1.0};
constexpr int watched = 3;  // the bounce whose time and peak are followed

/// The exact motion: parabolas that shrink by e^2, infinitely many before t_inf.
struct Bouncing {
    double e;

    double t_inf() const { return fall.duration() * (1 + e) / (1 - e); }
    /// Time of bounce n = 0, 1, ...
    double bounce(int n) const {
        double sum = 0.0, power = 1.0;
        for (int k = 1; k <= n; ++k) sum += power *= e;
        return fall.duration() * (1 + 2 * sum);
    }
    /// Height of the peak after n bounces.
    double peak(int n) const { return std::pow(e, 2 * n) * fall.height; }
    double height(double t) const {
        if (t < fall.duration()) return fall.height_at(t);
        if (t >= t_inf()) return 0.0;
        double begin = fall.duration(), speed = e * fall.speed();
        while (t >= begin + 2 * speed / g && speed > 1e-15) {
            begin += 2 * speed / g;
            speed *= e;
        }
        const double s = t - begin;
        return std::max(0.0, s * (speed - g * s / 2));
    }
};

/// Means over the shifted starts.
struct Errors {
    double position = 0.0;  ///< integral over time [m s]
    double time = 0.0;      ///< of the watched bounce [s]
    double peak = 0.0;      ///< after it [m]
    double deepest = 0.0;   ///< largest penetration of a midpoint over h times its bound
    double last_speed = 0.0;
};

template <int Dim>
Errors watch(Trial<Dim>& trial, const Bouncing& exact, double h, Series* path = nullptr) {
    Errors mean;
    for (int k = 0; k < start_count; ++k) {
        const double late = h * start_shift(k);
        auto world = falling_ball<Dim>(trial, h, exact.e, fall, late);
        int bounces = -1;
        double begin_height = ball_height(world), begin_speed = ball_speed_up(world);
        double position = 0.0;
        world.run(1.2 * exact.t_inf(), [&](const auto& w) {
            const double t = late + w.time(), z = ball_height(w), v = ball_speed_up(w);
            position += h * std::abs(z - exact.height(t));
            mean.deepest = std::max(mean.deepest, -(begin_height + h / 2 * begin_speed) /
                                                      (h * (fall.speed() + g * h / 2)));
            if (begin_speed < 0.0 && v > 0.0 && ++bounces == watched - 1) {
                mean.time += std::abs(t - h / 2 - exact.bounce(watched - 1)) / start_count;
                mean.peak += std::abs(z + v * v / (2 * g) - exact.peak(watched)) / start_count;
            }
            begin_height = z, begin_speed = v;
            if (path && k == 0) path->x.push_back(t), path->y.push_back(z);
        });
        if (bounces < watched - 1) mean.time = mean.peak = std::nan("");
        mean.position += position / start_count;
        mean.last_speed = std::max(mean.last_speed, std::abs(begin_speed));
    }
    return mean;
}

template <int Dim>
void bounce(Trial<Dim>& trial, double e) {
    const Bouncing exact{e};
    const std::string name = ", e = " + std::string(e == 0.5 ? "0.5" : "0.8");
    trial.within("reference, t_∞" + name, exact.t_inf(), e == 0.5 ? 1.354570923 : 4.063712769,
                 5e-10, "digits of the catalogue");
    trial.within("reference, bounces accumulate" + name, exact.bounce(300), exact.t_inf(), 1e-13,
                 "300 terms of the geometric series");
    std::map<double, Errors> errors;
    const auto steps = halvings(8e-3, trial.full() ? 9 : 6);
    for (const double h : steps) {
        Series path{"h = " + std::to_string(h), {}, {}};
        const Errors& seen = errors[h] = watch<Dim>(trial, exact, h, &path);
        trial.within("deepest midpoint / (h v)" + name, seen.deepest, 0.5, 0.5,
                     "between 0 and 1, v = v_0 + g h / 2 bounds the speed before the impact", h);
        // Once it rests, a step multiplies the speed, of order g h, by e: wants 0.2 t_inf / h
        // steps.
        if (g * h * std::pow(e, 0.2 * exact.t_inf() / h) < 1e-13)
            trial.within("speed at 1.2 t_∞" + name, seen.last_speed, 0.0, 1e-12,
                         "tolerance of the catalogue", h);
        else
            trial.note("h = " + std::to_string(h) + name + ": too few steps to come to rest in; " +
                       "speed at 1.2 t_∞ is " + std::to_string(seen.last_speed * 1e12) +
                       "e-12 m/s");
        if (h != steps.front()) continue;
        Series truth{"exact", {}, {}, true};
        for (int k = 0; k <= 239; ++k) {
            truth.x.push_back(1.2 * exact.t_inf() * k / 239.0);
            truth.y.push_back(exact.height(truth.x.back()));
        }
        trial.curves({"height of the lowest point" + name, "t [s]", "z [m]", {path, truth}});
    }
    trial.order(
        "position, L1" + name, steps, [&](double h) { return errors.at(h).position; },
        first_order_irregular);
    trial.order(
        "time of the third bounce" + name, steps, [&](double h) { return errors.at(h).time; },
        first_order_irregular);
    trial.order(
        "third peak" + name, steps, [&](double h) { return errors.at(h).peak; },
        first_order_irregular);
}

template <int Dim>
void run(Trial<Dim>& trial) {
    bounce<Dim>(trial, 0.5);
    bounce<Dim>(trial, 0.8);
}

const Register b03(
    {.id = "B03",
     .name = "bouncing-ball-zeno",
     .title = "Infinitely many bounces in finite time",
     .gate = 2,
     .setup =
         "A ball is let go one metre above the floor; restitution is 0.5 or 0.8. It is watched "
         "until 1.2 times the time at which its bounces accumulate.",
     .reference = {"t_n = t_0 (1 + 2 (e + … + e^n)), t_0 = √{2 H / g}",
                   "t_∞ = t_0 frac{1 + e}{1 − e}", "peak n: e^{2n} H"},
     .compared = "Order in h of the position (integral over time), of the time of the third bounce "
                 "and of the peak after it, each a mean over 16 starts shifted by fractions of a "
                 "step; the last speed; how deep midpoints get.",
     .kind = Class::D1,
     .why = "Every bounce is placed in its step by chance: order 1 on average, and noisy, because "
            "the bounces shorter than a step are not resolved. After the last of them the speed of "
            "order g h is multiplied by e in each step, so 1e-12 is asked where there are steps "
            "enough for it.",
     .source = "Classical; Acary and Brogliato 2008.",
     .catches = {Fault::loose_contact, Fault::restitution_weight}},
    run<2>, run<3>, __FILE__);

}  // namespace B03
}  // namespace validation
