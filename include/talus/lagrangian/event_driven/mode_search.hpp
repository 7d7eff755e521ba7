// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/lagrangian/event_driven/acceleration_problem.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace talus {

/// A mode that a contact shall not take, where what has just come to its end is as good as what
/// follows: its force or its slip is zero at that instant.
enum class ExcludedMode {
    none,
    closed,   ///< its force went down to zero
    sticking  ///< its friction came to its limit
};

/// A solution of an AccelerationProblem.
struct AccelerationSolution {
    ContactModes modes;
    Eigen::VectorXd force;         ///< [N]
    Eigen::VectorXd acceleration;  ///< [m/s^2]
};

/// All solutions of an AccelerationProblem, by trying every combination of modes: a contact that
/// slides, or has no friction, is closed or open; one at rest sticks, slides one way or the other,
/// or is open. In space a contact at rest with friction sticks or is open only.
class ModeSearch {
  public:
    /// Solutions whose accelerations differ, in the order that they were found: closed before open.
    /// `excluded` has an entry for each contact, or none at all.
    const std::vector<AccelerationSolution>& run(const AccelerationProblem& p,
                                                 std::span<const ExcludedMode> excluded = {}) {
        solutions_.clear();
        complete_ = true;
        const std::size_t n = p.contact_count();
        std::vector<std::size_t> choice(n, 0);
        for (;;) {
            if (pose(p, choice, excluded)) try_modes(p);
            std::size_t k = 0;
            while (k < n && ++choice[k] == choices(p, k)) choice[k++] = 0;
            if (k == n) return solutions_;
        }
    }
    const std::vector<AccelerationSolution>& solutions() const { return solutions_; }
    /// Whether these are all there are. Not where forces are not unique and the least ones break
    /// the laws, nor where a contact at rest in space has friction.
    bool complete() const { return complete_; }

  private:
    static bool at_rest(const AccelerationProblem& p, std::size_t k) {
        return p.mu[k] > 0.0 && !p.slides(k);
    }
    static std::size_t choices(const AccelerationProblem& p, std::size_t k) {
        return !at_rest(p, k) ? 2 : p.rows > 2 ? 2 : 4;
    }
    /// Modes of a combination; whether none of them is excluded.
    bool pose(const AccelerationProblem& p, const std::vector<std::size_t>& choice,
              std::span<const ExcludedMode> excluded) {
        const std::size_t n = choice.size();
        modes_.mode.resize(n);
        modes_.slip = p.slip;
        for (std::size_t k = 0; k < n; ++k) {
            const std::size_t c = choice[k];
            ContactMode& mode = modes_.mode[k];
            if (c + 1 == choices(p, k)) {
                mode = ContactMode::open;
            } else if (!at_rest(p, k)) {
                mode = ContactMode::sliding;
            } else if (c == 0) {
                mode = ContactMode::sticking;
                if (p.rows > 2) complete_ = false;
            } else {
                mode = ContactMode::sliding;
                modes_.slip(0, p.column(k)) = c == 1 ? 1.0 : -1.0;
            }
            if (excluded.empty()) continue;
            if (excluded[k] == ExcludedMode::closed && mode != ContactMode::open) return false;
            if (excluded[k] == ExcludedMode::sticking && mode == ContactMode::sticking)
                return false;
        }
        return true;
    }
    void try_modes(const AccelerationProblem& p) {
        system_.solve(p, modes_);
        if (!system_.consistent(p)) return;
        if (!system_.admissible(p, modes_)) {
            if (system_.singular) complete_ = false;
            return;
        }
        constexpr double same = 1e3;  // of what rounding may leave
        const double least = same * system_.acceleration_rounding(p);
        for (const AccelerationSolution& s : solutions_)
            if ((s.acceleration - system_.acceleration).lpNorm<Eigen::Infinity>() <= least) return;
        solutions_.push_back({modes_, system_.force, system_.acceleration});
    }

    std::vector<AccelerationSolution> solutions_;
    bool complete_ = true;
    ContactModes modes_;
    ModeSystem system_;
};

}  // namespace talus
