// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/check.hpp>
#include <talus/core/input.hpp>
#include <talus/core/instantiate.hpp>
#include <talus/core/model.hpp>
#include <talus/problem/concepts.hpp>
#include <talus/problem/contact_problem.hpp>
#include <talus/problem/islands.hpp>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <string>
#include <tuple>
#include <vector>

namespace talus {

/// One block of W, for building a DelassusSparse from blocks.
template <int Rows>
struct DelassusBlock {
    std::size_t row = 0;
    std::size_t column = 0;
    Matrix<Rows> value = Matrix<Rows>::Zero();  ///< W_row,column [1/kg]
};

/// W = H^T M^-1 H assembled: blocks W_ij in compressed rows, columns ascending, for contacts that
/// share a body that moves. Storage: Rows^2 numbers per pair of neighbours (some ten per contact in
/// a packing, but the square of its contacts for a large body).
template <int Rows>
requires ContactRows<Rows>
class DelassusSparse {
  public:
    DelassusSparse() = default;
    /// Of rigid bodies, for the rows of space.
    template <int Dim>
    requires(Dim == Rows)
        DelassusSparse(const ContactJacobian<Dim>& jacobian, const InverseMass<Dim>& inverse_mass) {
        assemble(jacobian, inverse_mass);
    }
    /// From any blocks: those of equal place are summed, every row has a diagonal block (zero if
    /// none is given). The caller sees to symmetry. Throws input_error on an index not below `n`.
    DelassusSparse(std::size_t n, std::vector<DelassusBlock<Rows>> blocks) {
        for (const auto& block : blocks)
            if (std::max(block.row, block.column) >= n)
                throw input_error("index of a Delassus block is " +
                                  std::to_string(std::max(block.row, block.column)) +
                                  ", but must be below " + std::to_string(n));
        for (std::size_t i = 0; i < n; ++i) blocks.push_back({i, i, Matrix<Rows>::Zero()});
        compress(n, blocks);
    }
    /// In place of what there is: W of n contacts, `block(i, j)` being W_ij. Blocks off the
    /// diagonal that are zero are not stored. Asks for all n^2 blocks, so it is for systems whose
    /// contacts are few; allocates only for more blocks than ever before.
    template <class Block>
    void fill(std::size_t n, const Block& block) {
        row_begin_.assign(1, 0);
        column_.clear();
        value_.clear();
        diagonal_.clear();
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = 0; j < n; ++j) {
                const Matrix<Rows> w = block(i, j);
                if (i != j && w.is_zero()) continue;
                if (i == j) diagonal_.push_back(value_.size());
                column_.push_back(j);
                value_.push_back(w);
            }
            row_begin_.push_back(value_.size());
        }
    }

    std::size_t contact_count() const { return diagonal_.size(); }
    std::size_t block_count() const { return value_.size(); }
    /// Columns of the blocks of row i, ascending, and the blocks.
    std::span<const std::size_t> columns(std::size_t i) const {
        return std::span(column_).subspan(row_begin_[i], row_begin_[i + 1] - row_begin_[i]);
    }
    std::span<const Matrix<Rows>> blocks(std::size_t i) const {
        return std::span(value_).subspan(row_begin_[i], row_begin_[i + 1] - row_begin_[i]);
    }
    Matrix<Rows> diagonal_block(std::size_t i) const { return value_[diagonal_[i]]; }

    /// u = W r.
    void multiply(std::span<const Vector<Rows>> r, std::span<Vector<Rows>> u) const {
        TALUS_CHECK(r.size() == contact_count(), "one impulse per contact");
        for (std::size_t i = 0; i < contact_count(); ++i) u[i] = row_times(i, r);
    }
    /// Writes to label[i] a number below contact_count() that contact i shares with those that
    /// chains of blocks which are not zero connect with it, and with no other. Not for concurrent
    /// use of one operator.
    void islands(std::span<std::uint32_t> label) const {
        islands_.reset(contact_count());
        for (std::size_t i = 0; i < contact_count(); ++i)
            for (std::size_t k = row_begin_[i]; k < row_begin_[i + 1]; ++k)
                if (!value_[k].is_zero()) islands_.join(i, column_[k]);
        for (std::size_t i = 0; i < contact_count(); ++i) label[i] = islands_.root(i);
    }
    /// Takes the impulses in.
    void start(std::span<const Vector<Rows>> r) {
        TALUS_CHECK(r.size() == contact_count(), "one impulse per contact");
        impulse_.assign(r.begin(), r.end());
    }
    /// Row i of W r for the present impulses [m/s]. Cost: the neighbours of contact i.
    Vector<Rows> velocity(std::size_t i) const {
        return row_times(i, std::span<const Vector<Rows>>(impulse_));
    }
    /// r_i += dr.
    void add(std::size_t i, const Vector<Rows>& dr) { impulse_[i] += dr; }

  private:
    Vector<Rows> row_times(std::size_t i, std::span<const Vector<Rows>> r) const {
        Vector<Rows> u = Vector<Rows>::Zero();
        for (std::size_t k = row_begin_[i]; k < row_begin_[i + 1]; ++k)
            u += value_[k] * r[column_[k]];
        return u;
    }

    /// H_ik^T restricted to body k: velocity of the contact per twist of the body.
    template <int Dim>
    static SmallMatrix<Dim, twist_dof<Dim>> velocity_map(const ContactJacobian<Dim>& jacobian,
                                                         std::size_t contact, BodyIndex body) {
        SmallMatrix<Dim, twist_dof<Dim>> map;
        const auto side = [&](const Vector<Dim>& arm, double sign) {
            map.template leftCols<Dim>() += sign * jacobian.frame[contact];
            map.template rightCols<rotation_dof<Dim>>() +=
                sign * jacobian.frame[contact] * moment_matrix<Dim>(arm).transpose();
        };
        if (jacobian.a[contact] == body) side(jacobian.arm_a[contact], 1.0);
        if (jacobian.b[contact] == body) side(jacobian.arm_b[contact], -1.0);
        return map;
    }

    template <int Dim>
    void assemble(const ContactJacobian<Dim>& jacobian, const InverseMass<Dim>& inverse_mass);
    void compress(std::size_t n, const std::vector<DelassusBlock<Rows>>& blocks);

    std::vector<std::size_t> row_begin_;
    std::vector<std::size_t> column_;
    std::vector<Matrix<Rows>> value_;
    std::vector<std::size_t> diagonal_;  ///< place of W_ii in value_
    std::vector<Vector<Rows>> impulse_;
    mutable Islands islands_;
};

