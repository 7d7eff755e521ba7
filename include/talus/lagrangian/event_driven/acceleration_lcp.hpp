// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/lagrangian/event_driven/acceleration_problem.hpp>
#include <talus/lagrangian/event_driven/lemke.hpp>
#include <talus/lagrangian/event_driven/mode_search.hpp>

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace talus {

/// An AccelerationProblem as a linear complementarity problem. A contact that slides, or has no
/// friction, gives the pair
///
///   r_n | a_n ,   with r = r_n (n - mu s) ;
///
/// one at rest in the plane four, with r_t = plus - minus [StewartTrinkle1996]:
///
///   r_n | a_n ,   plus | a_t + speed ,   minus | -a_t + speed ,   speed | mu r_n - plus - minus .
///
/// If no contact slides yet the matrix is copositive, for which Lemke's algorithm ends with a
/// solution [AnitescuPotra1997]; a form with three pairs is not, and it often ends without. One at
/// rest in space with friction has no such form.
class AccelerationLcp {
  public:
    Eigen::MatrixXd m;
    Eigen::VectorXd q;

    static bool has_form(const AccelerationProblem& p) {
        for (std::size_t k = 0; k < p.contact_count(); ++k)
            if (p.rows > 2 && p.mu[k] > 0.0 && !p.slides(k)) return false;
        return true;
    }
    /// Fills m and q. The problem `has_form`.
    void pose(const AccelerationProblem& p) {
        const std::size_t n = p.contact_count();
        first_.resize(n);
        Eigen::Index size = 0;
        for (std::size_t k = 0; k < n; ++k) {
            first_[k] = size;
            size += at_rest(p, k) ? 4 : 1;
        }
        // r = forces_ z, and the rows of w that are accelerations.
        forces_.setZero(p.b.size(), size);
        Eigen::MatrixXd of_row = Eigen::MatrixXd::Zero(size, p.b.size());
        for (std::size_t k = 0; k < n; ++k) {
            const Eigen::Index row = p.row(k), i = first_[k];
            forces_(row, i) = 1.0;
            of_row(i, row) = 1.0;
            if (at_rest(p, k)) {
                for (const auto& [place, sign] : {std::pair{i + 1, 1.0}, std::pair{i + 2, -1.0}}) {
                    forces_(row + 1, place) = sign;
                    of_row(place, row + 1) = sign;
                }
            } else {
                forces_.col(i).segment(row + 1, p.rows - 1) = -p.mu[k] * p.slip.col(p.column(k));
            }
        }
        m.noalias() = of_row * p.w * forces_;
        q.noalias() = of_row * p.b;
        for (std::size_t k = 0; k < n; ++k) {
            if (!at_rest(p, k)) continue;
            const Eigen::Index i = first_[k];
            m(i + 1, i + 3) = m(i + 2, i + 3) = 1.0;
            m(i + 3, i) = p.mu[k];
            m(i + 3, i + 1) = m(i + 3, i + 2) = -1.0;
        }
    }
    /// The modes, forces and accelerations of a solution z of what was posed.
    AccelerationSolution read(const AccelerationProblem& p, const Eigen::VectorXd& z) const {
        AccelerationSolution s{{{}, p.slip}, forces_ * z, p.b};
        s.acceleration.noalias() += p.w * s.force;
        const Eigen::VectorXd w = m * z + q;
        const double rounding = 1e-11 * (p.b.lpNorm<Eigen::Infinity>() +
                                         (s.acceleration - p.b).lpNorm<Eigen::Infinity>());
        for (std::size_t k = 0; k < p.contact_count(); ++k) {
            const Eigen::Index i = first_[k];
            // The larger of a pair is the one that counts; which is closed if both vanish.
            const double scale = p.w(p.row(k), p.row(k));
            if (w[i] > scale * z[i]) {
                s.modes.mode.push_back(ContactMode::open);
            } else if (!at_rest(p, k)) {
                s.modes.mode.push_back(ContactMode::sliding);
            } else {
                const double a_t = s.acceleration[p.row(k) + 1];
                const bool slides = std::abs(a_t) > rounding;
                s.modes.mode.push_back(slides ? ContactMode::sliding : ContactMode::sticking);
                if (slides) s.modes.slip(0, p.column(k)) = a_t > 0.0 ? 1.0 : -1.0;
            }
        }
        return s;
    }

  private:
    static bool at_rest(const AccelerationProblem& p, std::size_t k) {
        return p.mu[k] > 0.0 && !p.slides(k);
    }

    std::vector<Eigen::Index> first_;  ///< of a contact, in z
    Eigen::MatrixXd forces_;
};

/// One solution by Lemke's algorithm, once more as a linear system in the modes that were found and
/// looked at; nothing where it ends without one, or the problem has no such form.
inline std::optional<AccelerationSolution> solve_by_lemke(const AccelerationProblem& p) {
    if (!AccelerationLcp::has_form(p)) return std::nullopt;
    AccelerationLcp lcp;
    lcp.pose(p);
    const LemkeResult found = lemke(lcp.m, lcp.q);
    if (found.status != LemkeStatus::solved) return std::nullopt;
    AccelerationSolution s = lcp.read(p, found.z);
    ModeSystem system;
    system.solve(p, s.modes);
    if (system.consistent(p) && system.admissible(p, s.modes)) {
        s.force = system.force;
        s.acceleration = system.acceleration;
        return s;
    }
    // Of redundant contacts the forces that were found count: the least ones may break the laws.
    if (!system.singular) return std::nullopt;
    system.force = s.force;
    system.acceleration = s.acceleration;
    if (!system.consistent(p) || !system.admissible(p, s.modes)) return std::nullopt;
    return s;
}

}  // namespace talus
