// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/column.hpp>
#include <talus/core/input.hpp>
#include <talus/core/instantiate.hpp>
#include <talus/core/room.hpp>
#include <talus/law/coulomb.hpp>
#include <talus/problem/assembled_problem.hpp>
#include <talus/problem/rigid_body_operators.hpp>
#include <talus/solver/concepts.hpp>
#include <talus/solver/sweeps/anderson_memory.hpp>
#include <talus/solver/sweeps/sweep_kernel.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace talus {

/// How the iterates of a fixed-point map are made to converge faster.
enum class Acceleration {
    nesterov,  ///< momentum, restarted when increments grow: no memory, one number to keep
    anderson,  ///< the combination of the last iterates with the least increment [WalkerNi2011]
};

struct AcceleratedGaussSeidelParams {
    /// Double sweeps allowed [-], not negative.
    int max_iterations = 1000;
    /// On the residual of problem/residual.hpp [-].
    double tolerance = 1e-8;
    Acceleration acceleration = Acceleration::anderson;
    /// Iterates that Anderson's combination looks back [-], in [1, 20].
    int depth = 10;
    /// Iterations after which other ways are tried, again and again, see below [-], not negative;
    /// 0: never.
    int patience = 500;
    /// Residual to go on to, once the tolerance is met, within `effort` [-], not negative; at or
    /// above the tolerance: to none. To miss it is no failure.
    double aim = std::numeric_limits<double>::infinity();
    /// Until when: visits of contacts since the solve began, some 20 ms [-], not negative; but
    /// never less than 50 double sweeps.
    double effort = 5e5;
};

/// Gauss-Seidel, forward and back in turn, as a fixed-point map whose iterates are accelerated. A
/// symmetric pass makes the map of the problem without friction self-adjoint, which momentum needs:
/// one-directional sweeps do not bear it.
///
/// Both accelerators are safeguarded by the increment |T(y) - y| that the map itself gives: when it
/// grows (Anderson: to twice the least so far), what they remember is dropped, and double sweeps go
/// on from where they are. To 1e-8 that is 3 to 100 times faster than Gauss-Seidel on deep or
/// hyperstatic systems. With friction the map has no potential: momentum may run in circles, and
/// leaves errors at single contacts that a few plain sweeps remove. So after every `patience`
/// iterations other ways are tried, from where it is: sweeps that go 0.4 of their way, then the
/// other accelerator, longer each time. Momentum then goes on as if nothing had been (it needs long
/// runs); after four such tries a thousand pairs of plain sweeps, twice as many the next time and
/// so on, start from the best impulses measured.
///
/// Towers need 1e-4 to stand and reach it in some hundred passes; packings that flow take six to
/// forty times those of 1e-3. So what meets `tolerance` has converged, and goes on to `aim` up to
/// `effort`. The best impulses measured are returned; `iterations` is the work done.
///
/// Cost per iteration: two sweeps and half a sweep for the start at y; Anderson adds 3 depth
/// products of vectors. Its memory, 2 depth + 4 impulses per contact, is reserved also for the
/// tries of the other way. `w` is left following the impulses returned. `Dim`: rows of a contact.
template <int Dim, ContactLaw<Dim> Law>
class AcceleratedGaussSeidel {
  public:
    /// Residuals kept in SolveReport::history; from then on the last one is replaced.
    static constexpr std::size_t history_limit = 256;

    explicit AcceleratedGaussSeidel(AcceleratedGaussSeidelParams params = {}) : params(params) {}
    AcceleratedGaussSeidelParams params;

    /// Solves `problem` from the warm start `r`, into `r`. Throws input_error on parameters out of
    /// range or arrays of different lengths.
    const SolveReport& solve(const ContactProblem<law_space<Law, Dim>, Law>& problem,
                             std::span<Vector<Dim>> r);
    const SolveReport& solve(AssembledProblem<Dim, Law>& problem, std::span<Vector<Dim>> r) {
        return solve(problem.delassus, problem.free_velocity, problem.laws, r);
    }
    const SolveReport& solve(DelassusSparse<Dim>& w, std::span<const Vector<Dim>> free_velocity,
                             std::span<const Law> laws, std::span<Vector<Dim>> r);
    /// The same with an operator of the caller's. Of a DelassusGlobal only what is assembled
    /// counts.
    template <SweepableDelassus<Dim> W>
    const SolveReport& solve(W& w, std::span<const Vector<Dim>> free_velocity,
                             std::span<const Law> laws, std::span<Vector<Dim>> r) {
        if constexpr (requires { w.assembled(); })
            return solve(w.assembled(), free_velocity, laws, r);
        else
            return run(w, free_velocity, laws, r);
    }

