// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/instantiate.hpp>
#include <talus/law/concepts.hpp>
#include <talus/problem/assembled_problem.hpp>
#include <talus/problem/delassus_sparse.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#if TALUS_BODIES
#include <Eigen/SparseCholesky>
#endif

namespace talus {

/// A contact problem of any mechanical system,  M v = H r + f,  u = H^T v + w: what FCLib calls
/// global.
template <int Rows, ContactLaw<Rows> Law>
struct GlobalProblem {
    Eigen::SparseMatrix<double> mass;           ///< M, square, symmetric positive definite
    Eigen::SparseMatrix<double> contact_map;    ///< H, Rows columns per contact, normal first
    Eigen::VectorXd force;                      ///< f: impulses of all but the contacts, M v_begin
                                                ///< included
    std::vector<Vector<Rows>> velocity_offset;  ///< w [m/s]
    std::vector<Law> laws;

    std::size_t contact_count() const { return velocity_offset.size(); }
};

namespace detail {

/// H^T M^-1 H and H^T M^-1 f.
struct EliminatedVelocities {
    Eigen::SparseMatrix<double> delassus;
    Eigen::VectorXd velocity;
};
/// Throws input_error if M cannot be factorised.
TALUS_FUNCTION EliminatedVelocities
eliminated_velocities(const Eigen::SparseMatrix<double>& mass,
                      const Eigen::SparseMatrix<double>& contact_map, const Eigen::VectorXd& force);
/// M^-1 b. Throws input_error if M cannot be factorised.
TALUS_FUNCTION Eigen::VectorXd solved_mass(const Eigen::SparseMatrix<double>& mass,
                                           const Eigen::VectorXd& b);

#if TALUS_BODIES

/// Calls f with the Cholesky factors of M.
template <class F>
auto with_factors(const Eigen::SparseMatrix<double>& mass, F&& f) {
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(mass);
    if (factors.info() != Eigen::Success)
        throw input_error("M is singular, but must be symmetric and positive definite");
    return f(factors);
}
TALUS_FUNCTION EliminatedVelocities eliminated_velocities(
    const Eigen::SparseMatrix<double>& mass, const Eigen::SparseMatrix<double>& contact_map,
    const Eigen::VectorXd& force) {
    return with_factors(mass, [&](const auto& factors) {
        const Eigen::SparseMatrix<double> mobility = factors.solve(contact_map);
        return EliminatedVelocities{contact_map.transpose() * mobility,
                                    contact_map.transpose() * factors.solve(force)};
    });
}
TALUS_FUNCTION Eigen::VectorXd solved_mass(const Eigen::SparseMatrix<double>& mass,
                                           const Eigen::VectorXd& b) {
    return with_factors(mass,
                        [&](const auto& factors) { return Eigen::VectorXd(factors.solve(b)); });
}

#endif

}  // namespace detail

/// Eliminates the velocities: W = H^T M^-1 H, free_velocity = H^T M^-1 f + w. Throws input_error
/// unless the sizes agree and M can be factorised. Cost: one sparse Cholesky factor of M and a
/// solve per column of H; W is as sparse as M is block-diagonal.
template <int Rows, class Law>
AssembledProblem<Rows, Law> assembled(const GlobalProblem<Rows, Law>& p) {
    const auto require_size = [](const char* item, Eigen::Index size, Eigen::Index wanted) {
        if (size != wanted)
            throw input_error(std::string(item) + " is " + std::to_string(size) + ", but must be " +
                              std::to_string(wanted));
    };
    const auto contacts = static_cast<Eigen::Index>(p.contact_count());
    require_size("columns of M", p.mass.cols(), p.mass.rows());
    require_size("rows of H", p.contact_map.rows(), p.mass.rows());
    require_size("columns of H", p.contact_map.cols(), Rows * contacts);
    require_size("length of f", p.force.size(), p.mass.rows());
    require_size("number of laws", static_cast<Eigen::Index>(p.laws.size()), contacts);
    AssembledProblem<Rows, Law> result;
    result.laws = p.laws;
    result.free_velocity = p.velocity_offset;
    if (contacts == 0) return result;

    const auto [w, velocity] = detail::eliminated_velocities(p.mass, p.contact_map, p.force);
    std::vector<DelassusBlock<Rows>> blocks;
    for (Eigen::Index j = 0; j < w.outerSize(); ++j)
        for (Eigen::SparseMatrix<double>::InnerIterator entry(w, j); entry; ++entry) {
            DelassusBlock<Rows> block{static_cast<std::size_t>(entry.row() / Rows),
                                      static_cast<std::size_t>(j / Rows)};
            block.value(entry.row() % Rows, j % Rows) = entry.value();
            blocks.push_back(block);
        }
    result.delassus = DelassusSparse<Rows>(p.contact_count(), std::move(blocks));
    for (Eigen::Index i = 0; i < contacts; ++i)
        result.free_velocity[static_cast<std::size_t>(i)] +=
            velocity.template segment<Rows>(Rows * i);
    return result;
}

}  // namespace talus
