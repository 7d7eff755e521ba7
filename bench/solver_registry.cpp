// SPDX-License-Identifier: BSL-1.0
#include "solver_registry.hpp"

#include <talus/solver/automatic.hpp>
#include <talus/solver/cones/inexact_interior_point.hpp>
#include <talus/solver/cones/interior_point.hpp>
#include <talus/solver/cones/projected_gradient.hpp>
#include <talus/solver/cones/proximal_newton.hpp>
#include <talus/solver/sweeps/accelerated_gauss_seidel.hpp>
#include <talus/solver/sweeps/gauss_seidel.hpp>

#include "baselines/admm.hpp"
#include "baselines/extragradient.hpp"
#ifdef TALUS_BENCH_SICONOS
#include "peer_siconos.hpp"
#endif

namespace bench {

namespace {

template <template <int, class> class Solver>
RegisteredSolver own(const char* name, const decltype(Solver<2, Law<2>>::params)& params = {}) {
    return {name, solve_with<2, Solver<2, Law<2>>>(params),
            solve_with<3, Solver<3, Law<3>>>(params)};
}
/// Of those that work on scaled impulses and give them back at the end.
template <template <int, class> class Solver>
RegisteredSolver engine(const char* name, const decltype(Solver<2, Law<2>>::params)& params = {}) {
    RegisteredSolver solver = own<Solver>(name, params);
    solver.in_place = false;
    return solver;
}

}  // namespace

std::vector<RegisteredSolver> own_solvers() {
    std::vector<RegisteredSolver> solvers;
    using talus::Acceleration;
    solvers.push_back(own<talus::Automatic>("automatic"));
    solvers.push_back(own<talus::GaussSeidel>("gauss_seidel"));
    solvers.push_back(
        own<talus::GaussSeidel>("gauss_seidel_symmetric", {.order = talus::SweepOrder::symmetric}));
    solvers.push_back(
        own<talus::AcceleratedGaussSeidel>("nesterov", {.acceleration = Acceleration::nesterov}));
    solvers.push_back(
        own<talus::AcceleratedGaussSeidel>("anderson", {.acceleration = Acceleration::anderson}));
    using talus::GradientStep;
    solvers.push_back(
        engine<talus::ProjectedGradient>("spectral_gradient", {.step = GradientStep::spectral}));
    solvers.push_back(engine<talus::ProjectedGradient>("accelerated_gradient",
                                                       {.step = GradientStep::accelerated}));
    solvers.push_back(engine<Extragradient>("extragradient"));
    solvers.push_back(engine<Admm>("admm"));
    solvers.push_back(engine<talus::InteriorPoint>("interior_point"));
    solvers.push_back(engine<talus::InexactInteriorPoint>("inexact_interior_point"));
    solvers.push_back(engine<talus::ProximalNewton>("proximal_newton"));
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
