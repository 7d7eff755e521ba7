// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <optional>
#include <string>

namespace pile {

/// What the command line asks for. Whole numbers are doubles here, so that all numbers are read and
/// checked alike.
struct Options {
    std::string scene;   ///< file; empty: generate
    int dim = 0;         ///< 0: both
    std::string shape;   ///< empty: polygons in 2D, spheres in 3D
    double count = 400;  ///< grains to generate
    double seed = 1;
    std::optional<double> mu;  ///< friction coefficient; scene's or 0.4
    double restitution = 0.0;
    double duration = 1.0;    ///< [s]
    double step = 5e-4;       ///< h [s]
    std::string solver;       ///< name in the library's registry; empty: that of simulations
    double tolerance = 1e-4;  ///< on the residual of every step: the aim of simulations
    double max_sweeps = 20000;
    std::string scheme = "anticipating";
    double correction = 0.0;       ///< share of overlaps removed per step
    std::string out = "pile-out";  ///< folder
    std::string json;              ///< file; empty: none
    bool quiet = false;
};

}  // namespace pile
