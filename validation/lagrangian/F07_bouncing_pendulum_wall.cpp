// SPDX-License-Identifier: BSL-1.0
#include <array>

#include "harness/machine.hpp"

namespace validation {
namespace F07 {

constexpr double e = 0.7, start_angle = 60 * degree;
constexpr int hits = 4;

/// A point of 1 kg on a rod of 1 m; the wall is the vertical plane through its hinge.
struct Pendulum {
    static constexpr int dof = 1;
    void mass(double, const auto&, auto& a) const { a << 1.0; }
    void force(double, const auto& q, const auto&, auto& f) const { f << -g * std::sin(q[0]); }
    void gaps(const auto&, const auto& q, auto& contacts) const {
        contacts.add(sin(q[0]), law<2>(0.0, e), "wall");
    }
};

double amplitude(int n) { return 2 * std::asin(std::pow(e, n) * std::sin(start_angle / 2)); }
double hit_time(int n) {
    const double unit = std::sqrt(1.0 / g);
    double t = unit * gsl::ellint_K(std::sin(start_angle / 2));
    for (int k = 1; k < n; ++k)
        t += 2 * unit * gsl::ellint_K(std::pow(e, k) * std::sin(start_angle / 2));
    return t;
}

/// Times of the hits, and amplitudes after them by the energy then.
struct Seen {
    std::array<double, hits> time{}, amplitude{};
    Series path;
};
Seen watch(Trial<2>& trial, double h, double delay) {
    const std::array moments{0.0, delay};
    const auto start = gsl::ode(
        [](double, auto y, auto dy) {
            dy[0] = y[1];
            dy[1] = -g * std::sin(y[0]);
        },
        {start_angle, 0.0}, moments)[1];
    Machine<Pendulum> pendulum(trial, {}, One(start[0]), One(start[1]), {.h = h}, delay);
    Seen seen{{}, {}, {"h = " + std::to_string(h), {}, {}}};
    int n = 0;
    pendulum.run(1.1 * hit_time(hits), [&](const auto& data) {
        seen.path.x.push_back(data.t_end());
        seen.path.y.push_back(data.q_end[0] / degree);
        if (!(data.begin[0] < 0.0 && data.end[0] > 0.0)) return true;
        const auto i = static_cast<std::size_t>(n);
        seen.time[i] = data.t_mid;
        seen.amplitude[i] = 2 * std::asin(std::sqrt(data.end[0] * data.end[0] / (4 * g) +
                                                    (1 - std::cos(data.q_end[0])) / 2));
        return ++n < hits;
    });
    if (n < hits) seen.time.back() = std::nan("");
    return seen;
}

void run(Trial<2>& trial) {
    trial.within("reference, first hit [s]", hit_time(1), 0.538218667, 5e-10, "digits");
    trial.within("reference, flights tend to", hit_time(400) - hit_time(399), pi / std::sqrt(g),
                 1e-12, "no accumulation");
    const auto steps = halvings(8e-3, 6);
    std::vector<double> time_error, amplitude_error;
    for (const double h : steps) {
        double late = 0.0, wide = 0.0;
        for (int k = 0; k < 8; ++k) {
            const Seen seen = watch(trial, h, h * (k + 0.37) / 8);
            for (int n = 1; n <= hits; ++n) {
                const auto i = static_cast<std::size_t>(n - 1);
                late += std::abs(seen.time[i] - hit_time(n)) / (8 * hits);
                wide = std::max(wide, std::abs(seen.amplitude[i] - amplitude(n)));
            }
            if (h == steps[2] && k == 0) {
                Series exact{"exact amplitudes", {0.0}, {60.0}, true};
                for (int n = 1; n < hits; ++n)
                    exact.x.push_back((hit_time(n) + hit_time(n + 1)) / 2),
                        exact.y.push_back(amplitude(n) / degree);
                trial.curves({"angle", "t [s]", "[degrees]", {seen.path, exact}});
            }
        }
        time_error.push_back(late);
        amplitude_error.push_back(wide);
        trial.within("amplitudes after four hits [rad]", wide, 0.0, 25 * h * h,
                     "25 h^2: potential of what it goes in, and of leapfrog", h);
    }
    const auto at = [&](const std::vector<double>& errors, double h) {
        return errors[static_cast<std::size_t>(std::find(steps.begin(), steps.end(), h) -
                                               steps.begin())];
    };
    trial.order(
        "times of four hits", steps, [&](double h) { return at(time_error, h); },
        first_order_irregular, 3.0);
}

const Register f07(
    {.id = "F07",
     .name = "bouncing-pendulum-wall",
     .title = "A pendulum bounces off a wall",
     .gate = 1,
     .setup = "A pendulum of 1 m, let go at 60 degrees, meets a wall where it hangs, with "
              "restitution 0.7; a Lagrangian system of one angle, its gap differentiated by talus.",
     .reference = {"amplitude after n hits: 2 asin(e^n sin 30°)", "t_1 = √{frac{L}{g}} K(sin 30°)",
                   "t_{n+1} − t_n = 2 √{frac{L}{g}} K(e^n sin 30°)"},
     .compared = "Times of four hits, a mean over eight starts shifted by fractions of a step; the "
                 "worst amplitude after them.",
     .kind = Class::D1,
     .why = "A hit is seen up to a step late, and the pendulum then has as far to go back, more "
            "slowly: (1 + 1/e) h/2 with each, 2.3 h in the mean of four. It keeps its energy then "
            "but for what "
            "gravity does within a step near the lowest point, which is h^2.",
     .source = "Elliptic integrals; a control for detectors of accumulating impacts (B03).",
     .catches = {Fault::restitution_weight, Fault::reaction_lost, Fault::loose_contact,
                 Fault::end_point_drift}},
    run, nullptr, __FILE__);

}  // namespace F07
}  // namespace validation
