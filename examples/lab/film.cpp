// SPDX-License-Identifier: BSL-1.0
#include "film.hpp"

#include <talus/io/series/movie_series.hpp>
#include <talus/io/series/schedule.hpp>

#include <vector>

#include "picture.hpp"

namespace lab {

template <int Dim>
struct Film<Dim>::Parts {
    talus::Schedule due;
    talus::MovieSeries<Dim> movie;
};

template <int Dim>
Film<Dim>::Film(const Command& command, const std::filesystem::path& folder,
                const std::string& title, double begin) {
    if (!(command.frames() > 0.0)) return;
    const talus::MovieWords words{title, "load", "N"};
    const auto file = folder / "movie.jsonl";
    parts_ = std::make_unique<Parts>(
        Parts{talus::Schedule::every(1.0 / command.frames(), begin),
              begin > 0.0 && !command.fresh() ? talus::MovieSeries<Dim>::resumed(file, words, begin)
                                              : talus::MovieSeries<Dim>(file, words)});
}
template <int Dim>
Film<Dim>::~Film() = default;

template <int Dim>
void Film<Dim>::show(const talus::Simulation<Dim>& sim) {
    if (!parts_ || !parts_->due.due(sim)) return;
    const std::vector<double> load = loads(sim);
    parts_->movie.add(sim.time(), sim.system().bodies, sim.system().shapes(), load);
}

template class Film<2>;
template class Film<3>;

}  // namespace lab
