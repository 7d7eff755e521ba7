// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/instantiate.hpp>
#include <talus/law/cone_of.hpp>
#include <talus/solver/any_solver.hpp>
#include <talus/solver/automatic.hpp>
#include <talus/solver/cones/inexact_interior_point.hpp>
#include <talus/solver/cones/interior_point.hpp>
#include <talus/solver/cones/newton_polish.hpp>
#include <talus/solver/cones/projected_gradient.hpp>
#include <talus/solver/cones/proximal_newton.hpp>
#include <talus/solver/oracle/enumeration.hpp>
#include <talus/solver/sweeps/accelerated_gauss_seidel.hpp>
#include <talus/solver/sweeps/gauss_seidel.hpp>

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace talus {

namespace detail {

/// A name, and what makes the solver of that name.
template <int Dim, class Law>
struct RegistryEntry {
    SolverName text;
    AnySolver<Dim, Law> (*make)(SolverSettings);
};

/// Leaves a solver's parameters as they are.
struct AsTheyAre {
    static void set(auto&) {}
};
struct WithMomentum {
    static void set(auto& params) { params.acceleration = Acceleration::nesterov; }
};

/// A solver with settings; all else stays as its own parameters have it, or as `Own` sets them.
template <class Solver, class Own>
Solver with_settings(SolverSettings settings) {
    Solver solver;
    Own::set(solver.params);
    solver.params.tolerance = settings.tolerance;
    if (!settings.max_iterations) return solver;
    // Limits are called by what they count.
    if constexpr (requires { solver.params.max_iterations; })
        solver.params.max_iterations = *settings.max_iterations;
    if constexpr (requires { solver.params.max_sweeps; })
        solver.params.max_sweeps = *settings.max_iterations;
    if constexpr (requires { solver.params.max_factorizations; })
        solver.params.max_factorizations = *settings.max_iterations;
    return solver;
}
template <int Dim, class Law, class Solver, class Own = AsTheyAre>
constexpr RegistryEntry<Dim, Law> entry(std::string_view name, std::string_view description) {
    return {{name, description}, [](SolverSettings settings) {
                return AnySolver<Dim, Law>(with_settings<Solver, Own>(settings));
            }};
}

/// The registry: a solver is a line.
template <int Dim, LawWithoutRolling<Dim> Law>
constexpr auto registry_entries() {
    const std::array any_law{
        entry<Dim, Law, Automatic<Dim, Law>>(
            "automatic", "hands over between the others; the one to use where nothing is known"),
        entry<Dim, Law, GaussSeidel<Dim, Law>>("gauss_seidel",
                                               "sweeps; the cheapest to 1e-2 and 1e-3"),
        entry<Dim, Law, AcceleratedGaussSeidel<Dim, Law>>(
            "accelerated_gauss_seidel", "double sweeps, combined by Anderson; to 1e-8"),
        entry<Dim, Law, AcceleratedGaussSeidel<Dim, Law>, WithMomentum>(
            "momentum_gauss_seidel", "double sweeps with momentum; the method of simulations"),
    };
    if constexpr (ConeLaw<Law, Dim>) {
        return std::array{
            any_law[0],
            any_law[1],
            any_law[2],
            any_law[3],
            entry<Dim, Law, ProjectedGradient<Dim, Law>>(
                "projected_gradient", "products with W alone; many contacts at 1e-4"),
            entry<Dim, Law, InteriorPoint<Dim, Law>>(
                "interior_point", "5 to 25 factorisations; hyperstatic systems, masonry"),
            entry<Dim, Law, InexactInteriorPoint<Dim, Law>>(
                "inexact_interior_point",
                "the same without factors; masonry of 1e3 to 1e4 contacts"),
            entry<Dim, Law, ProximalNewton<Dim, Law>>(
                "proximal_newton", "4 to 15 factorisations; towers, tight tolerances"),
            entry<Dim, Law, NewtonPolish<Dim, Law>>(
                "newton_polish", "factorisations; the last digits, from near a solution"),
            entry<Dim, Law, Enumeration<Dim, Law>>(
                "enumeration", "every status of up to 8 contacts (4 in space); an oracle"),
        };
    } else {
        return any_law;
    }
}

}  // namespace detail

template <int Dim, LawWithoutRolling<Dim> Law>
std::span<const SolverName> SolverRegistry<Dim, Law>::names() {
    // One array per law, in static memory: spans of it stay valid.
    static constexpr auto names = [] {
        constexpr auto entries = detail::registry_entries<Dim, Law>();
        std::array<SolverName, entries.size()> texts{};
        for (std::size_t k = 0; k < texts.size(); ++k) texts[k] = entries[k].text;
        return texts;
    }();
    return names;
}

template <int Dim, LawWithoutRolling<Dim> Law>
AnySolver<Dim, Law> SolverRegistry<Dim, Law>::make(std::string_view name, SolverSettings settings) {
    require_non_negative("tolerance", settings.tolerance);
    require_non_negative("max_iterations", settings.max_iterations.value_or(0));
    std::string known;
    // A dozen names: no map.
    for (const auto& entry : detail::registry_entries<Dim, Law>()) {
        if (entry.text.name == name) return entry.make(settings);
        known += (known.empty() ? "" : ", ") + std::string(entry.text.name);
    }
    throw input_error("solver is '" + std::string(name) + "', but must be one of " + known);
}

}  // namespace talus

TALUS_IN_PLANE(struct talus::SolverRegistry<2, talus::Coulomb<2>>)
TALUS_IN_SPACE(struct talus::SolverRegistry<3, talus::Coulomb<3>>)