    const SolveReport& report() const { return report_; }  ///< of the last solve

  private:
    enum class Way { own, other, damped, plain };

    /// What differs between operators, so that all else is compiled once.
    struct Sweeper {
        std::span<Vector<Dim>> r;

        explicit Sweeper(std::span<Vector<Dim>> r) : r(r) {}
        /// Forward and back, or forward twice if plain.
        virtual void sweep_twice(Way way) = 0;
        virtual void start() = 0;         ///< follows r afresh
        virtual Residual evaluate() = 0;  ///< at what it follows

      protected:
        ~Sweeper() = default;
    };
    template <class W>
    struct SweeperOf final : Sweeper {
        SweepTask<Dim, Law, W> task;
        SweepKernel<Dim, Law>& kernel;

        SweeperOf(const SweepTask<Dim, Law, W>& task, SweepKernel<Dim, Law>& kernel)
            : Sweeper(task.r), task(task), kernel(kernel) {
            kernel.prepare(task);
        }
        void sweep_twice(Way way) override {
            with_quickest(task, [&](const auto& quick) {
                const std::size_t n = task.r.size();
                if (way == Way::damped) {
                    for (std::size_t i = 0; i < n; ++i) kernel.visit_in_part(quick, i, 0.4);
                    for (std::size_t i = n; i-- > 0;) kernel.visit_in_part(quick, i, 0.4);
                    return;
                }
                for (std::size_t i = 0; i < n; ++i) kernel.visit(quick, i);
                if (way == Way::plain)
                    for (std::size_t i = 0; i < n; ++i) kernel.visit(quick, i);
                else
                    for (std::size_t i = n; i-- > 0;) kernel.visit(quick, i);
            });
        }
        void start() override { task.w.start(task.r); }
        Residual evaluate() override { return kernel.evaluate(task); }
    };

    template <class W>
    const SolveReport& run(W& w, std::span<const Vector<Dim>> free_velocity,
                           std::span<const Law> laws, std::span<Vector<Dim>> r) {
        const SweepTask<Dim, Law, W> task{w, free_velocity, laws, r};
        task.require_sizes();
        require_params();
        SweeperOf<W> sweeper(task, kernel_);
        run(sweeper);
        return report_;
    }

    void require_params() const;
    void run(Sweeper& sweeper);
    void iterate(Sweeper& sweeper);
    bool run(Sweeper& sweeper, Way way, int length);
    bool verify(Sweeper& sweeper, int iterations);
    /// The residual that ends a solve so long.
    double wanted(int iterations) const {
        return iterations < last_for_aim_ ? params.aim : params.tolerance;
    }

    void reset_momentum() {
        time_ = 1.0;
        last_change_ = std::numeric_limits<double>::infinity();
        x_.clear();
    }
    void reset_memory() {
        memory_.clear();
        least_change_ = std::numeric_limits<double>::infinity();
    }

    void momentum(std::span<const Vector<Dim>> x, double change);
    void combine(std::span<const Vector<Dim>> x, double change);

    RigidBodyOperators<law_space<Law, Dim>, Dim> bodies_;
    SweepKernel<Dim, Law> kernel_;
    int count_ = 0, next_look_ = 1;  ///< of iterations
    int last_for_aim_ = 0;           ///< iteration at which the aim is given up; 0: there is none
    // y_: where the next map begins, own_y_: that of the own way; kept_: the best impulses seen.
    Column<Vector<Dim>> x_, y_, own_y_, kept_;
    Residual best_;  ///< theirs
    // Momentum: the last T(y), Nesterov's time and the last increment.
    double time_ = 1.0, last_change_ = 0.0;
    AndersonMemory memory_;      ///< in units of the norm
    double least_change_ = 0.0;  ///< increment met since the memory was emptied
    SolveReport report_;
};

// Not inline, so that `extern template class` spares a user all of it.
template <int Dim, ContactLaw<Dim> Law>
const SolveReport& AcceleratedGaussSeidel<Dim, Law>::solve(
    const ContactProblem<law_space<Law, Dim>, Law>& problem, std::span<Vector<Dim>> r) {
    return bodies_.with(problem.jacobian, problem.inverse_mass, [&](auto& w) -> const SolveReport& {
        return run(w, problem.free_velocity, problem.laws, r);
    });
}
template <int Dim, ContactLaw<Dim> Law>
const SolveReport& AcceleratedGaussSeidel<Dim, Law>::solve(
    DelassusSparse<Dim>& w, std::span<const Vector<Dim>> free_velocity, std::span<const Law> laws,
    std::span<Vector<Dim>> r) {
    return run(w, free_velocity, laws, r);
}

