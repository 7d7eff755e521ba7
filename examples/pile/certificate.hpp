// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <string>

#include "figures.hpp"
#include "verdict.hpp"

namespace pile {

/// When and where the worst was: " in step 12 (t = 0.006 s) between the floor and grain 3".
inline std::string place_of(const WorstFigure& w) {
    if (w.step == 0) return "";
    char time[60];
    std::snprintf(time, sizeof time, " in step %lld (t = %.6g s)", static_cast<long long>(w.step),
                  w.time);
    return w.one.empty() ? time : time + (" between " + w.one + " and " + w.another);
}

/// The certificate in words and figures.
inline std::string text_of(const Figures& f) {
    std::string t;
    const auto line = [&t](const char* format, auto... values) {
        char buffer[400];
        std::snprintf(buffer, sizeof buffer, format, values...);
        t += buffer;
        t += '\n';
    };
    line("  steps                %zu%s, of which %lld missed the tolerance of %.0e", f.steps.size(),
         f.stopped ? " before it was stopped" : "", static_cast<long long>(f.missed), f.tolerance);
    line("  residual             worst %.2e%s", f.residual.value, place_of(f.residual).c_str());
    line("  law violated by      %.1e m/s at most%s", f.velocity_error.value,
         place_of(f.velocity_error).c_str());
    line("                       %.1e m in all, about the most that overlaps grew for it", f.drift);
    line("  overlap              mean %.3f %% of the mean radius at the end",
         100 * f.mean_penetration() / f.mean_radius);
    line("                       deepest %.2f %% of half the thinner one%s", 100 * f.overlap.value,
         place_of(f.overlap).c_str());
    line("  floor force / weight %.6f over the last tenth (%.6f by the momentum of the grains)",
         f.reaction_over_weight(), f.reaction_over_weight_due());
    line("                       %.6f in the last step", f.last().reaction_over_weight);
    line("  energy               gravity gave %.4e J; friction took %.4e, impacts %.4e",
         f.potential_start - f.last().potential, 0.0 - f.given.friction, 0.0 - f.given.impacts);
    line("                       left in motion %.2e J (rms speed %.1e m/s)", f.last().kinetic,
         f.speed());
    if (f.given.gyroscopic != 0.0 || f.given.correction != 0.0)
        line("                       gyroscopic term %.1e, position correction %.1e",
             f.given.gyroscopic, f.given.correction);
    line("  energy books         close to %.1e", f.energy_closure);
    line(
        "  work                 %zu contacts at the end, %.1f sweeps per step, %.1f s (%.2g "
        "million contact updates/s)",
        f.last().contacts, f.sweeps_per_step(), f.seconds, f.updates_per_second() * 1e-6);
    for (const std::string& sentence : impossible_in(f))
        line("  IMPOSSIBLE           %s", sentence.c_str());
    if (!f.failure.empty()) line("  ended early          %s", f.failure.c_str());
    line("  %s", certified(f) ? "certified" : "NOT CERTIFIED");
    return t;
}

inline nlohmann::json json_of(const WorstFigure& w) {
    nlohmann::json j{{"value", w.value}, {"time_s", w.time}, {"step", w.step}};
    j["between"] = nlohmann::json::array();
    if (!w.one.empty()) j["between"] = {w.one, w.another};
    return j;
}

/// All figures.
inline nlohmann::json json_of(const Figures& f) {
    nlohmann::json j;
    j["dim"] = f.dim;
    j["grains"] = f.grains;
    j["scene"] = f.scene;
    j["solver"] = f.solver.empty() ? "default" : f.solver;
    j["step_s"] = f.h;
    j["seconds"] = f.seconds;
    j["tolerance"] = f.tolerance;
    j["certified"] = certified(f);
    j["impossible"] = impossible_in(f);
    j["stopped"] = f.stopped;
    j["failure"] = f.failure;
    j["steps"] = f.steps.size();
    j["steps_missed"] = f.missed;
    j["worst_residual"] = f.residual.value;
    j["worst"] = {{"residual", json_of(f.residual)},
                  {"velocity_error_m_per_s", json_of(f.velocity_error)},
                  {"overlap_over_half_thickness", json_of(f.overlap)}};
    j["drift_m"] = f.drift;
    j["mean_radius_m"] = f.mean_radius;
    j["mean_penetration_m"] = f.mean_penetration();
    double deepest = 0.0;
    for (const StepFigures& s : f.steps) deepest = std::max(deepest, s.max_penetration);
    j["deepest_penetration_m"] = deepest;
    j["reaction_over_weight"] = f.reaction_over_weight();
    j["reaction_over_weight_due"] = f.reaction_over_weight_due();
    j["rms_speed_m_per_s"] = f.speed();
    j["energy_J"] = {{"kinetic_start", f.kinetic_start},
                     {"kinetic_end", f.last().kinetic},
                     {"potential_start", f.potential_start},
                     {"potential_end", f.last().potential},
                     {"friction", f.given.friction},
                     {"restitution", f.given.impacts},
                     {"walls", f.given.walls},
                     {"gyroscopic", f.given.gyroscopic},
                     {"correction", f.given.correction},
                     {"missing", f.energy_missing}};
    j["energy_closure"] = f.energy_closure;
    nlohmann::json& rows = j["per_step"] = nlohmann::json::array();
    for (const StepFigures& s : f.steps)
        rows.push_back({{"time_s", s.time},
                        {"contacts", s.contacts},
                        {"sweeps", s.sweeps},
                        {"residual", s.residual},
                        {"kinetic_J", s.kinetic},
                        {"potential_J", s.potential},
                        {"friction_J", s.friction},
                        {"restitution_J", s.impacts},
                        {"max_penetration_m", s.max_penetration},
                        {"mean_penetration_m", s.mean_penetration},
                        {"reaction_over_weight", s.reaction_over_weight}});
    return j;
}

}  // namespace pile
