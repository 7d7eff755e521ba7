// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/check.hpp>
#include <talus/core/column.hpp>
#include <talus/core/input.hpp>
#include <talus/core/instantiate.hpp>
#include <talus/core/observer.hpp>
#include <talus/core/room.hpp>
#include <talus/law/coulomb.hpp>
#include <talus/law/weighted_mean.hpp>
#include <talus/problem/assembled_problem.hpp>
#include <talus/problem/rigid_body_operators.hpp>
#include <talus/solver/concepts.hpp>
#include <talus/solver/sweeps/sweep_kernel.hpp>
#include <talus/solver/sweeps/sweep_order.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

namespace talus {

namespace detail {

/// Whether problems of rigid bodies have the rows of a law.
template <int Rows, class Law>
inline constexpr bool rows_of_bodies = SpaceDimension<law_space<Law, Rows>>;

/// The problem of rigid bodies for a law, and the operators that a solver keeps of such between
/// solves: nothing where rows are neither those of space nor, as the law says, rolling ones too.
template <int Rows, class Law>
struct RigidBodies {
    struct Problem;
};
template <int Rows, class Law>
requires(rows_of_bodies<Rows, Law>) struct RigidBodies<Rows, Law> {
    using Problem = ContactProblem<law_space<Law, Rows>, Law>;
    RigidBodyOperators<law_space<Law, Rows>, Rows> operators;
};

}  // namespace detail

struct GaussSeidelParams {
    /// Sweeps allowed [-], not negative. Piles need some ten per layer of grains for 1e-3.
    int max_sweeps = 1000;
    /// On the residual of problem/residual.hpp [-]. 1e-3 shows in no
    /// picture, 1e-6 is good for statistics of forces, 1e-12 is near rounding. Convergence is
    /// linear: each digit costs the same number of sweeps. 0 asks for all of max_sweeps.
    double tolerance = 1e-8;
    /// Ascending: contacts come as a stream, the fastest on present machines.
    SweepOrder order = SweepOrder::forward;
    /// Of SweepOrder::random. Any value is as good.
    std::uint64_t seed = 1;
    /// Sweeps after which the order becomes SweepOrder::random, not negative. With friction a fixed
    /// order may cycle for ever, at residuals of 1e-4 and less, where random orders converge;
    /// before that they only cost the stream of contacts.
    int shuffle_after = 1000;
};

/// Nonsmooth Gauss-Seidel [Moreau, section 4; JourdanAlartJean1998]: visit the contacts in turn,
/// solving each exactly with the impulses of the others as they are.
///
/// Finds a solution where the laws' local problems have one, from any start, in practice always and
/// by theorem without friction. Converges linearly, slowly for deep or stiff systems (sweeps grow
/// with the square of the number of layers). Where impulses are not unique the start and the order
/// choose.
///
/// The true residual, which costs about half a sweep, is evaluated on arrival, after 1, 2, 4, 8...
/// sweeps, and when the change of the impulses in a sweep, times the ratio of the two found last,
/// says that it may have reached the tolerance. Each evaluation first recomputes the velocities
/// from the impulses, so that rounding errors do not pile up and the verdict is on what is
/// returned.
///
/// `Dim` is the rows per contact: those of space, and with rolling friction more (law_rows).
///
/// One object may be used again for any problems; it allocates when a problem is larger than all
/// before. The same input gives the same bits, whether observed or not.
template <int Dim, ContactLaw<Dim> Law>
class GaussSeidel {
  public:
    /// Residuals kept in SolveReport::history; from then on the last one is replaced.
    static constexpr std::size_t history_limit = 64;

    /// Problems of rigid bodies; of an unknown kind, and taken by no `solve`, for rows that bodies
    /// have not.
    using Problem = typename detail::RigidBodies<Dim, Law>::Problem;

    explicit GaussSeidel(GaussSeidelParams params = {}) : params(params) {}

    /// To be changed between solves at will; checked by `solve`.
    GaussSeidelParams params;

    /// Solves `problem` from the warm start `r`, into `r`. `on_sweep(sweep, residual)` is called
    /// after each sweep and may return bool, false to stop; calling it costs one evaluation of the
    /// residual per sweep, talus::Ignore costs nothing. Throws input_error on parameters out of
    /// range or arrays of different lengths.
    template <class OnSweep>
    const SolveReport& solve(const Problem& problem, std::span<Vector<Dim>> r,
                             OnSweep&& on_sweep) requires(detail::rows_of_bodies<Dim, Law>) {
        return bodies_.operators.with(
            problem.jacobian, problem.inverse_mass, [&](auto& w) -> const SolveReport& {
                return solve(w, problem.free_velocity, problem.laws, r, on_sweep);
            });
    }
    /// Unobserved.
    const SolveReport& solve(const Problem& problem,
                             std::span<Vector<Dim>> r) requires(detail::rows_of_bodies<Dim, Law>);
    const SolveReport& solve(AssembledProblem<Dim, Law>& problem, std::span<Vector<Dim>> r) {
        return solve(problem.delassus, problem.free_velocity, problem.laws, r);
    }

