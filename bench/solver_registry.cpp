// SPDX-License-Identifier: BSL-1.0
#include "solver_registry.hpp"

#include <talus/solver/gauss_seidel.hpp>
#ifdef TALUS_BENCH_SICONOS
#include "peer_siconos.hpp"
#endif

namespace bench {

std::vector<RegisteredSolver> own_solvers() {
    std::vector<RegisteredSolver> solvers;
    const auto gauss_seidel = [&](const char* name, const talus::GaussSeidelParams& params) {
        solvers.push_back({name, solve_with<2, talus::GaussSeidel<2, Law<2>>>(params),
                           solve_with<3, talus::GaussSeidel<3, Law<3>>>(params)});
    };
    gauss_seidel("gauss_seidel", {});
    talus::GaussSeidelParams symmetric;
    symmetric.order = talus::SweepOrder::symmetric;
    gauss_seidel("gauss_seidel_symmetric", symmetric);
    return solvers;
}

std::vector<RegisteredSolver> peer_solvers([[maybe_unused]] PeerUnits units) {
#ifdef TALUS_BENCH_SICONOS
    return siconos_solvers(units);
#else
    return {};
#endif
}

}  // namespace bench
