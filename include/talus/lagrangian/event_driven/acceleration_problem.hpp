// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace talus {

/// What a contact does in a smooth phase.
enum class ContactMode {
    open,     ///< apart, without a force
    sliding,  ///< closed, the tangential force -mu r_n times the direction of its slip
    sticking  ///< closed, without any relative acceleration
};

/// The problem on accelerations of contacts that are closed and stay so for an instant,
///
///   a = W r + b ,   a the relative acceleration [m/s^2], r the force [N], row by row:
///
/// a_n >= 0, r_n >= 0, a_n r_n = 0; friction by the slip there is or, at rest, by that to come.
struct AccelerationProblem {
    Eigen::Index rows = 2;   ///< of a contact, normal first
    Eigen::MatrixXd w;       ///< G A^-1 G^T [1/kg]
    Eigen::VectorXd b;       ///< relative accelerations without contact forces [m/s^2]
    std::vector<double> mu;  ///< by contact [-]
    Eigen::MatrixXd slip;    ///< by contact a column, direction of its slip; zero at rest

    std::size_t contact_count() const { return mu.size(); }
    Eigen::Index row(std::size_t k) const { return static_cast<Eigen::Index>(k) * rows; }
    Eigen::Index column(std::size_t k) const { return static_cast<Eigen::Index>(k); }
    bool slides(std::size_t k) const { return !slip.col(column(k)).isZero(0.0); }
};

/// Modes of the contacts of such a problem, with directions for those that slide. A contact without
/// friction slides, whatever its direction.
struct ContactModes {
    std::vector<ContactMode> mode;
    Eigen::MatrixXd slip;  ///< by contact a column

    bool closed(std::size_t k) const { return mode[k] != ContactMode::open; }
};

/// Forces and accelerations for given modes: a linear system. Keeps its memory.
class ModeSystem {
  public:
    Eigen::VectorXd force;         ///< row by row [N]
    Eigen::VectorXd acceleration;  ///< W r + b [m/s^2]
    /// The determinant over that of the same contacts alone and without friction [-]: where it
    /// goes to zero in a motion, forces go to infinity (Painleve). 1 if nothing is closed.
    double determinant = 1.0;
    /// Contacts are redundant: there are several forces, or none; `force` is the least.
    bool singular = false;

    /// Solves  a_n = 0 of contacts that slide, a = 0 of those that stick.
    void solve(const AccelerationProblem& p, const ContactModes& modes) {
        equations_.clear();
        for (std::size_t k = 0; k < p.contact_count(); ++k) {
            if (!modes.closed(k)) continue;
            const Eigen::Index more = modes.mode[k] == ContactMode::sticking ? p.rows : 1;
            for (Eigen::Index i = 0; i < more; ++i) equations_.push_back(p.row(k) + i);
        }
        const auto size = static_cast<Eigen::Index>(equations_.size());
        directions(p, modes);
        columns_.noalias() = p.w * directions_;
        matrix_.resize(size, size);
        right_.resize(size);
        for (Eigen::Index i = 0; i < size; ++i) {
            const Eigen::Index row = equations_[static_cast<std::size_t>(i)];
            matrix_.row(i) = columns_.row(row);
            right_[i] = -p.b[row];
        }
        solve_equations(p);
        force.noalias() = directions_ * unknown_;
        acceleration.noalias() = columns_ * unknown_;
        acceleration += p.b;
    }

    /// What rounding may leave of accelerations and of forces, here and of the last solve.
    double acceleration_rounding(const AccelerationProblem& p) const {
        return relative * std::max(p.b.lpNorm<Eigen::Infinity>(),
                                   (acceleration - p.b).lpNorm<Eigen::Infinity>());
    }
    double force_rounding(const AccelerationProblem& p) const {
        if (p.contact_count() == 0) return 0.0;
        const double least = p.b.lpNorm<Eigen::Infinity>() / p.w.diagonal().maxCoeff();
        return relative * std::max(least, force.lpNorm<Eigen::Infinity>());
    }
    /// Whether what was solved obeys its equations (which redundant contacts may not be able to).
    bool consistent(const AccelerationProblem& p) const {
        const double most = acceleration_rounding(p);
        for (const Eigen::Index row : equations_)
            if (!(std::abs(acceleration[row]) <= most)) return false;
        return true;
    }
    /// Whether it obeys the inequalities of its modes too.
    bool admissible(const AccelerationProblem& p, const ContactModes& modes) const {
        const double a = acceleration_rounding(p), f = force_rounding(p);
        for (std::size_t k = 0; k < p.contact_count(); ++k) {
            const Eigen::Index n = p.row(k);
            if (modes.mode[k] == ContactMode::open) {
                if (!(acceleration[n] >= -a)) return false;
                continue;
            }
            if (!(force[n] >= -f)) return false;
            const auto tangential = [&](const Eigen::VectorXd& x) {
                return x.segment(n + 1, p.rows - 1);
            };
            if (modes.mode[k] == ContactMode::sticking) {
                if (!(tangential(force).norm() <= p.mu[k] * force[n] + f)) return false;
            } else if (p.mu[k] > 0.0 && !p.slides(k)) {
                if (!(tangential(acceleration).dot(modes.slip.col(p.column(k))) >= -a))
                    return false;
            }
        }
        return true;
    }

  private:
    static constexpr double relative = 1e-9;  // some ten thousand times what small systems lose

    /// Forces per unknown, a column each: n - mu s of a contact that slides, the axes of one that
    /// sticks.
    void directions(const AccelerationProblem& p, const ContactModes& modes) {
        directions_.setZero(p.b.size(), static_cast<Eigen::Index>(equations_.size()));
        for (std::size_t i = 0; i < equations_.size(); ++i) {
            const Eigen::Index row = equations_[i];
            const auto k = static_cast<std::size_t>(row / p.rows);
            const auto column = static_cast<Eigen::Index>(i);
            directions_(row, column) = 1.0;
            if (modes.mode[k] == ContactMode::sliding)
                directions_.col(column).segment(row + 1, p.rows - 1) =
                    -p.mu[k] * modes.slip.col(p.column(k));
        }
    }
    void solve_equations(const AccelerationProblem& p) {
        constexpr double redundant = 1e-11;
        singular = false;
        determinant = 1.0;
        unknown_.resize(right_.size());
        if (right_.size() == 0) return;
        lu_.compute(matrix_);
        lu_.setThreshold(redundant);
        determinant = lu_.determinant();
        for (const Eigen::Index row : equations_) determinant /= p.w(row, row);
        singular = !lu_.isInvertible();
        if (!singular) {
            unknown_ = lu_.solve(right_);
        } else {
            least_.setThreshold(redundant);
            unknown_ = least_.compute(matrix_).solve(right_);
        }
    }

    std::vector<Eigen::Index> equations_;
    Eigen::MatrixXd directions_, columns_, matrix_;
    Eigen::VectorXd right_, unknown_;
    Eigen::FullPivLU<Eigen::MatrixXd> lu_;
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> least_;
};

}  // namespace talus
