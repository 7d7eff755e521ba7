// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/number_record.hpp>
#include <talus/io/series/csv_series.hpp>
#include <talus/stepping/run_summary.hpp>
#include <talus/stepping/simulation.hpp>

#include <chrono>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "command.hpp"
#include "film.hpp"
#include "numbers.hpp"

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

/// A number that is carried along.
struct Real {
    double value = 0.0;
    void write(talus::NumberRecord& out) const { out.real(value); }
    static Real read(talus::NumberRecordReader& in) { return {in.real()}; }
};

/// The run of an experiment: it begins where its checkpoint is, shows how long it will take, films,
/// writes a checkpoint every so often, and remembers whether its steps can be believed.
template <int Dim>
class Run {
  public:
    /// Makes the folder for results, and in it, for one of several runs of an experiment, that of
    /// the part of this name. Throws input_error if it cannot be written.
    Run(const Command& command, talus::Simulation<Dim>& sim, std::string title,
        const std::string& part = "");

    /// What is taken up with the run: random numbers, inlets, ledgers. Throws std::logic_error
    /// after `begin`, which would not know of it.
    template <Carried T>
    void carry(const std::string& name, T& thing) {
        if (film_)
            throw std::logic_error("'" + name + "' is carried too late, but must be before begin");
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

    /// A table `name` in its folder that grows with time: where the run goes on, after the rows
    /// up to there. After `begin`.
    talus::CsvSeries series(const std::string& name,
                            const std::vector<talus::CsvSeries::Column>& columns) const;

    using Each = std::function<void()>;
    /// Steps until the clock shows `time` [s], `each()` after each step. False if the user stopped
    /// it on the way: the program then ends. The simulation has a last step to be measured after
    /// it, however often the run was killed: a checkpoint is written before a step alone.
    bool until(double time, const std::string& label, const Each& each = {});
    /// Steps until `over()`, which will be at about the time `expected` [s].
    bool until(const std::function<bool()>& over, double expected, const std::string& label,
               const Each& each = {});

    /// Where all of this run is written.
    const std::filesystem::path& folder() const { return folder_; }
    /// When all has been measured: writes the state at the end, `end.h5`, for other programs,
    /// prints whether the run can be believed (of a part the program says it), and returns the exit
    /// code.
    int finish();
    /// Of a run that was stopped, or is over.
    int exit_code() const;
    const talus::RunSummary& summary() const { return summary_; }

  private:
    std::filesystem::path file() const { return folder_ / "checkpoint.h5"; }
    void save(const std::filesystem::path& path);
    double since_save() const;  ///< [s] of work

    const Command& command_;
    talus::Simulation<Dim>& sim_;
    std::filesystem::path folder_;
    std::string title_, label_;
    std::map<std::string, std::pair<std::function<talus::NumberRecord()>,
                                    std::function<void(const talus::NumberRecord&)>>>
        things_;
    std::optional<Film<Dim>> film_;
    bool goes_on_ = false;
    talus::RunSummary summary_;
    std::chrono::steady_clock::time_point saved_ = std::chrono::steady_clock::now();
};

extern template class Run<2>;
extern template class Run<3>;

/// Runs an experiment and turns whatever it throws into a sentence and an exit code.
int run_program(const std::string& name, const std::function<int()>& experiment);

}  // namespace lab
