// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/io/problem_file.hpp>

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace talus {

/// Anything that has made a step: a Simulation.
template <class S>
concept SteppedRun = requires(const S& run) {
    { run.step_count() } -> std::convertible_to<std::int64_t>;
    { run.time() } -> std::convertible_to<double>;  // at the end of the step [s]
    run.data().problem;                             // a ContactProblem
    run.data().impulse;                             // its impulses, one per contact
};

/// An observer that writes the contact problem of a step to a file of its own, with the impulses
/// found as the file's solution: FOLDER/NAME-000123.hdf5 for step 123. For every step:
///
///     const RunSummary run = sim.run(1.0, StepDump("problems", "pile"));
///
/// or for those of interest:
///
///     const StepDump dump("problems", "pile");
///     const RunSummary run = sim.run(1.0, [&](const auto& s) {
///         if (s.data().report.status != SolveStatus::converged) dump(s);
///     });
///
/// Throws what write_problem throws. The folder must exist.
class StepDump {
  public:
    StepDump(std::filesystem::path folder, std::string name)
        : folder_(std::move(folder)), name_(std::move(name)) {}

    /// The file of a step.
    std::filesystem::path path(std::int64_t step) const {
        std::string number = std::to_string(step);
        if (number.size() < digits) number.insert(0, digits - number.size(), '0');
        return folder_ / (name_ + "-" + number + ".hdf5");
    }

    template <SteppedRun Run>
    void operator()(const Run& run) const {
        const std::string title = name_ + ", step " + std::to_string(run.step_count());
        write(path(run.step_count()), run.data().problem, run.data().impulse,
              {title, "the step that ended at t = " + detail::text_of(run.time()) + " s", {}});
    }

    /// One problem with its impulses.
    template <int Dim, class Law>
    static void write(const std::filesystem::path& path, const ContactProblem<Dim, Law>& problem,
                      std::type_identity_t<std::span<const Vector<Dim>>> impulse,
                      const ProblemInfo& info = {}) {
        ProblemContent<Dim> content;
        content.global = global_form(problem);
        content.solution = solution_of<Dim>(*content.global, impulse);
        content.info = info;
        write_problem(path, content);
    }

  private:
    static constexpr std::size_t digits = 6;  ///< so that files sort by step

    std::filesystem::path folder_;
    std::string name_;
};

}  // namespace talus