template <int Rows>
requires ContactRows<Rows>
template <int Dim>
void DelassusSparse<Rows>::assemble(const ContactJacobian<Dim>& jacobian,
                                    const InverseMass<Dim>& inverse_mass) {
    jacobian.require_imposed_cell("W assembled");
    std::vector<std::vector<std::size_t>> contacts_of(inverse_mass.body_count());
    for (std::size_t i = 0; i < jacobian.contact_count(); ++i) {
        contacts_of[static_cast<std::size_t>(jacobian.a[i])].push_back(i);
        if (jacobian.b[i] != jacobian.a[i])
            contacts_of[static_cast<std::size_t>(jacobian.b[i])].push_back(i);
    }
    std::vector<DelassusBlock<Dim>> blocks;
    for (std::size_t i = 0; i < jacobian.contact_count(); ++i)
        blocks.push_back({i, i, Matrix<Dim>::Zero()});
    for (std::size_t k = 0; k < contacts_of.size(); ++k) {
        if (inverse_mass.linear[k] == 0.0 && inverse_mass.angular[k].is_zero()) continue;
        Matrix<twist_dof<Dim>> mobility;
        for (int d = 0; d < Dim; ++d) mobility(d, d) = inverse_mass.translation(k)[d];
        mobility.template bottomRightCorner<rotation_dof<Dim>, rotation_dof<Dim>>() =
            inverse_mass.angular[k];
        const auto body = static_cast<BodyIndex>(k);
        for (const std::size_t i : contacts_of[k])
            for (const std::size_t j : contacts_of[k])
                blocks.push_back({i, j,
                                  velocity_map(jacobian, i, body) * mobility *
                                      velocity_map(jacobian, j, body).transpose()});
    }
    compress(jacobian.contact_count(), blocks);
}

/// Sorts blocks into rows and sums those of equal place, in the order they came.
template <int Rows>
requires ContactRows<Rows>
void DelassusSparse<Rows>::compress(std::size_t n, const std::vector<DelassusBlock<Rows>>& blocks) {
    // The order is sorted, not the blocks: the buffer of a stable sort would not keep the
    // alignment that vectors of the processor's full width ask for.
    std::vector<std::size_t> order(blocks.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t x, std::size_t y) {
        return std::tie(blocks[x].row, blocks[x].column, x) <
               std::tie(blocks[y].row, blocks[y].column, y);
    });
    row_begin_.assign(n + 1, 0);
    diagonal_.assign(n, 0);
    for (std::size_t k = 0; k < order.size(); ++k) {
        const auto& block = blocks[order[k]];
        if (k > 0) {
            const auto& last = blocks[order[k - 1]];
            if (last.row == block.row && last.column == block.column) {
                value_.back() += block.value;
                continue;
            }
        }
        if (block.row == block.column) diagonal_[block.row] = value_.size();
        value_.push_back(block.value);
        column_.push_back(block.column);
        row_begin_[block.row + 1] = value_.size();
    }
}

TALUS_MODEL(SweepableDelassus<DelassusSparse<2>, 2>);
TALUS_MODEL(SweepableDelassus<DelassusSparse<3>, 3>);
TALUS_MODEL(SweepableDelassus<DelassusSparse<5>, 5>);

}  // namespace talus

TALUS_IN_PLANE(class talus::DelassusSparse<2>)
TALUS_IN_SPACE(class talus::DelassusSparse<3>)
TALUS_IN_PLANE(void talus::DelassusSparse<2>::assemble(const ContactJacobian<2>&,
                                                       const InverseMass<2>&))
TALUS_IN_SPACE(void talus::DelassusSparse<3>::assemble(const ContactJacobian<3>&,
                                                       const InverseMass<3>&))
