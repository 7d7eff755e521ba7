// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/law/concepts.hpp>
#include <talus/problem/delassus_sparse.hpp>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace talus {

/// A contact problem given by its Delassus operator,  u = W r + free_velocity: what FCLib calls
/// local. W is used as it is, also where a file's is not exactly symmetric.
template <int Dim, ContactLaw<Dim> Law>
struct AssembledProblem {
    DelassusSparse<Dim> delassus;
    std::vector<Vector<Dim>> free_velocity;  ///< FCLib's q [m/s]
    std::vector<Law> laws;

    std::size_t contact_count() const { return free_velocity.size(); }
};

/// A contact problem of any mechanical system,  M v = H r + f,  u = H^T v + w: what FCLib calls
/// global.
template <int Dim, ContactLaw<Dim> Law>
struct GlobalProblem {
    Eigen::SparseMatrix<double> mass;          ///< M, square, symmetric positive definite
    Eigen::SparseMatrix<double> contact_map;   ///< H, Dim columns per contact, normal first
    Eigen::VectorXd force;                     ///< f: impulses of all but the contacts, M v_begin
                                               ///< included
    std::vector<Vector<Dim>> velocity_offset;  ///< w [m/s]
    std::vector<Law> laws;

    std::size_t contact_count() const { return velocity_offset.size(); }
};

/// Eliminates the velocities: W = H^T M^-1 H, free_velocity = H^T M^-1 f + w. Throws input_error
/// unless the sizes agree and M can be factorised. Cost: one sparse Cholesky factor of M and a
/// solve per column of H; W is as sparse as M is block-diagonal.
template <int Dim, class Law>
AssembledProblem<Dim, Law> assembled(const GlobalProblem<Dim, Law>& p) {
    const auto require_size = [](const char* item, Eigen::Index size, Eigen::Index wanted) {
        if (size != wanted)
            throw input_error(std::string(item) + " is " + std::to_string(size) + ", but must be " +
                              std::to_string(wanted));
    };
    const auto contacts = static_cast<Eigen::Index>(p.contact_count());
    require_size("columns of M", p.mass.cols(), p.mass.rows());
    require_size("rows of H", p.contact_map.rows(), p.mass.rows());
    require_size("columns of H", p.contact_map.cols(), Dim * contacts);
    require_size("length of f", p.force.size(), p.mass.rows());
    require_size("number of laws", static_cast<Eigen::Index>(p.laws.size()), contacts);
    AssembledProblem<Dim, Law> result;
    result.laws = p.laws;
    result.free_velocity = p.velocity_offset;
    if (contacts == 0) return result;

    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(p.mass);
    if (factor.info() != Eigen::Success)
        throw input_error("M is singular, but must be symmetric and positive definite");
    const Eigen::SparseMatrix<double> mobility = factor.solve(p.contact_map);
    const Eigen::SparseMatrix<double> w = p.contact_map.transpose() * mobility;
    const Eigen::VectorXd velocity = p.contact_map.transpose() * factor.solve(p.force);
    std::vector<DelassusBlock<Dim>> blocks;
    for (Eigen::Index j = 0; j < w.outerSize(); ++j)
        for (Eigen::SparseMatrix<double>::InnerIterator entry(w, j); entry; ++entry) {
            DelassusBlock<Dim> block{static_cast<std::size_t>(entry.row() / Dim),
                                     static_cast<std::size_t>(j / Dim)};
            block.value(entry.row() % Dim, j % Dim) = entry.value();
            blocks.push_back(block);
        }
    result.delassus = DelassusSparse<Dim>(p.contact_count(), std::move(blocks));
    for (Eigen::Index i = 0; i < contacts; ++i)
        result.free_velocity[static_cast<std::size_t>(i)] +=
            velocity.template segment<Dim>(Dim * i);
    return result;
}

}  // namespace talus
