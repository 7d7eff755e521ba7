// SPDX-License-Identifier: BSL-1.0
#include <Eigen/Core>

#include "jamming.hpp"

namespace validation {
namespace C07 {

constexpr double m = 1.0, h = 1e-2, half_width = 0.2, half_height = 0.2, half_depth = 0.2;
constexpr double pin = 0.1;  // radius of the two obstacles

/// The normal of the wedge's right side (1) or left side (-1), outwards: the wedge is wider above.
template <int Dim>
V<Dim> side_normal(double angle, double side) {
    return in_plane<Dim>(side * std::cos(angle), -std::sin(angle));
}

template <int Dim>
talus::ConvexPolytope<Dim> wedge_shape(double angle) {
    const double narrow = half_width - half_height * std::tan(angle);
    const double broad = half_width + half_height * std::tan(angle);
    std::vector<V<Dim>> corners;
    for (const auto& [x, z] : {std::pair{-narrow, -half_height}, std::pair{narrow, -half_height},
                               std::pair{broad, half_height}, std::pair{-broad, half_height}}) {
        V<Dim> corner = in_plane<Dim>(x, z);
        if constexpr (Dim == 3) {
            corner[1] = -half_depth;
            corners.push_back(corner);
            corner[1] = half_depth;
        }
        corners.push_back(corner);
    }
    return talus::ConvexPolytope<Dim>(corners);
}
template <int Dim>
V<Dim> half() {
    V<Dim> result = V<Dim>::Constant(half_depth);
    result[0] = half_width;
    result[Dim - 1] = half_height;
    return result;
}

/// A wedge that touches a pin on either side at the height of its centre, loaded along its axis.
template <int Dim>
World<Dim> wedge(Trial<Dim>& trial, double angle, double mu, double impulse) {
    auto world = trial.world({.h = h,
                              .contact = law<Dim>(mu),
                              .gravity = impulse / (m * h) * up<Dim>(),
                              .solver = {.max_sweeps = 200000, .tolerance = jam_tolerance}});
    for (const double side : {-1.0, 1.0})
        world.add_obstacle(
            talus::Ball<Dim>(pin),
            talus::Pose<Dim>{
                side * half_width * V<Dim>::Unit(0) + pin * side_normal<Dim>(angle, side), {}});
    world.add(wedge_shape<Dim>(angle), box_inertia<Dim>(m, half<Dim>()), {V<Dim>::Zero(), {}});
    return world;
}

/// Reference: the same in the plane.
PlanarBody planar_wedge(double angle, double mu) {
    PlanarBody body(m, m / 3 * (half_width * half_width + half_height * half_height));
    for (const double side : {-1.0, 1.0})
        body.touch({side * half_width, 0}, -side_normal<2>(angle, side), mu);
    return body;
}
PlanarProblem planar(double angle, double mu, double impulse) {
    return planar_wedge(angle, mu).problem(Eigen::Vector3d::Zero(), {0, impulse / m, 0});
}

std::string listed(const Enumeration& all) {
    std::string text;
    for (const auto& s : all.solutions()) text += (text.empty() ? "" : ", ") + s.status;
    return text;
}

/// The families that the enumeration finds: only open, or jammed as well.
void families(TrialRecord& trial, double angle, double ratio, const std::string& name) {
    const double mu = ratio * std::tan(angle);
    const Enumeration out(planar(angle, mu, pull));
    bool open = false;
    for (const auto& s : out.solutions()) open = open || s.status == "oo";
    trial.holds("reference, open is a solution, " + name, open, listed(out));
    trial.holds(
        "reference, " + std::string(ratio > 1 ? "open and jammed" : "open alone") + ", " + name,
        out.velocities().size() == (ratio > 1 ? 2u : 1u), listed(out));
    for (const auto& s : out.solutions())
        if (s.u.norm() < 1e-9 * pull)
            trial.holds("reference, jammed (" + s.status + ") " + name,
                        s.r[0] >= 0.99 * pull / (2 * (mu * std::cos(angle) - std::sin(angle))),
                        "its impulses have a lower bound");
    const Enumeration in(planar(angle, mu, -pull));
    bool several = false;
    for (const auto& s : in.solutions()) several = several || !s.unique_impulses;
    trial.holds("reference, pushed in it rests with impulses that are not unique, " + name,
                in.velocities().size() == 1 && in.velocities()[0].norm() < 1e-9 * pull && several,
                listed(in));
}

template <int Dim>
void run(Trial<Dim>& trial) {
    for (const auto& [degrees, tan] :
         {std::pair{10, 0.176327}, std::pair{20, 0.363970}, std::pair{30, 0.577350}}) {
        const double angle = degrees * degree;
        const std::string of = std::to_string(degrees) + " degrees";
        trial.within("reference, tan, " + of, std::tan(angle), tan, 6e-7,
                     "digits of the catalogue");
        trial.rounding("reference, friction of the self-stress, " + of,
                       self_stress_friction(planar_wedge(angle, 1.0)), std::tan(angle), 1.0);
        for (const double ratio : {0.98, 0.99, 1.01, 1.02}) {
            const double mu = ratio * std::tan(angle);
            const std::string name = of + ", mu = " + std::to_string(ratio).substr(0, 4) + " tan";
            families(trial, angle, ratio, name);
            const auto make = [&](double impulse) { return wedge<Dim>(trial, angle, mu, impulse); };
            const auto outcome = try_to_jam<Dim>(make);
            judge<Dim>(trial, outcome, ratio > 1, name);
            trial.holds("pushed in it rests, " + name,
                        outcome.push.verdict == talus::Verdict::equilibrium);
            const V<Dim> free = pull / m * up<Dim>();
            trial.solver("cold start, velocity, " + name, outcome.cold.data.end[2].linear, free,
                         pull / m, jam_tolerance);
            if (ratio > 1) continue;
            // It leaves from any start. The start was large: what is left of it is rounding.
            auto rng = trial.rng(static_cast<std::uint64_t>(degrees));
            for (int k = 0; k < (trial.full() ? 100 : 5); ++k) {
                const auto again = make(pull).equilibrium(random_start<Dim>(outcome.cold, mu, rng));
                trial.holds("random start leaves, " + name,
                            again.verdict == talus::Verdict::moving);
                trial.solver("random start, velocity, " + name, again.data.end[2].linear, free,
                             push_ratio * pull / m, jam_tolerance);
            }
        }
    }
    Series cold{"cold start", {}, {}}, warm{"warm start", {}, {}};
    for (int k = -10; k <= 10; ++k) {
        if (k == 0) continue;
        const double ratio = 1 + 0.01 * k;
        const auto outcome = try_to_jam<Dim>([&](double impulse) {
            return wedge<Dim>(trial, 20 * degree, ratio * std::tan(20 * degree), impulse);
        });
        cold.x.push_back(ratio);
        cold.y.push_back(outcome.cold.speed);
        warm.x.push_back(ratio);
        warm.y.push_back(outcome.warm.speed);
    }
    trial.curves({"pulled out, 20 degrees",
                  "μ / tan δ",
                  "speed after the step [m/s]",
                  {cold,
                   warm,
                   {"free, exact", {0.9, 1.1}, {pull / m, pull / m}, true},
                   {"jammed, exact", {1.0, 1.1}, {0.0, 0.0}, true}}});
}

const Register c07(
    {.id = "C07",
     .name = "wedge-self-stress",
     .title = "A wedge that jams, or not",
     .gate = 2,
     .setup = "A wedge of 1 kg and half angle 10, 20 or 30 degrees is held by a fixed round pin on "
              "each side, one contact each, without gravity. It is pulled out by 0.01 N s in one "
              "step, from zero impulses and from those of a push 10 000 times as large. Friction "
              "0.98, 0.99, 1.01 and 1.02 times the tangent of the half angle.",
     .reference = {"self-stress exists if and only if μ ≥ tan δ",
                   "jammed impulses obey P_N ≥ frac{X}{2 (μ cos δ − sin δ)}",
                   "below: u = X / m from any start;  above: also u = 0"},
     .compared =
         "Whether it leaves or stays, from the cold start, the warm one and (below the "
         "threshold) random ones; residuals below 1e-12. In the plane of the problem the "
         "enumeration lists all solutions; the threshold also follows from the impulses at zero "
         "load.",
     .kind = Class::T,
     .why = "Both answers solve the step above the threshold: the start decides. So a cold start "
            "can say \"moves\" although an equilibrium exists.",
     .source = "Moreau 1988; classical self-locking; enumeration.",
     .catches = {Fault::friction_off}},
    run<2>, run<3>, __FILE__);

}  // namespace C07
}  // namespace validation
