// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/lagrangian/event_driven/acceleration_lcp.hpp>
#include <talus/lagrangian/event_driven/acceleration_problem.hpp>
#include <talus/lagrangian/event_driven/mode_search.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace talus {

/// What the problem on accelerations leaves to go on with.
enum class ChoiceStatus {
    one,       ///< one motion; the only one, if `counted`
    several,   ///< more than one: `solution` is the first that was found
    none,      ///< none, for certain
    not_found  ///< none was found
};

/// The next modes of contacts.
struct AccelerationChoice {
    ChoiceStatus status = ChoiceStatus::not_found;
    bool counted = true;  ///< all solutions are known
    AccelerationSolution solution;
};

/// Chooses by enumeration up to `enumeration_contacts` contacts, by Lemke's algorithm above, and
/// where forces of redundant contacts make the enumeration incomplete. `excluded` holds as long as
/// something else is left; in space a contact that shall not stick would have to slide, in a
/// direction that is not found here.
inline AccelerationChoice choose_accelerations(const AccelerationProblem& p,
                                               std::span<const ExcludedMode> excluded,
                                               int enumeration_contacts) {
    AccelerationChoice choice;
    const bool small = p.contact_count() <= static_cast<std::size_t>(enumeration_contacts);
    ModeSearch search;
    const bool strict = p.rows > 2 && std::ranges::count(excluded, ExcludedMode::sticking) > 0;
    if (small) {
        search.run(p, excluded);
        if (search.solutions().empty() && !excluded.empty() && !strict) search.run(p);
        choice.counted = search.complete();
        const auto& found = search.solutions();
        if (!found.empty()) {
            choice.status = found.size() > 1 ? ChoiceStatus::several : ChoiceStatus::one;
            choice.solution = found.front();
            return choice;
        }
        if (search.complete()) {
            choice.status = ChoiceStatus::none;
            return choice;
        }
    }
    choice.counted = false;
    if (const std::optional<AccelerationSolution> found = solve_by_lemke(p)) {
        choice.status = ChoiceStatus::one;
        choice.solution = *found;
    }
    return choice;
}

}  // namespace talus
