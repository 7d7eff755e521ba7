// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/number_record.hpp>
#include <talus/stepping/run_summary.hpp>
#include <talus/stepping/simulation.hpp>

#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "command.hpp"
#include "film.hpp"

namespace lab {

/// Whether a thing says how it is written down and taken up again.
template <class T>
concept Carried = requires(const T& x, talus::NumberRecord& out) {
    x.write(out);
};

/// When something happened, to be carried along; before: never.
struct Mark {
    double time = std::numeric_limits<double>::infinity();  ///< [s]
    void write(talus::NumberRecord& out) const { out.real(time); }
    static Mark read(talus::NumberRecordReader& in) { return {in.real()}; }
};

/// Numbers measured so far, to be carried along.
struct Series {
    std::vector<double> values;
    void write(talus::NumberRecord& out) const { out.reals = values; }
    void restore(const talus::NumberRecord& record) { values = record.reals; }
};

/// The run of an experiment: it begins where its checkpoint is, shows how long it will take, films,
/// writes a checkpoint every so often and at the end, and remembers whether its steps can be
/// believed.
template <int Dim>
class Run {
  public:
    /// Makes the folder for results, and in it, for one of several runs of an experiment, that of
    /// the part of this name. Throws input_error if it cannot be written.
    Run(const Command& command, talus::Simulation<Dim>& sim, std::string title,
        const std::string& part = "");

    /// What is taken up with the run: random numbers, inlets, ledgers. Before `begin`.
    template <Carried T>
    void carry(const std::string& name, T& thing) {
        things_[name] = {[&thing] { return talus::record_of(thing); },
                         [&thing](const talus::NumberRecord& record) {
                             if constexpr (requires { thing.restore(record); })
                                 thing.restore(record);
                             else
                                 thing = talus::from_record<T>(record);
                         }};
    }

    /// Goes to the last checkpoint, if there is one. Throws input_error if it is of another
    /// experiment, or of other options, or damaged.
    void begin();

    using Each = std::function<void()>;
    /// Steps until the clock shows `time` [s], `each()` after each step. False if the user stopped
    /// it on the way: the program then ends.
    bool until(double time, const std::string& label, const Each& each = {});
    /// Steps until `over()`, which will be at about the time `expected` [s].
    bool until(const std::function<bool()>& over, double expected, const std::string& label,
               const Each& each = {});

    /// Where the checkpoint and the movie are.
    const std::filesystem::path& folder() const { return folder_; }
    std::filesystem::path file() const { return folder_ / "checkpoint.h5"; }
    /// Whether there is a last step to be looked at: a run that was over had none.
    bool stepped() const { return stepped_; }
    const talus::RunSummary& summary() const { return summary_; }
    int exit_code() const;

  private:
    void save();

    const Command& command_;
    talus::Simulation<Dim>& sim_;
    std::filesystem::path folder_;
    std::string title_;
    std::map<std::string, std::pair<std::function<talus::NumberRecord()>,
                                    std::function<void(const talus::NumberRecord&)>>>
        things_;
    std::optional<Film<Dim>> film_;
    talus::RunSummary summary_;
    bool stepped_ = false;
};

extern template class Run<2>;
extern template class Run<3>;

/// Runs an experiment and turns whatever it throws into a sentence and an exit code.
int run_program(const std::string& name, const std::function<int()>& experiment);

}  // namespace lab