    /// With a W given by its blocks, which is left following the impulses returned.
    const SolveReport& solve(DelassusSparse<Dim>& w, std::span<const Vector<Dim>> free_velocity,
                             std::span<const Law> laws, std::span<Vector<Dim>> r);
    /// The same with an operator of the caller's, say from a system that is not made of rigid
    /// bodies. `w` is left following the impulses returned.
    template <SweepableDelassus<Dim> W, class OnSweep = Ignore>
    const SolveReport& solve(W& w, std::span<const Vector<Dim>> free_velocity,
                             std::span<const Law> laws, std::span<Vector<Dim>> r,
                             OnSweep&& on_sweep = {}) {
        const SweepTask<Dim, Law, W> task{w, free_velocity, laws, r};
        task.require_sizes();
        require_non_negative("max_sweeps", params.max_sweeps);
        require_non_negative("tolerance", params.tolerance);
        require_non_negative("shuffle_after", params.shuffle_after);
        prepare(task);
        if (verify(task, 0)) return report_;
        iterate(task, on_sweep);
        return report_;
    }

    const SolveReport& report() const { return report_; }  ///< of the last solve

  private:
    template <class W>
    using Task = SweepTask<Dim, Law, W>;

    template <class W>
    void prepare(const Task<W>& task) {
        report_.history.clear();
        report_.history.reserve(history_limit);
        detail::make_room(last_finite_, task.r.size());
        last_finite_.assign(task.r.begin(), task.r.end());
        sequence_.reset(params.order, params.seed, task.r.size());
        kernel_.prepare(task);
    }

    template <class W, class OnSweep>
    void iterate(const Task<W>& task, OnSweep& on_sweep) {
        double ratio = 0.0;  // of the residual to the change in a sweep, when last known
        int next_look = 1;
        for (int k = 1; k <= params.max_sweeps; ++k) {
            if (k == params.shuffle_after + 1)
                sequence_.reset(SweepOrder::random, params.seed, task.r.size());
            const double change = sweep(task);
            bool go_on = true;
            if constexpr (!std::is_same_v<std::remove_cvref_t<OnSweep>, Ignore>)
                go_on = notify(on_sweep, k, kernel_.evaluate(task).relative);
            // Written so that a change that is not a number calls for a look.
            const bool hopeful = !(change * ratio > params.tolerance);
            if (go_on && k != params.max_sweeps && k != next_look && !hopeful) continue;
            if (verify(task, k)) return;
            if (!go_on) report_.status = SolveStatus::stopped;
            // Nothing moves: what is left is no contact's to solve.
            if (!go_on || change == 0.0) return;
            ratio = report_.residual / change;
            if (k == next_look) next_look *= 2;
        }
    }

    /// One sweep; returns the norm of the change of the impulses, || D^-1/2 dr || [sqrt(J)].
    template <class W>
    double sweep(const Task<W>& task) {
        double change = 0.0;
        with_quickest(task, [&](const auto& quick) {
            sequence_.next([&](std::size_t i) { change += kernel_.visit(quick, i); });
        });
        return std::sqrt(change);
    }

    /// Evaluates the residual afresh, notes it, and tells whether the solve is over.
    template <class W>
    bool verify(const Task<W>& task, int sweeps) {
        task.w.start(task.r);
        const Residual residual = kernel_.evaluate(task);
        report_.iterations = sweeps;
        report_.status = SolveStatus::iteration_limit;
        if (!residual.finite()) {
            std::copy(last_finite_.begin(), last_finite_.end(), task.r.begin());
            report_.status = SolveStatus::not_finite;
        } else if (residual.relative <= params.tolerance) {
            report_.status = SolveStatus::converged;
        } else {
            std::copy(task.r.begin(), task.r.end(), last_finite_.begin());
        }
        report_.take(residual);
        report_.note(sweeps, residual.relative, history_limit);
        return report_.status != SolveStatus::iteration_limit;
    }

    detail::RigidBodies<Dim, Law> bodies_;
    SweepKernel<Dim, Law> kernel_;
    Column<Vector<Dim>> last_finite_;
    SweepSequence sequence_;
    SolveReport report_;
};

// The forms that most programs use, not inline: `extern template class` spares a user all of them.

template <int Dim, ContactLaw<Dim> Law>
const SolveReport& GaussSeidel<Dim, Law>::solve(
    const Problem& problem, std::span<Vector<Dim>> r) requires(detail::rows_of_bodies<Dim, Law>) {
    // Clang 14 instantiates this also where the constraint fails.
    if constexpr (detail::rows_of_bodies<Dim, Law>) return solve(problem, r, Ignore{});
    return report_;
}
template <int Dim, ContactLaw<Dim> Law>
const SolveReport& GaussSeidel<Dim, Law>::solve(DelassusSparse<Dim>& w,
                                                std::span<const Vector<Dim>> free_velocity,
                                                std::span<const Law> laws,
                                                std::span<Vector<Dim>> r) {
    return solve(w, free_velocity, laws, r, Ignore{});
}

}  // namespace talus

TALUS_IN_PLANE(class talus::GaussSeidel<2, talus::Coulomb<2>>)
TALUS_IN_PLANE(class talus::GaussSeidel<2, talus::WeightedMean<2, talus::Coulomb<2>>>)
TALUS_IN_SPACE(class talus::GaussSeidel<3, talus::Coulomb<3>>)
TALUS_IN_SPACE(class talus::GaussSeidel<3, talus::WeightedMean<3, talus::Coulomb<3>>>)
