// SPDX-License-Identifier: BSL-1.0
#include "bouncing/bouncing.hpp"

namespace validation {
namespace B09 {

constexpr Impact in{.mass = 1.3, .radius = 0.2, .along = 3.0, .upward = -2.0, .spin = 0.0};
constexpr double e_n = 0.8;

template <int Dim>
void run(Trial<Dim>& trial) {
    constexpr bool disc = Dim == 2;
    trial.rounding("reference, v_x at μ = 0.1", rebound_of<Dim>(in, 0.1, e_n, 0.0).along, 2.64,
                   3.0);
    trial.rounding("reference, ω at μ = 0.1", rebound_of<Dim>(in, 0.1, e_n, 0.0).spin,
                   disc ? -3.6 : -4.5, 15.0);
    trial.rounding("reference, v_x at μ = 0.9", rebound_of<Dim>(in, 0.9, e_n, 0.0).along,
                   disc ? 2.0 : 15.0 / 7.0, 3.0);
    // At 0.35 and e_t = 0.5 the contact slips all the same, but its slip is turned round: friction
    // opposes the mean.
    for (const auto& [mu, mu_name] : {std::pair{0.1, "0.1"}, {0.35, "0.35"}, {0.9, "0.9"}})
        for (const double e_t : {0.0, 0.5}) {
            const Rebound exact = rebound_of<Dim>(in, mu, e_n, e_t);
            const std::string name =
                "μ = " + std::string(mu_name) + (e_t == 0.0 ? ", e_t = 0" : ", e_t = 0.5");
            for (int k = 0; k < (disc ? 1 : 10); ++k) {
                const std::string at = disc ? name : name + ", azimuth " + std::to_string(36 * k);
                const auto seen = measured_rebound<Dim>(trial, in, mu, e_n, e_t, 36 * k * degree);
                compare<Dim>(trial, at, in, seen, exact);
                const double slip = seen.along + in.radius * seen.spin;
                if (mu == 0.35 && e_t == 0.5)
                    trial.holds("slip turned round, short of sticking, " + at,
                                -e_t * in.along + 0.01 < slip && slip < -0.1);
            }
        }
    Curves curves{"velocity along the floor after the impact", "μ", "v_x [m/s]", {}};
    for (const double e_t : {0.0, 0.5}) {
        const std::string name = e_t == 0.0 ? "e_t = 0" : "e_t = 0.5";
        Series seen{name, {}, {}}, exact{name + ", exact", {}, {}, true};
        for (int k = 0; k <= 40; ++k) {
            const double mu = 0.025 * k;
            seen.x.push_back(mu), exact.x.push_back(mu);
            seen.y.push_back(measured_rebound<Dim>(trial, in, mu, e_n, e_t).along);
            exact.y.push_back(rebound_of<Dim>(in, mu, e_n, e_t).along);
        }
        curves.series.push_back(seen), curves.series.push_back(exact);
    }
    trial.curves(curves);
}

const Register b09(
    {.id = "B09",
     .name = "oblique-impact-sphere",
     .title = "A ball hits a rough floor obliquely",
     .gate = 1,
     .setup = "A homogeneous disc (a sphere in space) of 1.3 kg and 0.2 m radius hits the floor "
              "without spin, at 3 m/s along it and 2 m/s towards it. Restitution is 0.8 normally "
              "and 0 or 0.5 tangentially, friction 0.1 (it slips) or 0.9 (it sticks), and 0.35, "
              "where for tangential restitution 0.5 it slips and leaves with its slip turned "
              "round; in space at ten azimuths.",
     .reference =
         {"P_N = m (1 + e_N) |v_n|",
          "P_s = − m frac{κ}{1 + κ} (1 + e_T) U_T, κ = 1/2 for the disc, 2/5 for the sphere",
          "P_T = P_s if |P_s| ≤ μ P_N, otherwise − μ P_N sgn U_T",
          "v_x + frac{P_T}{m}, e_N |v_n|, ω + frac{P_T r}{κ m r^2}"},
     .compared =
         "Both velocities, spin, energy and, in space, what leaves the plane of the motion; "
         "the result must be the same at every azimuth. Spins are positive from the first "
         "axis upwards, so that friction against the motion makes them negative.",
     .kind = Class::R,
     .why = "One step, one contact, no forces: nothing but rounding.",
     .source = "Walton 1993; the rigid limit of Maw, Barber and Fawcett 1976.",
     .catches = {Fault::friction_off, Fault::friction_on_end_velocity, Fault::faceted_cone,
                 Fault::short_arm}},
    run<2>, run<3>, __FILE__);

}  // namespace B09
}  // namespace validation
