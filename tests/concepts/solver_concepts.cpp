// SPDX-License-Identifier: BSL-1.0
#include <talus/law/signorini.hpp>
#include <talus/solver/concepts.hpp>

namespace {

using Law = talus::Signorini<3>;
using Problem = talus::ContactProblem<3, Law>;

struct Archetype {
    talus::SolveReport solve(const Problem&, std::span<talus::Vector<3>>) { return {}; }
};
static_assert(talus::ContactSolver<Archetype, 3, Law>);
static_assert(!talus::ContactSolver<Archetype, 2, talus::Signorini<2>>);

struct WithoutReport {
    void solve(const Problem&, std::span<talus::Vector<3>>) {}
};
static_assert(!talus::ContactSolver<WithoutReport, 3, Law>);

struct ChangesTheProblem {
    talus::SolveReport solve(Problem&, std::span<talus::Vector<3>>) { return {}; }
};
static_assert(!talus::ContactSolver<ChangesTheProblem, 3, Law>);

}  // namespace
