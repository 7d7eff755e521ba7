// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/cross.hpp>
#include <talus/core/input.hpp>
#include <talus/law/any_law.hpp>
#include <talus/law/coulomb.hpp>
#include <talus/law/weighted_mean.hpp>
#include <talus/problem/contact_problem.hpp>
#include <talus/problem/matrix_problem.hpp>

#include <Eigen/LU>
#include <Eigen/SparseCore>

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace talus {

/// The Coulomb law that a law is, once restitution is in the free velocity; nothing if it is
/// another.
template <int Dim, class Law>
std::optional<Coulomb<Dim>> as_coulomb(const Law&) {
    return std::nullopt;
}
template <int Dim>
std::optional<Coulomb<Dim>> as_coulomb(const Coulomb<Dim>& law) {
    return law;
}
template <int Dim, class Inner>
std::optional<Coulomb<Dim>> as_coulomb(const WeightedMean<Dim, Inner>& law) {
    return as_coulomb<Dim>(law.law);
}
template <int Dim, class... Laws>
std::optional<Coulomb<Dim>> as_coulomb(const AnyLaw<Dim, Laws...>& law) {
    return std::visit([](const auto& l) { return as_coulomb<Dim>(l); }, law.law);
}

/// The same for every contact. Throws input_error naming the first law that is another.
template <int Dim, class Laws>
std::vector<Coulomb<Dim>> coulomb_laws(const Laws& laws) {
    std::vector<Coulomb<Dim>> result;
    result.reserve(laws.size());
    for (const auto& law : laws) {
        const auto coulomb = as_coulomb<Dim>(law);
        if (!coulomb)
            throw input_error("law of contact " + std::to_string(result.size()) +
                              " is another, but must be Coulomb's");
        result.push_back(*coulomb);
    }
    return result;
}

namespace detail {

/// First row of each body in the matrices of a global problem: its translations, and its rotations;
/// -1 where impulses do not move it.
struct BodyRows {
    std::vector<Eigen::Index> linear, angular;
    Eigen::Index count = 0;
};

template <int Dim>
BodyRows body_rows(const InverseMass<Dim>& m) {
    BodyRows rows;
    for (std::size_t k = 0; k < m.free_axes.size(); ++k)
        if (m.free_axes[k] != Vector<Dim>::Ones())
            throw input_error(numbered("body", k) +
                              " has locked axes, but bodies of a problem file must have none");
    for (std::size_t k = 0; k < m.body_count(); ++k) {
        const bool translates = m.linear[k] != 0.0, rotates = !m.angular[k].isZero(0.0);
        rows.linear.push_back(translates ? rows.count : -1);
        if (translates) rows.count += Dim;
        rows.angular.push_back(rotates ? rows.count : -1);
        if (rotates) rows.count += rotation_dof<Dim>;
    }
    return rows;
}

/// Condition number from which an inverse inertia counts as singular: its inverse would keep less
/// than four digits.
inline constexpr double worst_condition = 1e12;

template <class Block>
void add_block(std::vector<Eigen::Triplet<double>>& entries, Eigen::Index row, Eigen::Index column,
               const Block& block) {
    for (Eigen::Index j = 0; j < block.cols(); ++j)
        for (Eigen::Index i = 0; i < block.rows(); ++i)
            if (block(i, j) != 0.0)
                entries.emplace_back(static_cast<int>(row + i), static_cast<int>(column + j),
                                     block(i, j));
}

template <int Dim>
Eigen::SparseMatrix<double> mass_matrix(const InverseMass<Dim>& m, const BodyRows& rows) {
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t k = 0; k < m.body_count(); ++k) {
        if (rows.linear[k] >= 0)
            add_block(entries, rows.linear[k], rows.linear[k],
                      Matrix<Dim>(Matrix<Dim>::Identity() / m.linear[k]));
        if (rows.angular[k] < 0) continue;
        const AngularMatrix<Dim> inertia = m.angular[k].inverse();
        // Written so that a product that is not a number is refused.
        if (!(m.angular[k].norm() * inertia.norm() < worst_condition))
            throw input_error("inverse inertia of body " + std::to_string(k) +
                              " is singular, but must be zero or invertible");
        add_block(entries, rows.angular[k], rows.angular[k],
                  AngularMatrix<Dim>(0.5 * (inertia + inertia.transpose())));
    }
    Eigen::SparseMatrix<double> mass(rows.count, rows.count);
    mass.setFromTriplets(entries.begin(), entries.end());
    return mass;
}

template <int Dim>
Eigen::SparseMatrix<double> contact_map(const ContactJacobian<Dim>& jacobian,
                                        const BodyRows& rows) {
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t c = 0; c < jacobian.contact_count(); ++c) {
        const auto column = static_cast<Eigen::Index>(Dim * c);
        const Matrix<Dim> axes = jacobian.frame[c].transpose();
        const auto side = [&](BodyIndex body, const Vector<Dim>& arm, double sign) {
            const auto k = static_cast<std::size_t>(body);
            if (rows.linear[k] >= 0)
                add_block(entries, rows.linear[k], column, Matrix<Dim>(sign * axes));
            if (rows.angular[k] >= 0)
                add_block(entries, rows.angular[k], column,
                          (sign * moment_matrix<Dim>(arm) * axes).eval());
        };
        side(jacobian.a[c], jacobian.arm_a[c], 1.0);
        side(jacobian.b[c], jacobian.arm_b[c], -1.0);
    }
    const auto columns = static_cast<Eigen::Index>(Dim * jacobian.contact_count());
    Eigen::SparseMatrix<double> map(rows.count, columns);
    map.setFromTriplets(entries.begin(), entries.end());
    return map;
}

}  // namespace detail

/// A contact problem of rigid bodies in global form. The rows of M and H are, body by body, the
/// translations and the rotations that impulses can change, in world axes; obstacles have none.
/// f = 0 and w = free_velocity, so that v is what the impulses add to the bodies' velocities.
/// Throws input_error on a law that is not Coulomb's and on an inverse inertia that is singular but
/// not zero.
template <int Dim, class Law>
GlobalProblem<Dim, Coulomb<Dim>> global_form(const ContactProblem<Dim, Law>& p) {
    const auto rows = detail::body_rows(p.inverse_mass);
    p.jacobian.require_imposed_cell("a problem file");
    return {detail::mass_matrix(p.inverse_mass, rows), detail::contact_map(p.jacobian, rows),
            Eigen::VectorXd::Zero(rows.count), p.free_velocity, coulomb_laws<Dim>(p.laws)};
}

}  // namespace talus
