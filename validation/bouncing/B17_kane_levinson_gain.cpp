// SPDX-License-Identifier: BSL-1.0
#include <talus/measure/energy_ledger.hpp>

#include "bouncing/rod_impact.hpp"

namespace validation {
namespace B17 {

constexpr double mu = 1.0, angle = 45 * degree;
constexpr double approach = -1.0, slip = 0.6;  // of the end, before [m/s]

/// Sticking impact of the rod's end in the plane, by hand: W P = -(1 + e) U in each direction.
struct Stick {
    double p_n, p_t;  ///< [N s]
    double u_n, u_t;  ///< after [m/s]
    double friction;  ///< work of p_t on the slip [J]
    double bounce;    ///< work of p_n on approach and separation [J]
    double gain() const { return friction + bounce; }

    static constexpr double w_nn = 2.5, w_tt = 2.5, w_nt = -1.5;

    Stick(double e_n, double e_t) {
        const double b_n = -(1 + e_n) * approach, b_t = -(1 + e_t) * slip;
        const double det = w_nn * w_tt - w_nt * w_nt;
        p_n = (w_tt * b_n - w_nt * b_t) / det;
        p_t = (w_nn * b_t - w_nt * b_n) / det;
        u_n = -e_n * approach;
        u_t = -e_t * slip;
        friction = p_t * (slip + u_t) / 2;
        bounce = p_n * (approach + u_n) / 2;
    }
};

template <int Dim>
struct Seen {
    V<Dim> impulse, velocity;  ///< on the end, of the end after; in the plane of the motion
    double gain;               ///< by the velocities of the body [J]
    talus::EnergyFlows flows;  ///< by talus' ledger [J]
    double closure;            ///< of the ledger [-]
};

template <int Dim>
Seen<Dim> strike(Trial<Dim>& trial, double e_n, double e_t, double azimuth = 0.0) {
    talus::Rotation<Dim> turn;
    if constexpr (Dim == 3) turn = talus::Rotation<3>::exp({0, 0, azimuth});
    const RodImpact<Dim> impact{rod_inertia<Dim>(1.0, 1.0), 1.0, turn * tilt<Dim>(angle),
                                turn * in_plane<Dim>(slip, approach)};
    auto world = impact.world(trial, law<Dim>(mu, e_n, e_t));
    talus::EnergyLedger<Dim> ledger(world.bodies(), V<Dim>::Zero());
    ledger.record(world.step(), world.bodies());
    return {turn.transpose_times(impulse_on(world.data(), 1)),
            turn.transpose_times(world.bodies().twist(1).at(impact.arm())),
            talus::kinetic_energy(world.bodies(), 1) - impact.energy(), ledger.flows(),
            ledger.closure()};
}

template <int Dim>
void run(Trial<Dim>& trial) {
    const auto w =
        RodImpact<Dim>{rod_inertia<Dim>(1.0, 1.0), 1.0, tilt<Dim>(angle), V<Dim>::Zero()}.w();
    trial.rounding("reference, W_NN", w(Dim - 1, Dim - 1), Stick::w_nn, 2.5);
    trial.rounding("reference, W_TT", w(0, 0), Stick::w_tt, 2.5);
    trial.rounding("reference, W_NT", w(0, Dim - 1), Stick::w_nt, 2.5);
    struct Entry {
        double e_n, e_t, gain;
        std::string name;
    };
    const std::vector<Entry> entries{{1.0, 0.0, 0.1125, "e_N = 1, e_T = 0"},
                                     {0.9, 0.0, 0.053125, "e_N = 0.9, e_T = 0"},
                                     {0.5, 0.0, -0.121875, "e_N = 0.5, e_T = 0"},
                                     {1.0, 1.0, 0.0, "e_N = e_T = 1"},
                                     {0.9, 0.9, -0.038, "e_N = e_T = 0.9"}};
    for (const Entry& entry : entries) {
        const Stick exact(entry.e_n, entry.e_t);
        trial.rounding("reference, gain, " + entry.name, exact.gain(), entry.gain, 1.0);
        trial.holds("reference, sticks, " + entry.name, std::abs(exact.p_t) <= mu * exact.p_n);
        for (const int azimuth : Dim == 2 ? std::vector{0} : std::vector{0, 37, 200}) {
            const auto seen = strike<Dim>(trial, entry.e_n, entry.e_t, azimuth * degree);
            const std::string at =
                Dim == 2 ? entry.name : entry.name + ", azimuth " + std::to_string(azimuth);
            // Impulses of some N s, velocities of about 1 m/s.
            trial.rounding("impulse, " + at, seen.impulse, in_plane<Dim>(exact.p_t, exact.p_n),
                           4.0);
            trial.rounding("velocity after, " + at, seen.velocity,
                           in_plane<Dim>(exact.u_t, exact.u_n), 4.0);
            trial.rounding("gain of energy, " + at, seen.gain, exact.gain(), 4.0);
            trial.rounding("ledger, friction, " + at, seen.flows.friction, exact.friction, 4.0);
            trial.rounding("ledger, restitution, " + at, seen.flows.restitution, exact.bounce, 4.0);
            trial.within("ledger, closure, " + at, seen.closure, 0.0, 1e-13, "rounding");
            // Friction that gives energy is the mark of unequal restitutions.
            trial.holds("ledger shows the gain, " + at,
                        (seen.flows.sum() > 1e-3) == (entry.gain > 0.0) &&
                            (entry.gain <= 0.0 || seen.flows.friction > 0.0));
        }
    }
    Curves curves{"gain of kinetic energy", "e_N", "ΔT [J]", {}};
    for (const bool equal : {false, true}) {
        const std::string name = equal ? "e_T = e_N" : "e_T = 0";
        Series seen{name, {}, {}}, exact{name + ", exact", {}, {}, true};
        for (int k = 0; k <= 20; ++k) {
            const double e_n = 0.05 * k, e_t = equal ? e_n : 0.0;
            seen.x.push_back(e_n), exact.x.push_back(e_n);
            seen.y.push_back(strike<Dim>(trial, e_n, e_t).gain);
            exact.y.push_back(Stick(e_n, e_t).gain());
        }
        curves.series.push_back(seen), curves.series.push_back(exact);
    }
    trial.curves(curves);
}

const Register b17(
    {.id = "B17",
     .name = "kane-levinson-gain",
     .title = "Unequal restitutions can create energy",
     .gate = 1,
     .setup = "The low end of a uniform rod of 1 kg and 1 m, inclined by 45 degrees, strikes the "
              "floor at 1 m/s while it slips at 0.6 m/s; friction is 1 and the end sticks, with "
              "restitutions that differ between the normal and the tangential direction; in space "
              "at three azimuths.",
     .reference = {"W_{NN} = W_{TT} = 5/2, W_{NT} = − 3/2",
                   "W P = − ((1 + e_N) U_N, (1 + e_T) U_T)",
                   "ΔT = P · frac{U_i + U_f}{2}: 0.1125 for e_N = 1 and e_T = 0, of 0.2 of contact "
                   "energy"},
     .compared = "Impulse, velocity of the end, kinetic energy; what talus' energy ledger books as "
                 "restitution and as friction: the gain must be seen there, as friction that gives "
                 "energy.",
     .kind = Class::R,
     .why = "One step, one contact, no forces: nothing but rounding. The gain is a property of the "
            "law, not an error.",
     .source = "Kane and Levinson 1985; Glocker 2006.",
     .catches = {Fault::restitution_weight, Fault::friction_on_end_velocity, Fault::short_arm}},
    run<2>, run<3>, __FILE__);

}  // namespace B17
}  // namespace validation
