// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/column.hpp>
#include <talus/core/types.hpp>

#include <algorithm>
#include <limits>
#include <span>

namespace talus {

/// Impulses that a solver made of engines may return to: those before the last engine, and the best
/// there were before any.
template <int Dim>
class ImpulseMemory {
  public:
    /// The residual of impulses that were not measured; they are never the best.
    static constexpr double unknown = std::numeric_limits<double>::infinity();

    /// Before a solve.
    void clear() { best_residual_ = unknown; }
    /// Before an engine works on r, whose residual is that of the last measure.
    void keep(std::span<const Vector<Dim>> r, double residual) {
        kept_.assign(r);
        kept_residual_ = residual;
        if (residual >= best_residual_) return;
        best_ = kept_;
        best_residual_ = residual;
    }
    /// What the last engine was given.
    void return_to_kept(std::span<Vector<Dim>> r) const {
        std::copy(kept_.begin(), kept_.end(), r.begin());
    }
    double kept_residual(double if_unknown) const {
        return kept_residual_ == unknown ? if_unknown : kept_residual_;
    }
    /// Unless r is at least as good.
    void return_to_best(std::span<Vector<Dim>> r, double& residual) const {
        if (!(best_residual_ < residual)) return;
        std::copy(best_.begin(), best_.end(), r.begin());
        residual = best_residual_;
    }

  private:
    Column<Vector<Dim>> kept_, best_;
    double kept_residual_ = unknown, best_residual_ = unknown;
};

}  // namespace talus
