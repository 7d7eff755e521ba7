// SPDX-License-Identifier: BSL-1.0
#include "run.hpp"

#include <talus/core/printable.hpp>
#include <talus/io/checkpoint/checkpoint.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <stdexcept>

#include "../pile/made_folder.hpp"
#include "../pile/progress.hpp"
#include "../pile/stop_request.hpp"

namespace lab {

template <int Dim>
Run<Dim>::Run(const Command& command, talus::Simulation<Dim>& sim, std::string title,
              const std::string& part)
    : command_(command),
      sim_(sim),
      folder_(part.empty() ? command.out() : command.out() / part),
      title_(std::move(title)),
      label_(part.empty() ? command.label() : command.label() + " " + part) {
    try {
        pile::MadeFolder folder(folder_);
        talus::require_writable(file());
        folder.keep();
    } catch (const std::runtime_error& error) {
        throw talus::input_error(std::string("--out: ") + error.what());
    }
    pile::StopRequest::listen();
}

template <int Dim>
void Run<Dim>::begin() {
    carry("summary", summary_);
    for (const auto& [name, thing] : things_) talus::require_record_name(name);
    goes_on_ = !command_.fresh() && std::filesystem::exists(file());
    if (goes_on_) {
        try {
            const auto records = talus::load_checkpoint(file(), sim_, label_);
            for (const auto& [name, thing] : things_) thing.second(records.at(name));
        } catch (const talus::input_error& error) {
            throw talus::input_error(std::string(error.what()) + " (--fresh begins anew)");
        }
        std::fprintf(stderr, "%s: goes on at %.6g s\n", command_.name().c_str(), sim_.time());
    }
    film_.emplace(command_, folder_, title_, sim_.time());
}

template <int Dim>
talus::CsvSeries Run<Dim>::series(const std::string& name,
                                  const std::vector<talus::CsvSeries::Column>& columns) const {
    const auto path = folder_ / name;
    return goes_on_ ? talus::CsvSeries::resumed(path, columns, sim_.time())
                    : talus::CsvSeries(path, columns);
}

template <int Dim>
bool Run<Dim>::until(double time, const std::string& label, const Each& each) {
    const double h = sim_.params().h;
    return until([&] { return sim_.time() >= time - 0.5 * h; }, time, label, each);
}

template <int Dim>
bool Run<Dim>::until(const std::function<bool()>& over, double expected, const std::string& label,
                     const Each& each) {
    pile::Progress progress(label);
    const double begin = sim_.time();
    while (!over()) {
        // Before a step: who goes on from there has a last step to measure.
        const bool stopped = pile::StopRequest::signal() != 0;
        if (stopped || since_save() > command_.save_every()) save(file());
        if (stopped) return false;
        sim_.step();
        summary_.record(sim_.system(), sim_.data());
        const std::size_t contacts = sim_.data().contact_count();
        film_->show(sim_);
        if (each) each();
        const double share =
            over() ? 1.0 : std::min((sim_.time() - begin) / (expected - begin), 0.99);
        if (!command_.quiet() && progress.due(share)) {
            char remark[100];
            std::snprintf(remark, sizeof remark, "%zu bodies, %zu contacts, t = %.4g s",
                          sim_.system().bodies.count(), contacts, sim_.time());
            progress.show(share, remark);
        }
    }
    return true;
}

template <int Dim>
void Run<Dim>::save(const std::filesystem::path& path) {
    talus::CheckpointRecords records;
    for (const auto& [name, thing] : things_) records[name] = thing.first();
    talus::save_checkpoint(path, sim_, label_, records);
    saved_ = std::chrono::steady_clock::now();
}

template <int Dim>
double Run<Dim>::since_save() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - saved_).count();
}

template <int Dim>
int Run<Dim>::finish() {
    save(folder_ / "end.h5");
    if (folder_ == command_.out()) std::printf("%s\n", to_string(summary_).c_str());
    return exit_code();
}

template <int Dim>
int Run<Dim>::exit_code() const {
    if (const int signal = pile::StopRequest::signal()) return ExitCode::stopped + signal;
    return summary_.certified() ? ExitCode::certified : ExitCode::not_certified;
}

template class Run<2>;
template class Run<3>;

int run_program(const std::string& name, const std::function<int()>& experiment) {
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
