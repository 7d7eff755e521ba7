// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/instantiate.hpp>
#include <talus/core/types.hpp>
#include <talus/linear/bicgstab.hpp>
#include <talus/linear/block_ilu.hpp>
#include <talus/solver/cones/cone_system.hpp>

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace talus {

/// (W + D) x = b of a ConeSystem without factors: Bicgstab with BlockIlu, in memory that grows with
/// the number of contacts alone. Where only the blocks of W are known, W + D is iterated on. Where
/// bodies are, it is y of
///   (1 + B D^-1 B^T) y = B D^-1 b,  x = D^-1 (b - B^T y),
/// whose matrix has a block per body; a residual s there is B^T s in contact space. Where D is so
/// small that rounding hides it, the rest of the path is iterated in contact space, preconditioned
/// by the same formula with a D that is not smaller than rounding allows: three times as dear.
/// Before that, the incomplete factors (not the products) see a D with less coupling of normal and
/// tangent where contacts slip: in large systems those of D itself break down.
template <int Dim>
class KrylovConeSolver {
  public:
    using Vec = Eigen::VectorXd;

    /// To be called when the system was given another problem.
    void analyze(const ConeSystem<Dim>& system);
    /// Takes D and makes the preconditioner. False if that fails.
    bool prepare(const ConeSystem<Dim>& system, std::span<const Matrix<Dim>> d);
    /// Improves x until |b - (W + D) x| <= tolerance [sqrt(J)]; false if that is not reached in
    /// `max_iterations`.
    bool solve(const ConeSystem<Dim>& system, const Vec& b, Vec& x, double tolerance,
               int max_iterations);
    /// Iterations of all solves since `analyze`.
    long iteration_count() const { return iteration_count_; }

  private:
    static constexpr int dof = twist_dof<Dim>;
    using Small = Matrix<Dim>;
    using Piece = Eigen::Matrix<double, dof, Dim>;

    static Eigen::Index first(std::size_t c) { return static_cast<Eigen::Index>(Dim * c); }
    static std::size_t index(int i) { return static_cast<std::size_t>(i); }
    /// W + D, preconditioned in body space.
    struct Exact {
        KrylovConeSolver& solver;
        const ConeSystem<Dim>& system;
        void multiply(const Vec& x, Vec& y) const { solver.multiply(system, x, y); }
        void precondition(Vec& x) const {
            solver.to_bodies(x, solver.right_);
            solver.body_matrix_.precondition(solver.right_);
            solver.from_bodies(solver.right_, x);
        }
    };
    void cut_up(const BodyMap<Dim>& map);
    bool factorize(const ConeSystem<Dim>& system);
    void add(std::size_t c, const Small& inverse);
    static bool temper(Small& d);
    void to_bodies(const Vec& e, Vec& v) const;
    void from_bodies(const Vec& v, Vec& e) const;
    void multiply(const ConeSystem<Dim>& system, const Vec& x, Vec& y) const;
    bool improve(const ConeSystem<Dim>& system, const Vec& b, Vec& x, double tolerance, long limit);

    bool in_body_space_ = false;
    int nodes_ = 0;
    std::vector<std::pair<int, int>> edges_, last_edges_;
    // Body space: B in pieces of the rows of a rigid body. Bodies of fewer rows are filled up with
    // zeros, larger ones have several pieces.
    std::vector<std::size_t> piece_begin_;
    std::vector<int> node_;
    std::vector<Piece> piece_;
    BlockIlu<dof> body_matrix_;
    BlockIlu<Dim> contact_matrix_;
    std::vector<std::size_t> slot_begin_, slots_;  ///< of what each contact adds to the matrix
    std::vector<Small> d_, d_inverse_;
    std::vector<std::pair<std::size_t, Small>> tempered_;  ///< inverses that the factors see
    Bicgstab bicgstab_;
    bool rounding_ = false;  ///< has been met in body space
    Vec error_, right_, y_, start_;
    long iteration_count_ = 0;
};

template <int Dim>
void KrylovConeSolver<Dim>::cut_up(const BodyMap<Dim>& map) {
    std::vector<int> begin;
    nodes_ = 0;
    for (const int rows : map.body_sizes()) {
        begin.push_back(nodes_);
        nodes_ += (rows + dof - 1) / dof;
    }
    piece_begin_.assign(1, 0);
    node_.clear();
    piece_.clear();
    for (std::size_t c = 0; c < map.contact_count(); ++c) {
        for (const auto& e : map.entries(c)) {
            const auto block = map.block(e);
            // A body of more rows than a rigid one, as in a global problem, becomes several nodes.
            int node = begin[index(e.body)];
            for (Eigen::Index row = 0; row < block.rows(); row += dof, ++node) {
                const auto rows = std::min<Eigen::Index>(dof, block.rows() - row);
                piece_.push_back(Piece::Zero());
                piece_.back().topRows(rows) = block.middleRows(row, rows);
                node_.push_back(node);
            }
        }
        piece_begin_.push_back(piece_.size());
    }
}

template <int Dim>
void KrylovConeSolver<Dim>::analyze(const ConeSystem<Dim>& system) {
    iteration_count_ = 0;
    rounding_ = false;
    const std::size_t n = system.contact_count();
    const bool was_in_body_space = std::exchange(in_body_space_, system.bodies() != nullptr);
    const int last_nodes = nodes_;
    edges_.clear();
    if (in_body_space_) {
        cut_up(*system.bodies());
    } else {
        nodes_ = static_cast<int>(n);
    }
    // f(i, j) for all blocks that a contact adds to.
    const auto for_blocks = [&](std::size_t c, auto&& f) {
        if (!in_body_space_) {
            for (const std::size_t j : system.columns(c))
                f(static_cast<int>(c), static_cast<int>(j));
            return;
        }
        for (std::size_t i = piece_begin_[c]; i < piece_begin_[c + 1]; ++i)
            for (std::size_t j = piece_begin_[c]; j < piece_begin_[c + 1]; ++j)
                f(node_[i], node_[j]);
    };
    for (std::size_t c = 0; c < n; ++c)
        for_blocks(c, [&](int i, int j) {
            if (i != j) edges_.emplace_back(i, j);
        });
    const bool same = was_in_body_space == in_body_space_ && last_nodes == nodes_ &&
                      edges_ == last_edges_ && !slot_begin_.empty();
    if (!same) {
        if (in_body_space_)
            body_matrix_.analyze(nodes_, edges_);
        else
            contact_matrix_.analyze(nodes_, edges_);
        last_edges_ = edges_;
    }
    slot_begin_.assign(1, 0);
    slots_.clear();
    for (std::size_t c = 0; c < n; ++c) {
        for_blocks(c, [&](int i, int j) {
            slots_.push_back(in_body_space_ ? body_matrix_.slot(i, j) : contact_matrix_.slot(i, j));
        });
        slot_begin_.push_back(slots_.size());
    }
}

template <int Dim>
bool KrylovConeSolver<Dim>::prepare(const ConeSystem<Dim>& system, std::span<const Matrix<Dim>> d) {
    d_.assign(d.begin(), d.end());
    return factorize(system);
}

template <int Dim>
bool KrylovConeSolver<Dim>::factorize(const ConeSystem<Dim>& system) {
    if (!in_body_space_) {
        contact_matrix_.set_zero();
        for (std::size_t c = 0; c < d_.size(); ++c) {
            const auto columns = system.columns(c);
            for (std::size_t k = 0; k < columns.size(); ++k) {
                auto& to = contact_matrix_.block(slots_[slot_begin_[c] + k]);
                to += system.row_block(c, k);
                if (columns[k] == c) to += d_[c];
            }
        }
        return contact_matrix_.factorize();
    }
    body_matrix_.set_zero();
    for (int k = 0; k < nodes_; ++k) body_matrix_.block(body_matrix_.slot(k, k)).setIdentity();
    // D enters by its inverse: contacts that are rigid in the limit (D -> 0) have the largest
    // blocks, and rounding of the product B D^-1 B^T then hides all others.
    d_inverse_.resize(d_.size());
    tempered_.clear();
    for (std::size_t c = 0; c < d_.size(); ++c) {
        // W has the trace Dim at each contact.
        constexpr double least = 1e-8;
        Small seen = d_[c];
        if (rounding_) seen.diagonal().array() += least;
        d_inverse_[c] = seen.inverse();
        if (!rounding_ && temper(seen))
            tempered_.emplace_back(c, seen.inverse());
        else
            add(c, d_inverse_[c]);
    }
    // First what the factors may see, then, with the factors made, what the products must.
    for (const auto& [c, inverse] : tempered_) add(c, inverse);
    if (!body_matrix_.factorize()) return false;
    for (const auto& [c, inverse] : tempered_) add(c, d_inverse_[c] - inverse);
    return true;
}

/// Adds B_c inverse B_c^T.
template <int Dim>
void KrylovConeSolver<Dim>::add(std::size_t c, const Small& inverse) {
    std::size_t slot = slot_begin_[c];
    for (std::size_t i = piece_begin_[c]; i < piece_begin_[c + 1]; ++i) {
        const Piece left = piece_[i] * inverse;
        for (std::size_t j = piece_begin_[c]; j < piece_begin_[c + 1]; ++j)
            body_matrix_.block(slots_[slot++]).noalias() += left * piece_[j].transpose();
    }
}

/// Cuts s of D = (a 0; s T) down to what leaves D + D^T positive definite; false if it is.
template <int Dim>
bool KrylovConeSolver<Dim>::temper(Small& d) {
    // With the symmetric part positive definite, incomplete factors exist in practice. Needed:
    // s^T T^-1 s <= 4 a.
    const Eigen::Matrix<double, Dim - 1, 1> s = d.template bottomLeftCorner<Dim - 1, 1>();
    const Eigen::Matrix<double, Dim - 1, Dim - 1> t =
        d.template bottomRightCorner<Dim - 1, Dim - 1>();
    const double square = s.dot(t.inverse() * s);
    if (!(square > 4.0 * d(0, 0))) return false;
    d.template bottomLeftCorner<Dim - 1, 1>() *= std::sqrt(4.0 * d(0, 0) / square);
    return true;
}

/// v = B D^-1 e.
template <int Dim>
void KrylovConeSolver<Dim>::to_bodies(const Vec& e, Vec& v) const {
    v.setZero(dof * nodes_);
    for (std::size_t c = 0; c < d_.size(); ++c) {
        const Vector<Dim> moved = d_inverse_[c] * e.template segment<Dim>(first(c));
        for (std::size_t i = piece_begin_[c]; i < piece_begin_[c + 1]; ++i)
            v.template segment<dof>(dof * node_[i]).noalias() += piece_[i] * moved;
    }
}

/// e := D^-1 (e - B^T v).
template <int Dim>
void KrylovConeSolver<Dim>::from_bodies(const Vec& v, Vec& e) const {
    for (std::size_t c = 0; c < d_.size(); ++c) {
        Vector<Dim> left = e.template segment<Dim>(first(c));
        for (std::size_t i = piece_begin_[c]; i < piece_begin_[c + 1]; ++i)
            left.noalias() -= piece_[i].transpose() * v.template segment<dof>(dof * node_[i]);
        e.template segment<Dim>(first(c)).noalias() = d_inverse_[c] * left;
    }
}

template <int Dim>
void KrylovConeSolver<Dim>::multiply(const ConeSystem<Dim>& system, const Vec& x, Vec& y) const {
    system.multiply(x, y);
    for (std::size_t c = 0; c < d_.size(); ++c)
        y.template segment<Dim>(first(c)).noalias() += d_[c] * x.template segment<Dim>(first(c));
}

template <int Dim>
bool KrylovConeSolver<Dim>::solve(const ConeSystem<Dim>& system, const Vec& b, Vec& x,
                                  double tolerance, int max_iterations) {
    const long limit = iteration_count_ + max_iterations;
    if (in_body_space_ && !rounding_) {
        start_ = x;
        // Half of what is allowed, as the other way may be needed from the start.
        const long half = iteration_count_ + (max_iterations + 1) / 2;
        if (improve(system, b, x, tolerance, half)) return true;
        // For the rest of the path: D shrinks with every step, and rounding does not go away.
        rounding_ = true;
        if (!factorize(system)) return false;
        x = start_;
    }
    return improve(system, b, x, tolerance, limit);
}

template <int Dim>
bool KrylovConeSolver<Dim>::improve(const ConeSystem<Dim>& system, const Vec& b, Vec& x,
                                    double tolerance, long limit) {
    // Each begins with the true error: rounding, and what was lost on the way.
    constexpr int most_begins = 6;
    for (int k = 0; k < most_begins; ++k) {
        multiply(system, x, error_);
        error_ = b - error_;
        const double size = error_.norm();
        if (!std::isfinite(size)) return false;
        if (size <= tolerance) return true;
        const int left = static_cast<int>(limit - iteration_count_);
        if (left <= 0) return false;
        if (!in_body_space_) {
            iteration_count_ += bicgstab_.solve(contact_matrix_, error_, y_, 0.9 * tolerance, left);
            x += y_;
        } else if (rounding_) {
            const Exact matrix{*this, system};
            iteration_count_ += bicgstab_.solve(matrix, error_, y_, 0.9 * tolerance, left);
            x += y_;
        } else {
            to_bodies(error_, right_);
            // B^T s is a few times s.
            iteration_count_ += bicgstab_.solve(body_matrix_, right_, y_, 0.4 * tolerance, left);
            from_bodies(y_, error_);
            x += error_;
        }
    }
    return false;
}

}  // namespace talus

TALUS_IN_PLANE(class talus::KrylovConeSolver<2>)
TALUS_IN_SPACE(class talus::KrylovConeSolver<3>)
