// SPDX-License-Identifier: BSL-1.0
#include "harness/case.hpp"
#include "harness/observed.hpp"

namespace validation {
namespace E06 {

constexpr double w = 3.0;

/// What one step does, as the rotation that it is below the limit: cos phi = 1 - (w h)^2 / 2.
struct Leapfrog {
    double h;
    double cosine = 1 - w * w * h * h / 2;
    /// Of the n-th step from x = 1, v = 0.
    double from_place(int n) const {
        if (std::abs(cosine) <= 1) return std::cos(n * 2 * std::asin(w * h / 2));
        return (n % 2 == 0 ? 1 : -1) * std::cosh(n * std::acosh(-cosine));
    }
    /// Of the n-th step from x = 0, v = w.
    double from_velocity(int n) const {
        const double phi = 2 * std::asin(w * h / 2);
        return w * h * (1 - w * w * h * h / 4) / std::sin(phi) * std::sin(n * phi);
    }
};

/// A point mass on a spring, started one metre off and, below the limit, with a velocity across.
template <int Dim>
World<Dim> oscillator(Trial<Dim>& trial, double h, bool across) {
    auto world = trial.world({.h = h, .gravity = V<Dim>::Zero()});
    const auto body =
        world.add(talus::Ball<Dim>(0.1), point_mass<Dim>(2.0), {in_plane<Dim>(1.0, 0.0), {}},
                  {in_plane<Dim>(0.0, across ? w : 0.0)});
    push(world, body, [](double, const V<Dim>& x) { return V<Dim>(-2.0 * w * w * x); });
    return world;
}

template <int Dim>
void run(Trial<Dim>& trial) {
    trial.within("reference, angle per step", 2 * std::asin(w * 0.1 / 2),
                 std::acos(Leapfrog{0.1}.cosine), 1e-14, "two ways to write it");
    for (const double h : {0.1, 0.66}) {
        const Leapfrog exact{h};
        auto world = oscillator(trial, h, true);
        Worst along, across;
        Series seen{"measured", {}, {}}, curve{"exact of the method", {}, {}, true};
        Series true_one{"cos ω t", {}, {}, true};
        for (int n = 1; n <= 1000; ++n) {
            world.step();
            const V<Dim>& x = world.bodies().position[0];
            along.see(x[0], exact.from_place(n));
            across.see(x[Dim - 1], exact.from_velocity(n));
            if (n * h > 12.0) continue;
            seen.x.push_back(n * h), seen.y.push_back(x[0]);
            curve.x.push_back(n * h), curve.y.push_back(exact.from_place(n));
            true_one.x.push_back(n * h), true_one.y.push_back(std::cos(w * n * h));
        }
        // 1000 steps; near the limit the map shears by 1/sin(phi), up to 8 times.
        const double scale = h > 0.6 ? 100.0 : 1.0;
        trial.rounding("place along the first axis", along, scale, h);
        trial.rounding("place across it", across, scale, h);
        if (h == 0.1)
            trial.curves({"place along the first axis", "t [s]", "x [m]", {seen, curve, true_one}});
    }
    auto unstable = oscillator(trial, 0.67, false);
    Worst growth;
    for (int n = 1; n <= 100; ++n) {
        unstable.step();
        growth.see(unstable.bodies().position[0][0] / Leapfrog{0.67}.from_place(n), 1.0);
    }
    trial.rounding("growth beyond the limit, relative", growth, 100.0, 0.67);
    trial.holds("unstable at 0.67", std::abs(unstable.bodies().position[0][0]) > 1e6, {}, 0.67);
}

const Register e06(
    {.id = "E06",
     .name = "leapfrog-frequency",
     .title = "Frequency of an oscillator in steps",
     .gate = 1,
     .setup = "A point mass on an isotropic spring, ω = 3 rad/s, is let go 1 m from its place of "
              "rest with 3 m/s across: an ellipse. 1000 steps of 0.1 s and of 0.66 s, and 100 of "
              "0.67 s, beyond the limit of stability, without the velocity across.",
     .reference = {"x_n = cos n φ, φ = 2 asin frac{ω h}{2}",
                   "y_n = ω h (1 − frac{ω^2 h^2}{4}) frac{sin n φ}{sin φ}",
                   "unstable for ω h > 2: |x_n| = cosh(n arcosh(frac{ω^2 h^2}{2} − 1))"},
     .compared = "Both coordinates at every step; the growth beyond the limit.",
     .kind = Class::R,
     .why = "Without contacts the step is leapfrog, for a spring a linear map whose powers are "
            "known.",
     .source = "Verlet 1967; the amplitudes are derived here.",
     .catches = {Fault::force_at_begin, Fault::end_point_drift}},
    run<2>, run<3>, __FILE__);

}  // namespace E06
}  // namespace validation
