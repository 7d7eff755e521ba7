// SPDX-License-Identifier: BSL-1.0
#include "solver_registry.hpp"

#include <talus/solver/solver_registry.hpp>

#include "baselines/admm.hpp"
#include "baselines/extragradient.hpp"
#ifdef TALUS_BENCH_SICONOS
#include "peer_siconos.hpp"
#endif

namespace bench {

namespace {

/// One of the library's registry, as it comes.
RegisteredSolver named(const char* name) {
    const auto make = [name]<int Dim>(double tolerance) {
        return talus::make_solver<Dim, Law<Dim>>(name, {tolerance, unlimited});
    };
    return {name, solve_with<2>([=](double t) { return make.operator()<2>(t); }),
            solve_with<3>([=](double t) { return make.operator()<3>(t); })};
}

template <int Dim, class Solver>
SolveFunction<Dim> with_params(decltype(Solver::params) params) {
    if constexpr (requires { params.max_sweeps; })
        params.max_sweeps = unlimited;
    else
        params.max_iterations = unlimited;
    return solve_with<Dim>([params](double tolerance) mutable {
        params.tolerance = tolerance;
        return talus::AnySolver<Dim, Law<Dim>>(Solver(params));
    });
}
/// One with parameters that the registry does not set.
template <template <int, class> class Solver>
RegisteredSolver variant(const char* name, const decltype(Solver<2, Law<2>>::params)& params = {}) {
    return {name, with_params<2, Solver<2, Law<2>>>(params),
            with_params<3, Solver<3, Law<3>>>(params)};
}
/// Of those that work on scaled impulses and give them back at the end.
RegisteredSolver gives_back_at_the_end(RegisteredSolver solver) {
    solver.in_place = false;
    return solver;
}

}  // namespace

std::vector<RegisteredSolver> own_solvers() {
    std::vector<RegisteredSolver> solvers;
    using talus::Acceleration;
    using talus::GradientStep;
    solvers.push_back(named("automatic"));
    solvers.push_back(named("gauss_seidel"));
    solvers.push_back(variant<talus::GaussSeidel>("gauss_seidel_symmetric",
                                                  {.order = talus::SweepOrder::symmetric}));
    solvers.push_back(variant<talus::AcceleratedGaussSeidel>(
        "nesterov", {.acceleration = Acceleration::nesterov}));
    solvers.push_back(variant<talus::AcceleratedGaussSeidel>(
        "anderson", {.acceleration = Acceleration::anderson}));
    const auto add = [&](RegisteredSolver s) {
        solvers.push_back(gives_back_at_the_end(std::move(s)));
    };
    add(variant<talus::ProjectedGradient>("spectral_gradient", {.step = GradientStep::spectral}));
    add(variant<talus::ProjectedGradient>("accelerated_gradient",
                                          {.step = GradientStep::accelerated}));
    add(variant<Extragradient>("extragradient"));
    add(variant<Admm>("admm"));
    for (const char* name : {"interior_point", "inexact_interior_point", "proximal_newton"})
        add(named(name));
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
