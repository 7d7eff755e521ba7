// SPDX-License-Identifier: BSL-1.0
#include "harness/gsl.hpp"
#include "rocking_block.hpp"

namespace validation {
namespace B19 {

const RockingBlock block{0.1, 0.4};

/// Reference: the block is a pendulum upside down about its corner, p^2 = 3 g / (4 R).
double p() { return std::sqrt(0.75 * g / block.radius()); }

/// Time from rest at tilt th_0 to the upright position.
double quarter(double th_0) {
    const double al = block.slenderness();
    // th = th_0 - s^2 takes the singularity at th_0 away; the product for the difference of cosines
    // keeps its digits there.
    return gsl::integral(
        [&](double s) {
            if (s == 0.0) return 2 / (p() * std::sqrt(2 * std::sin(al - th_0)));
            const double fall = 2 * std::sin(al - th_0 + 0.5 * s * s) * std::sin(0.5 * s * s);
            return 2 * s / (p() * std::sqrt(2 * fall));
        },
        0.0, std::sqrt(th_0));
}

/// The next peak after an impact.
double next_peak(double th_0) {
    const double al = block.slenderness(), r = block.housner();
    return gsl::root(
        [&](double th) {
            return std::cos(al - th) - std::cos(al) - r * r * (std::cos(al - th_0) - std::cos(al));
        },
        0.0, th_0);
}

/// The landing is located by the motion before it, which is smooth.
constexpr Band at_least_first{0.9, 1.9};

struct Swing {
    double crossing = 0.0;     ///< [s]
    double peak = 0.0;         ///< on the other side [rad]
    double penetration = 0.0;  ///< deepest corner until the peak [m]
    Series tilt{"computed", {}, {}};
};

/// Tilt of the block; positive when it stands on its right corner.
template <int Dim>
double tilt_of(const World<Dim>& world) {
    const V<Dim> axis = world.bodies().rotation[1] * V<Dim>(V<Dim>::Unit(Dim - 1));
    return std::atan2(axis[0], axis[Dim - 1]);
}

template <int Dim>
Swing swing(Trial<Dim>& trial, double h) {
    const double start = 0.5 * block.slenderness();
    auto world = trial.world({.h = h, .contact = law<Dim>(0.8)});
    world.add_floor();
    // The right corner stands at x = b.
    const double lean = block.slenderness() - start;
    block.add<Dim>(
        world,
        in_plane<Dim>(block.b - block.radius() * std::sin(lean), block.radius() * std::cos(lean)),
        -start);
    Swing result;
    result.tilt.x.push_back(0.0);
    result.tilt.y.push_back(start);
    double before = start, rate_before = 0.0;
    world.run(0.31 + 0.33, [&](const auto& w) {
        const double th = tilt_of<Dim>(w), rate = -tilting_spin<Dim>(w.bodies().twist(1));
        result.tilt.x.push_back(w.time());
        result.tilt.y.push_back(th);
        const auto& data = w.data();
        // The left corner closes: the impact. Up to here th is smooth.
        if (result.crossing == 0.0)
            for (std::size_t c = 0; c < data.contact_count(); ++c)
                if (data.contacts.point[c][0] < 0.0)
                    result.crossing = data.t_begin - before / rate_before;
        if (result.crossing > 0.0) result.peak = std::max(result.peak, -th);
        for (const double corner : {-block.b, block.b}) {
            const V<Dim> x = w.bodies().pose(1).point_world(in_plane<Dim>(corner, -block.height));
            result.penetration = std::max(result.penetration, -x[Dim - 1]);
        }
        before = th;
        rate_before = rate;
    });
    return result;
}

template <int Dim>
void run(Trial<Dim>& trial) {
    const double al = block.slenderness(), start = 0.5 * al;
    const double t_1 = quarter(start), th_1 = next_peak(start);
    trial.within("reference, quarter period", t_1, 0.312308575, 6e-10, "digits of the catalogue");
    trial.within("reference, quarter period of a slender block",
                 std::acosh(1 / (1 - start / al)) / p(), 0.311758990, 6e-10,
                 "digits of the catalogue");
    trial.within("reference, next peak", th_1, 0.094736793, 6e-10, "digits of the catalogue");
    trial.within("reference, its quarter period", quarter(th_1), 0.254141827, 6e-10,
                 "digits of the catalogue");

    // They divide no event time.
    std::vector<double> steps{2.3e-3, 1.13e-3, 5.7e-4, 2.9e-4, 1.43e-4};
    if (trial.full()) steps.insert(steps.end(), {7.1e-5, 3.7e-5});
    std::vector<double> crossing;
    for (const double h : steps) {
        const Swing s = swing<Dim>(trial, h);
        crossing.push_back(std::abs(s.crossing - t_1));
        trial.within("next peak [rad]", s.peak, th_1, 1.5 * h,
                     "catalogue: 1.5 h, the impact falls irregularly on the steps", h, Class::D1);
        trial.within("deepest corner [m]", s.penetration, 0.0, 0.2 * h, "catalogue: 0.2 h", h,
                     Class::D1);
        if (h == steps.front()) {
            Series exact{"exact", {}, {}, true};
            const double end = t_1 + quarter(th_1);
            std::vector<double> times;
            for (int k = 0; k <= 100; ++k) times.push_back(t_1 * k / 100);
            // From the impact back and on by time; both arcs begin or end at rest.
            const auto arc = [&](double th_0, const std::vector<double>& t) {
                return gsl::ode(
                    [&](double, std::span<const double> y, std::span<double> dy) {
                        dy[0] = y[1];
                        dy[1] = -p() * p() * std::sin(al - y[0]);
                    },
                    {th_0, 0.0}, t);
            };
            const auto down = arc(start, times);
            for (std::size_t k = 0; k < times.size(); ++k) {
                exact.x.push_back(times[k]);
                exact.y.push_back(down[k][0]);
            }
            for (double& t : times) t *= quarter(th_1) / t_1;
            const auto up_again = arc(th_1, times);
            for (std::size_t k = times.size(); k-- > 0;) {
                exact.x.push_back(end - times[k]);
                exact.y.push_back(-up_again[k][0]);
            }
            trial.curves({"tilt, h = 0.0023 s", "t [s]", "θ [rad]", {s.tilt, exact}});
        }
    }
    std::size_t next = 0;
    trial.order(
        "time of the first landing [s]", steps, [&](double) { return crossing[next++]; },
        at_least_first, 0.02);
}

const Register b19(
    {.id = "B19",
     .name = "rocking-block-free",
     .title = "A rocking block, let go",
     .gate = 2,
     .setup = "A block of 0.2 × 0.8 m stands on its right lower corner (edge), tilted by half of "
              "the angle at which it would balance, and is let go; friction 0.8, soft. It rocks "
              "to the upright position, lands and rocks on to the other side.",
     .reference =
         {"p^2 = frac{3 g}{4 R}",
          "quarter period ∫_0^{θ_0} frac{dθ}{p √{2 (cos(α − θ_0) − cos(α − θ))}} = "
          "0.312308575 s",
          "cos(α − θ_1) − cos α = r^2 (cos(α − θ_0) − cos α),  r = 1 − frac{3}{2} sin^2 α: "
          "θ_1 = 0.094736793"},
     .compared = "The time of the first landing (order one at least), the next peak within 1.5 h, "
                 "the deepest corner within 0.2 h.",
     .kind = Class::D1,
     .why = "The corner turns with the block: a curved constraint, hence order one. The impact is "
            "located to a step, so that the peak after it is irregular.",
     .source = "Housner 1963; the integral by GSL.",
     .catches = {Fault::short_arm, Fault::begin_point},
     .midpoint_because = "Where the block lands its bound on the next peak is of the midpoint "
                         "scheme's step, 1.5 h; the other one was 3.3 h off."},
    run<2>, run<3>, __FILE__);

}  // namespace B19
}  // namespace validation
