// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/feed/inlet.hpp>
#include <talus/stepping/simulation.hpp>

#include <algorithm>
#include <string>

#include "../run.hpp"

namespace lab {

/// Steps until all grains of an inlet have come, which will be at about the time `expected` [s];
/// `full` then says when that was. `each()` after each step, before grains come. The inlet and the
/// mark are carried along by the run. False if the user stopped it on the way.
template <int Dim, class Each>
bool pour(Run<Dim>& run, talus::Simulation<Dim>& sim, talus::Inlet<Dim>& inlet, Mark& full,
          double expected, const std::string& label, Each&& each) {
    return run.until([&] { return inlet.done(); }, expected, label,
                     [&] {
                         each();
                         inlet.feed(sim.system(), sim.time());
                         if (inlet.done()) full.time = std::min(full.time, sim.time());
                     });
}
template <int Dim>
bool pour(Run<Dim>& run, talus::Simulation<Dim>& sim, talus::Inlet<Dim>& inlet, Mark& full,
          double expected, const std::string& label) {
    return pour(run, sim, inlet, full, expected, label, [] {});
}

}  // namespace lab
