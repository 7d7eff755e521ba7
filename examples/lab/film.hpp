// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/stepping/simulation.hpp>

#include <filesystem>
#include <memory>
#include <string>

#include "command.hpp"

namespace lab {

/// The movie of an experiment, `movie.jsonl` in a folder, for examples/player; none without
/// --frames. A run that goes on from `begin` [s] goes on with it.
template <int Dim>
class Film {
  public:
    Film(const Command& command, const std::filesystem::path& folder, const std::string& title,
         double begin);
    ~Film();
    /// After each step, before bodies are taken out.
    void show(const talus::Simulation<Dim>& sim);

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

extern template class Film<2>;
extern template class Film<3>;

}  // namespace lab