template <int Dim, ContactLaw<Dim> Law>
void AcceleratedGaussSeidel<Dim, Law>::require_params() const {
    require_non_negative("max_iterations", params.max_iterations);
    require_non_negative("tolerance", params.tolerance);
    require_in("depth", params.depth, 1, 20);
    require_non_negative("patience", params.patience);
    require_in("aim", params.aim, 0.0, std::numeric_limits<double>::infinity());
    require_non_negative("effort", params.effort);
}

template <int Dim, ContactLaw<Dim> Law>
void AcceleratedGaussSeidel<Dim, Law>::run(Sweeper& sweeper) {
    const std::span<Vector<Dim>> r = sweeper.r;
    report_.history.clear();
    report_.history.reserve(history_limit);
    report_.short_of_aim = false;
    // Room for all ways, so that a hard problem needs no more than an easy one as large.
    for (Column<Vector<Dim>>* one : {&kept_, &x_, &y_, &own_y_}) detail::make_room(*one, r.size());
    if (params.patience > 0) memory_.make_room(Dim * r.size(), params.depth);
    kept_.assign(r);
    best_ = {.relative = std::numeric_limits<double>::infinity()};
    constexpr double least = 50.0;  // double sweeps
    const double visits = 2.0 * static_cast<double>(std::max<std::size_t>(r.size(), 1));
    last_for_aim_ = 0;
    if (params.aim < params.tolerance)
        last_for_aim_ = static_cast<int>(std::clamp(params.effort / visits, least, 1e9));
    if (verify(sweeper, 0)) return;
    iterate(sweeper);
    // Written so that a residual that is not a number gives way to one that is.
    if (best_.finite() && !(best_.relative >= report_.residual)) {
        std::copy(kept_.begin(), kept_.end(), r.begin());
        sweeper.start();
        report_.take(best_);
        report_.note(report_.iterations, best_.relative, history_limit);
    }
    if (report_.residual <= params.tolerance) report_.status = SolveStatus::converged;
    report_.short_of_aim = report_.residual > params.aim;
}

template <int Dim, ContactLaw<Dim> Law>
void AcceleratedGaussSeidel<Dim, Law>::iterate(Sweeper& sweeper) {
    y_.assign(sweeper.r);
    count_ = 0;
    next_look_ = 1;
    reset_momentum();
    reset_memory();
    if (params.patience == 0) {
        run(sweeper, Way::own, params.max_iterations);
        return;
    }
    const auto start_from = [&](const Column<Vector<Dim>>& x) {
        std::copy(x.begin(), x.end(), sweeper.r.begin());
        y_.assign(x);
        sweeper.start();
    };
    constexpr int rounds = 4, smoothing = 10, first_try = 30, plain = 1000;
    for (int round = 0;; ++round) {
        if (run(sweeper, Way::own, params.patience)) return;
        if (round == 0 && best_.relative > 1.0) {
            // The start has led nowhere: zero is as good. (Not before: a jam that is remembered
            // may look as bad in the scale of its loads, and yet be what holds.)
            own_y_.assign(sweeper.r.size(), Vector<Dim>::Zero());
            start_from(own_y_);
            reset_momentum();
            if (run(sweeper, Way::own, params.patience)) return;
        }
        own_y_ = y_;
        params.acceleration == Acceleration::nesterov ? reset_memory() : reset_momentum();
        if (run(sweeper, Way::damped, smoothing)) return;
        if (run(sweeper, Way::other, first_try << (round % rounds))) return;
        start_from(own_y_);
        if (round % rounds != rounds - 1) continue;
        start_from(kept_);
        if (run(sweeper, Way::plain, plain * (1 + round / rounds))) return;
        reset_momentum();
        reset_memory();
    }
}

