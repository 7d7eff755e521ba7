// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/cross.hpp>
#include <talus/problem/concepts.hpp>
#include <talus/problem/contact_problem.hpp>

#include <Eigen/Core>
#include <boost/test/unit_test.hpp>

#include <vector>

#include "common/random_blocks.hpp"

/// W as one dense matrix from H and M written out in full: the plain twin of all Delassus
/// operators.
template <int Dim>
Eigen::MatrixXd dense_delassus(const talus::ContactJacobian<Dim>& jacobian,
                               const talus::InverseMass<Dim>& inverse_mass) {
    constexpr int dof = talus::twist_dof<Dim>;
    const auto contacts = static_cast<Eigen::Index>(jacobian.contact_count());
    const auto bodies = static_cast<Eigen::Index>(inverse_mass.body_count());
    Eigen::MatrixXd h = Eigen::MatrixXd::Zero(contacts * Dim, bodies * dof);
    Eigen::MatrixXd m = Eigen::MatrixXd::Zero(bodies * dof, bodies * dof);
    for (Eigen::Index k = 0; k < bodies; ++k) {
        const auto body = static_cast<std::size_t>(k);
        m.block<Dim, Dim>(k * dof, k * dof) =
            inverse_mass.linear[body] * talus::Matrix<Dim>::Identity();
        if (!inverse_mass.free_axes.empty())
            for (int d = 0; d < Dim; ++d)
                m(k * dof + d, k * dof + d) *= inverse_mass.free_axes[body][d];
        m.block<dof - Dim, dof - Dim>(k * dof + Dim, k * dof + Dim) = inverse_mass.angular[body];
    }
    for (Eigen::Index i = 0; i < contacts; ++i) {
        const auto c = static_cast<std::size_t>(i);
        const auto side = [&](Eigen::Index body, const talus::Vector<Dim>& arm, double sign) {
            for (int axis = 0; axis < dof; ++axis) {
                const talus::Vector<Dim> moved =
                    axis < Dim
                        ? talus::Vector<Dim>(talus::Vector<Dim>::Unit(axis % Dim))
                        : talus::cross<Dim>(
                              talus::AngularVector<Dim>::Unit(axis < Dim ? 0 : axis - Dim), arm);
                h.block<Dim, 1>(i * Dim, body * dof + axis) += sign * jacobian.frame[c] * moved;
            }
        };
        side(jacobian.a[c], jacobian.arm_a[c], 1.0);
        side(jacobian.b[c], jacobian.arm_b[c], -1.0);
    }
    if (jacobian.cell_lever.empty()) return h * m * h.transpose();
    // The components of the velocity gradient, column by column.
    Eigen::MatrixXd cell = Eigen::MatrixXd::Zero(contacts * Dim, Dim * Dim);
    Eigen::VectorXd mobility(Dim * Dim);
    for (int j = 0; j < Dim; ++j)
        for (int i = 0; i < Dim; ++i) {
            mobility[Dim * j + i] = inverse_mass.cell(i, j);
            for (Eigen::Index c = 0; c < contacts; ++c) {
                const auto k = static_cast<std::size_t>(c);
                talus::Matrix<Dim> rate = talus::Matrix<Dim>::Zero();
                rate(i, j) = 1.0;
                cell.block<Dim, 1>(c * Dim, Dim * j + i) =
                    -1.0 * (jacobian.frame[k] * (rate * jacobian.cell_lever[k]));
            }
        }
    return h * m * h.transpose() + cell * mobility.asDiagonal() * cell.transpose();
}

/// Properties of every SweepableDelassus of `n` contacts, against the dense matrix.
template <int Dim, talus::SweepableDelassus<Dim> W>
void test_delassus(W& w, const Eigen::MatrixXd& dense, RandomBlocks& random) {
    constexpr double rounding = 1e-13;  // of sums of some hundred products
    using Vec = talus::Vector<Dim>;
    const std::size_t n = w.contact_count();
    BOOST_REQUIRE(static_cast<Eigen::Index>(n) * Dim == dense.rows());
    const auto stacked = [&](const std::vector<Vec>& x) {
        Eigen::VectorXd all(dense.rows());
        for (std::size_t i = 0; i < n; ++i)
            all.segment<Dim>(static_cast<Eigen::Index>(i) * Dim) = x[i];
        return all;
    };
    std::vector<Vec> r(n), s(n), u(n), v(n);
    for (std::size_t i = 0; i < n; ++i) {
        r[i] = random.normal<Dim>();
        s[i] = random.normal<Dim>();
    }
    w.multiply(r, u);
    w.multiply(s, v);
    const double scale = dense.norm() * stacked(r).norm();
    BOOST_TEST((stacked(u) - dense * stacked(r)).norm() <= rounding * scale);
    BOOST_TEST(std::abs(stacked(u).dot(stacked(s)) - stacked(v).dot(stacked(r))) <=
               rounding * scale * stacked(s).norm());

    w.start(r);
    for (std::size_t i = 0; i < n; ++i) {
        const auto k = static_cast<Eigen::Index>(i) * Dim;
        BOOST_TEST((w.diagonal_block(i) - dense.block<Dim, Dim>(k, k)).norm() <=
                   rounding * dense.norm());
        w.add(i, s[i] - r[i]);
    }
    for (std::size_t i = 0; i < n; ++i)
        BOOST_TEST((w.velocity(i) - v[i]).norm() <=
                   rounding * dense.norm() * (stacked(r).norm() + stacked(s).norm()));
}
