// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/stepping/run_summary.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "figures.hpp"

namespace pile {

/// What no pile can do, however long its solver worked.
struct Possible {
    /// Energy that friction or impacts may give, over what went through [-]. Contacts that open or
    /// stick within a step give as much as h g does, at most; a wrong answer gives all of it.
    double gain = 1e-3;
    /// Of half the thickness of the thinner body [-]: more, and it is another pile than the one
    /// that was asked for.
    double overlap = talus::RunSummary::deepest_overlap;
    /// Between the force of the floor and what the momentum of the grains asks for, over the larger
    /// of weight and force [-]: rounding.
    double floor = 1e-6;
    double closure = 1e-10;  ///< of the energy books, over what went through [-]: rounding
    /// Of positions, by which heights lose energy in each step [-]: where large masses hardly move,
    /// more than what goes through.
    double rounding = std::numeric_limits<double>::epsilon();
};

/// One sentence for each thing that the figures say and that cannot be.
inline std::vector<std::string> impossible_in(const Figures& f, const Possible& possible = {}) {
    std::vector<std::string> found;
    const auto say = [&found](const char* format, auto... values) {
        char buffer[400];
        std::snprintf(buffer, sizeof buffer, format, values...);
        found.emplace_back(buffer);
    };
    const double through = f.largest_energy();
    // Comparisons are such that what is not a number is found, too.
    const auto gives = [&](double given) { return !(given <= possible.gain * through); };
    if (gives(f.given.friction))
        say("Friction gave %.3g J, but it can only take energy.", f.given.friction);
    if (gives(f.given.impacts))
        say("Impacts gave %.3g J, but they can only take energy.", f.given.impacts);
    const auto pair = f.overlap.one + " and " + f.overlap.another;
    if (!(f.overlap.value <= possible.overlap))
        say("In step %lld %s overlapped by %.3g %% of the thinner one's half thickness, but solids "
            "keep out of each other.",
            static_cast<long long>(f.overlap.step), pair.c_str(), 100 * f.overlap.value);
    double largest_force = 1.0;
    for (std::size_t k = f.late(); k < f.steps.size(); ++k)
        largest_force = std::max(largest_force, std::abs(f.steps[k].reaction_over_weight));
    const double floor = f.reaction_over_weight(), due = f.reaction_over_weight_due();
    if (!(std::abs(floor - due) <= possible.floor * largest_force))
        say("The floor carried %.6g of the weight over the last tenth, but the momentum of the "
            "grains asks for %.6g.",
            floor, due);
    const double largest_stored =
        std::max(std::abs(f.potential_start), std::abs(f.last().potential));
    const double unnoticed = possible.closure * through + possible.rounding *
                                                              static_cast<double>(f.steps.size()) *
                                                              largest_stored;
    if (!(std::abs(f.energy_missing) <= unnoticed))
        say("The energy books miss %.3g J, %.1e of what went through, but energy does not come "
            "from nowhere.",
            f.energy_missing, f.energy_closure);
    return found;
}

/// Whether the answer may be believed.
inline bool certified(const Figures& f) {
    return f.failure.empty() && f.missed == 0 && impossible_in(f).empty();
}

}  // namespace pile
