// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/io/series/movie_series.hpp>
#include <talus/io/series/schedule.hpp>

#include <optional>
#include <string>
#include <vector>

#include "command.hpp"
#include "picture.hpp"

namespace lab {

/// The movie of an experiment, `movie.jsonl` in its folder, for examples/player; none without
/// frames. A run that goes on from `begin` [s] goes on with it.
template <int Dim>
class Film {
  public:
    Film(const Command& command, const std::string& title, double frames_per_second, double begin) {
        if (!(frames_per_second > 0.0)) return;
        due_ = talus::Schedule::every(1.0 / frames_per_second, begin);
        const talus::MovieWords words{title, "load", "N"};
        const auto file = command.out() / "movie.jsonl";
        if (begin > 0.0 && !command.fresh())
            movie_.emplace(talus::MovieSeries<Dim>::resumed(file, words, begin));
        else
            movie_.emplace(file, words);
    }
    /// After each step, before bodies are taken out.
    template <class Sim>
    void show(const Sim& sim) {
        if (!movie_ || !due_->due(sim)) return;
        const std::vector<double> load = loads<Dim>(sim);
        movie_->add(sim.time(), sim.system().bodies, sim.system().shapes(), load);
    }

  private:
    std::optional<talus::Schedule> due_;
    std::optional<talus::MovieSeries<Dim>> movie_;
};

}  // namespace lab
