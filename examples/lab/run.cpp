// SPDX-License-Identifier: BSL-1.0
#include "run.hpp"

#include <talus/core/printable.hpp>
#include <talus/io/checkpoint/checkpoint.hpp>

#include <algorithm>
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
      title_(std::move(title)) {
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
    if (!command_.fresh() && std::filesystem::exists(file())) {
        try {
            const auto records = talus::load_checkpoint(file(), sim_, command_.label());
            for (const auto& [name, thing] : things_) thing.second(records.at(name));
        } catch (const talus::input_error& error) {
            throw talus::input_error(std::string(error.what()) + " (--fresh begins anew)");
        }
        std::fprintf(stderr, "%s: goes on at %.6g s\n", command_.name().c_str(), sim_.time());
    }
    film_.emplace(command_, folder_, title_, sim_.time());
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
    double next_save = command_.save_every();
    while (!over() && pile::StopRequest::signal() == 0) {
        sim_.step();
        summary_.record(sim_.system(), sim_.data());
        stepped_ = true;
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
        if (progress.seconds() > next_save) {
            save();
            next_save = progress.seconds() + command_.save_every();
        }
    }
    if (sim_.time() > begin) save();
    return pile::StopRequest::signal() == 0;
}

template <int Dim>
void Run<Dim>::save() {
    talus::CheckpointRecords records;
    for (const auto& [name, thing] : things_) records[name] = thing.first();
    talus::save_checkpoint(file(), sim_, command_.label(), records);
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
