// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/io/checkpoint/checkpoint.hpp>
#include <talus/io/series/schedule.hpp>
#include <talus/stepping/run_summary.hpp>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "../pile/made_folder.hpp"
#include "../pile/progress.hpp"
#include "../pile/stop_request.hpp"
#include "command.hpp"

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

/// The run of an experiment: it begins where its checkpoint is, shows how long it will take, writes
/// a checkpoint every so often and at the end, and remembers whether its steps can be believed.
template <class Sim>
class Run {
  public:
    /// Makes the folder for results. Throws input_error if it cannot be written.
    Run(const Command& command, Sim& sim) : command_(command), sim_(sim) {
        try {
            pile::MadeFolder folder(command.out());
            talus::require_writable(file());
            folder.keep();
        } catch (const std::runtime_error& error) {
            throw talus::input_error(std::string("--out: ") + error.what());
        }
        pile::StopRequest::listen();
    }

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
    void begin() {
        carry("summary", summary_);
        if (command_.fresh() || !std::filesystem::exists(file())) return;
        try {
            const auto records = talus::load_checkpoint(file(), sim_, command_.label());
            for (const auto& [name, thing] : things_) {
                const auto found = records.find(name);
                if (found == records.end())
                    throw talus::input_error(name + " is missing, but must be there");
                thing.second(found->second);
            }
        } catch (const talus::input_error& error) {
            throw talus::input_error(std::string(error.what()) + " (--fresh begins anew)");
        }
        std::fprintf(stderr, "%s: goes on at %.6g s\n", command_.name().c_str(), sim_.time());
    }

    /// Steps until the clock shows `time` [s], `each()` after each step. False if the user stopped
    /// it on the way: the program then ends.
    template <class Each>
    bool until(double time, const std::string& label, Each&& each) {
        const double h = sim_.params().h;
        return until([&] { return sim_.time() >= time - 0.5 * h; }, time, label, each);
    }
    /// Steps until `over()`, which will be at about the time `expected` [s].
    template <std::predicate Over, class Each>
    bool until(Over&& over, double expected, const std::string& label, Each&& each) {
        pile::Progress progress(label);
        const double begin = sim_.time();
        double next_save = command_.save_every();
        while (!over() && pile::StopRequest::signal() == 0) {
            sim_.step();
            summary_.record(sim_.system(), sim_.data());
            stepped_ = true;
            const std::size_t contacts = sim_.data().contact_count();
            each();
            const double share =
                over() ? 1.0 : std::min((sim_.time() - begin) / (expected - begin), 0.99);
            if (!command_.quiet() && progress.due(share)) {
                char remark[100];
                std::snprintf(remark, sizeof remark, "%zu bodies, %zu contacts, t = %.4g s",
                              sim_.system().bodies.count(), contacts, sim_.time());
                progress.show(share, remark);
            }
            if (progress.seconds() > next_save) {
                save();
                next_save = progress.seconds() + command_.save_every();
            }
        }
        if (sim_.time() > begin) save();
        return pile::StopRequest::signal() == 0;
    }
    void save() {
        talus::CheckpointRecords records;
        for (const auto& [name, thing] : things_) records[name] = thing.first();
        talus::save_checkpoint(file(), sim_, command_.label(), records);
    }

    std::filesystem::path file() const { return command_.out() / "checkpoint.h5"; }
    /// Whether there is a last step to be looked at: a run that was over had none.
    bool stepped() const { return stepped_; }
    const talus::RunSummary& summary() const { return summary_; }
    int exit_code() const {
        if (const int signal = pile::StopRequest::signal()) return ExitCode::stopped + signal;
        return summary_.certified() ? ExitCode::certified : ExitCode::not_certified;
    }

  private:
    const Command& command_;
    Sim& sim_;
    std::map<std::string, std::pair<std::function<talus::NumberRecord()>,
                                    std::function<void(const talus::NumberRecord&)>>>
        things_;
    talus::RunSummary summary_;
    bool stepped_ = false;
};

/// Runs an experiment and turns whatever it throws into a sentence and an exit code.
template <class Experiment>
int run_program(const std::string& name, Experiment&& experiment) {
    const auto complain = [&](const std::exception& error) {
        std::fprintf(stderr, "%s: %s\n", name.c_str(),
                     talus::detail::printable(error.what()).c_str());
    };
    talus::silence_hdf5();
    try {
        return experiment();
    } catch (const talus::input_error& error) {
        complain(error);
        return ExitCode::wrong_input;
    } catch (const std::exception& error) {
        complain(error);
        return ExitCode::failed;
    }
}

}  // namespace lab
