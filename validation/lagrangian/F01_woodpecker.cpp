// SPDX-License-Identifier: BSL-1.0
#include <Eigen/Core>

#include "harness/machine.hpp"

namespace validation {
namespace F01 {

constexpr double m_s = 0.0045, j_s = 7e-7, m_m = 0.0003, j_m = 5e-9, stiffness = 0.0056;
constexpr double l_m = 0.010, l_g = 0.015, l_s = 0.0201, h_s = 0.020, h_m = 0.0058;
constexpr double r_m = 0.0031, r_o = 0.0025, mu = 0.3;
enum Contact : std::size_t { beak, lower, upper };

/// Height of the sleeve, its angle and that of the bird.
struct Woodpecker {
    static constexpr int dof = 3;

    void mass(double, const auto&, auto& a) const {
        a << m_s + m_m, m_s * l_m, m_s * l_g,                   //
            m_s * l_m, j_m + m_s * l_m * l_m, m_s * l_m * l_g,  //
            m_s * l_g, m_s * l_m * l_g, j_s + m_s * l_g * l_g;
    }
    void force(double, const auto& q, const auto&, auto& f) const {
        const double twist = stiffness * (q[1] - q[2]);
        f << -(m_s + m_m) * g, -twist - m_s * g * l_m, twist - m_s * g * l_g;
    }
    void gaps(const auto&, const auto& q, auto& contacts) const {
        contacts.add(l_m + l_g - l_s - r_o - h_s * q[2], law<2>(mu, 0.5), "beak").slide[0] =
            q[0] + l_m * q[1] + (l_g - l_s) * q[2];
        contacts.add(r_m - r_o + h_m * q[1], law<2>(mu), "sleeve, lower").slide[0] =
            q[0] + r_m * q[1];
        contacts.add(r_m - r_o - h_m * q[1], law<2>(mu), "sleeve, upper").slide[0] =
            q[0] + r_m * q[1];
    }
};

/// Ten pecks after the cycle has been reached, and the way there.
struct Pecks {
    double first = std::nan(""), period = std::nan(""), descent = std::nan("");
    Eigen::Vector3d least, most;  ///< of the angles and the spin of the bird, over the ten
    bool each_touches_thrice = true;
    Series height{"sleeve", {}, {}}, bird{"bird", {}, {}};
};
Pecks watch(Trial<2>& trial, double h, double settle) {
    Machine<Woodpecker> machine(trial, {}, Eigen::Vector3d(0.0, -0.1036, -0.2788),
                                Eigen::Vector3d(-0.3411, 0.0, -7.4583), {.h = h, .size = 0.01});
    Pecks seen;
    seen.least.setConstant(1e9);
    seen.most.setConstant(-1e9);
    double last = -1.0, begin = 0.0, begin_height = 0.0;
    int pecks = -1;
    bool above = false, below = false;
    machine.run(settle + 2.5, [&](const auto& data) {
        const bool pecked = data.impulse_at(beak)[0] > 0.0;
        above = above || data.impulse_at(upper)[0] > 0.0;
        below = below || data.impulse_at(lower)[0] > 0.0;
        if (pecks >= 0) {
            const Eigen::Vector3d now(data.q_end[1], data.q_end[2], data.end[2]);
            seen.least = seen.least.cwiseMin(now);
            seen.most = seen.most.cwiseMax(now);
        }
        if (data.t_end() < 0.6) {
            seen.height.x.push_back(data.t_end()), seen.height.y.push_back(1e3 * data.q_end[0]);
            seen.bird.x.push_back(data.t_end()), seen.bird.y.push_back(data.q_end[2]);
        }
        if (!pecked || data.t_mid < last + 0.05) return true;
        if (std::isnan(seen.first)) seen.first = data.t_mid;
        last = data.t_mid;
        if (last < settle) return true;
        if (++pecks == 0) begin = last, begin_height = data.q_mid[0];
        if (pecks > 0) seen.each_touches_thrice = seen.each_touches_thrice && above && below;
        above = below = false;
        if (pecks < 10) return true;
        seen.period = (last - begin) / 10;
        seen.descent = (begin_height - data.q_mid[0]) / 10;
        return false;
    });
    return seen;
}

void run(Trial<2>& trial) {
    constexpr double period = 0.14598, descent = 0.01945;
    const std::vector<double> steps =
        trial.full() ? std::vector{1e-4, 2e-5, 2e-6} : std::vector{1e-4, 2e-5};
    for (const double h : steps) {
        const Pecks seen = watch(trial, h, 3.0);
        trial.within("first peck [s]", seen.first, 0.08101, 1e-5 + 2 * h, "digits and 2 h", h,
                     Class::D1);
        trial.within("period, mean of ten pecks [s]", seen.period, period, 1e-5 + 5 * h,
                     "digits, and five events in a period, each placed to a step", h);
        trial.within("descent in a period [m]", seen.descent, descent, 2e-5 + 3 * h,
                     "catalogue's last digit, and 3 m/s h", h);
        trial.holds("beak, upper and lower corner touch in each period", seen.each_touches_thrice,
                    {}, h);
        trial.within("angles of the sleeve, largest [rad]", seen.most[0], 0.10348, 1e-4 + 40 * h,
                     "digits, and what corners go in at 40 rad/s", h);
        trial.within("angle of the bird, largest [rad]", seen.most[1], 0.12003, 1e-3 + 50 * h,
                     "what the beak goes in at 10 rad/s, and more", h);
        trial.within("angle of the bird, least [rad]", seen.least[1], -0.52988, 1e-3 + 50 * h,
                     "order h", h);
        trial.within("spin of the bird, largest [rad/s]", seen.most[2], 17.623, 0.05 + 2000 * h,
                     "order h", h);
        trial.within("spin of the bird, least [rad/s]", seen.least[2], -10.507, 0.05 + 2000 * h,
                     "order h", h);
        if (h == 2e-5) {
            trial.curves({"height of the sleeve", "t [s]", "[mm]", {seen.height}});
            trial.curves({"angle of the bird", "t [s]", "[rad]", {seen.bird}});
        }
    }
}

const Register f01(
    {.id = "F01",
     .name = "woodpecker",
     .title = "The woodpecker toy pecks its way down",
     .gate = 2,
     .setup = "Glocker and Pfeiffer's model: a sleeve with play on a pole carries a bird by a "
              "spring; three coordinates, three contacts with friction 0.3, the beak's with "
              "restitution 0.5.",
     .reference = {"period 0.14598 ± 0.00001 s, 0.01945 m down in each",
                   "bird between −0.52988 and 0.12003 rad; −10.507 and 17.623 rad/s"},
     .compared =
         "The first peck; period and descent over ten pecks after 3 s; ranges of the angles "
         "and of the spin; that beak and both corners touch in each period.",
     .kind = Class::D1,
     .why = "Impacts and reversals of friction are placed to a step: order 1. The cycle is "
            "approached with alternation, hence ten periods.",
     .source = "Glocker 1995; Pfeiffer and Glocker 1996; Leine, Glocker and van Campen 2001; the "
               "numbers by two codes of the catalogue.",
     .catches = {Fault::friction_off, Fault::loose_contact, Fault::reaction_lost,
                 Fault::short_arm}},
    run, nullptr, __FILE__);

}  // namespace F01
}  // namespace validation