/// So many iterations in one way, from r, which is y_; true if the solve is over.
template <int Dim, ContactLaw<Dim> Law>
bool AcceleratedGaussSeidel<Dim, Law>::run(Sweeper& sweeper, Way way, int length) {
    const bool with_momentum = (params.acceleration == Acceleration::nesterov) == (way == Way::own);
    const std::span<Vector<Dim>> r = sweeper.r;
    double ratio = 0.0;
    for (const int end = std::min(params.max_iterations - count_, length) + count_; count_ < end;) {
        const int k = ++count_;
        // x = T(y): r holds y, then x.
        sweeper.sweep_twice(way);
        double change = 0.0;
        for (std::size_t i = 0; i < r.size(); ++i)
            change += (r[i] - y_[i]).squaredNorm() / kernel_.measure().effective_mass(i);
        change = std::sqrt(change);
        // The increment bounds the residual by a ratio that changes slowly.
        const bool unmet = best_.relative > params.tolerance;
        const bool hopeful = !(change * ratio > (unmet ? params.tolerance : wanted(k)));
        if (k == end || k == next_look_ || k == last_for_aim_ || hopeful) {
            if (verify(sweeper, k) || change == 0.0) return true;
            ratio = report_.residual / change;
            // After 1, 2, 4, 7, 11...: history for the observer of the report.
            if (k == next_look_) next_look_ += 1 + next_look_ / 2;
        }
        if (k == params.max_iterations) return true;
        if (way == Way::damped || way == Way::plain) {
            y_.assign(r);
            continue;
        }
        with_momentum ? momentum(r, change) : combine(r, change);
        std::copy(y_.begin(), y_.end(), r.begin());
        sweeper.start();
    }
    return count_ >= params.max_iterations;
}

/// Evaluates the residual afresh, notes it, and tells whether the solve is over.
template <int Dim, ContactLaw<Dim> Law>
bool AcceleratedGaussSeidel<Dim, Law>::verify(Sweeper& sweeper, int iterations) {
    sweeper.start();
    const Residual residual = sweeper.evaluate();
    report_.iterations = iterations;
    report_.status = SolveStatus::iteration_limit;
    if (!residual.finite()) {
        std::copy(kept_.begin(), kept_.end(), sweeper.r.begin());
        sweeper.start();
        report_.status = SolveStatus::not_finite;
    } else if (std::min(residual.relative, best_.relative) <= wanted(iterations)) {
        report_.status = SolveStatus::converged;
    } else if (residual.relative < best_.relative) {
        std::copy(sweeper.r.begin(), sweeper.r.end(), kept_.begin());
        best_ = residual;
    }
    report_.take(residual);
    report_.note(iterations, residual.relative, history_limit);
    return report_.status != SolveStatus::iteration_limit;
}

/// y := x + beta (x - x_before), without memory after an increment that grew.
template <int Dim, ContactLaw<Dim> Law>
void AcceleratedGaussSeidel<Dim, Law>::momentum(std::span<const Vector<Dim>> x, double change) {
    if (change > last_change_ || time_ == 1.0) {
        x_.assign(x);
        y_.assign(x);
        const bool first = time_ == 1.0 && change <= last_change_;
        time_ = first ? 0.5 * (1.0 + std::sqrt(5.0)) : 1.0;
        last_change_ = first ? change : std::numeric_limits<double>::infinity();
        return;
    }
    last_change_ = change;
    // Nesterov's sequence: 1, 1.62, 2.19..., about k / 2; beta tends to 1 as 1 - 3 / k.
    const double next = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * time_ * time_));
    const double beta = (time_ - 1.0) / next;
    time_ = next;
    for (std::size_t i = 0; i < x.size(); ++i) {
        y_[i] = x[i] + beta * (x[i] - x_[i]);
        x_[i] = x[i];
    }
}

/// y := the affine combination of the last T(y) whose increment is least, in the norm |D^-1/2 .|,
/// in which contacts of all masses count alike.
template <int Dim, ContactLaw<Dim> Law>
void AcceleratedGaussSeidel<Dim, Law>::combine(std::span<const Vector<Dim>> x, double change) {
    const std::size_t n = x.size();
    memory_.prepare(Dim * n, params.depth);
    if (change > 2.0 * least_change_) {
        reset_memory();
        // It is the first of a new memory.
        least_change_ = change;
    }
    least_change_ = std::min(least_change_, change);
    for (std::size_t i = 0; i < n; ++i) {
        const double scale = 1.0 / std::sqrt(kernel_.measure().effective_mass(i));
        for (std::size_t d = 0; d < Dim; ++d) {
            const auto row = static_cast<std::ptrdiff_t>(d);
            memory_.image()[Dim * i + d] = scale * x[i][row];
            memory_.increment()[Dim * i + d] = scale * (x[i][row] - y_[i][row]);
        }
    }
    if (!memory_.combine()) {
        y_.assign(x);
        return;
    }
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t d = 0; d < Dim; ++d)
            y_[i][static_cast<std::ptrdiff_t>(d)] =
                memory_.image()[Dim * i + d] * std::sqrt(kernel_.measure().effective_mass(i));
}

}  // namespace talus

TALUS_IN_PLANE(class talus::AcceleratedGaussSeidel<2, talus::Coulomb<2>>)
TALUS_IN_SPACE(class talus::AcceleratedGaussSeidel<3, talus::Coulomb<3>>)
