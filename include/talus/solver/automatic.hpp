// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/law/cone_of.hpp>
#include <talus/solver/cones/interior_point.hpp>
#include <talus/solver/cones/newton_polish.hpp>
#include <talus/solver/cones/overlap_certificate.hpp>
#include <talus/solver/cones/projected_gradient.hpp>
#include <talus/solver/cones/proximal_newton.hpp>
#include <talus/solver/impulse_memory.hpp>
#include <talus/solver/sweeps/accelerated_gauss_seidel.hpp>
#include <talus/solver/sweeps/gauss_seidel.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace talus {

struct AutomaticParams {
    /// On the residual of problem/residual.hpp [-].
    double tolerance = 1e-8;
    /// Sweeps allowed in all [-], not negative. A double sweep counts as two, a product with W in a
    /// gradient method as one.
    int max_sweeps = 40000;
    /// Factorisations allowed in all [-], not negative. 0 leaves everything to sweeps.
    int max_factorizations = 1000;
    /// Memory that the factors may take [bytes], not negative. A problem that needs more is left to
    /// methods without.
    double max_factor_bytes = 2e9;
};

/// The solver to use when nothing is known of the problem. Engines take turns on the same impulses:
///
///   gauss_seidel     a few sweeps: enough for small and for well warm-started problems;
///   anderson, nesterov  accelerated double sweeps, by whichever gains more, as long as that
///                    promises an end before that of a factorising engine;
///   newton_polish    once the residual is small, where a factor is cheap beside sweeps to come;
///   interior_point   for what sweeps do not finish, followed by newton_polish again;
///
/// then, for what is left, rounds of ever longer turns: interior_point from other margins or
/// proximal_newton, an accelerator, spectral_gradient and accelerated_gradient. Packings that flow
/// have no potential that all these would descend, and which of them gets through cannot be told
/// beforehand; each begins where the last one ended. The best impulses met are returned.
///
/// Costs are counted in visits of contacts, from the structure of the problem and never by a clock:
/// the same input takes the same way on any machine, to the bit. Engines that treat all contacts at
/// once need laws with a cone (law/cone_of.hpp); with others sweeps do everything.
///
/// The report's `stages` tell who did what; `iterations` counts those of all engines. `no_solution`
/// is reported where there is a certificate: normal impulses that move nothing and yet would gain
/// energy from the prescribed motion, so that no motion separates all contacts.
template <int Dim, ContactLaw<Dim> Law>
class Automatic {
  public:
    explicit Automatic(AutomaticParams params = {}) : params(params) {}
    AutomaticParams params;

    /// Solves `problem` from the warm start `r`, into `r`. Throws input_error on parameters out of
    /// range or arrays of different lengths.
    const SolveReport& solve(const ContactProblem<Dim, Law>& problem, std::span<Vector<Dim>> r);
    const SolveReport& solve(AssembledProblem<Dim, Law>& problem, std::span<Vector<Dim>> r) {
        return solve(problem.delassus, problem.free_velocity, problem.laws, r);
    }
    const SolveReport& solve(DelassusSparse<Dim>& w, std::span<const Vector<Dim>> free_velocity,
                             std::span<const Law> laws, std::span<Vector<Dim>> r);
    const SolveReport& solve(DelassusGlobal<Dim>& w, std::span<const Vector<Dim>> free_velocity,
                             std::span<const Law> laws, std::span<Vector<Dim>> r);

    const SolveReport& report() const { return report_; }  ///< of the last solve

  private:
    using System = ConeSystem<Dim>;
    /// The problem of a solve and its impulses; source() gives what a ConeSystem takes of W.
    template <class W, class Source>
    struct Task {
        W& w;
        std::span<const Vector<Dim>> free_velocity;
        std::span<const Law> laws;
        std::span<Vector<Dim>> r;
        double visits;  ///< of contacts in a sweep
        Source source;
    };

    template <class W, class Source>
    const SolveReport& run(W& w, std::span<const Vector<Dim>> free_velocity,
                           std::span<const Law> laws, std::span<Vector<Dim>> r, double visits,
                           Source source) {
        require_non_negative("tolerance", params.tolerance);
        require_non_negative("max_sweeps", params.max_sweeps);
        require_non_negative("max_factorizations", params.max_factorizations);
        require_non_negative("max_factor_bytes", params.max_factor_bytes);
        report_ = {};
        Task<W, Source> task{w, free_velocity, laws, r, visits, source};
        let_engines_work(task);
        if (report_.status != SolveStatus::not_finite) memory_.return_to_best(r, report_.residual);
        // An engine that gained nothing leaves samples of what it tried at the end.
        if (report_.history.back().residual != report_.residual)
            report_.history.push_back({report_.iterations, report_.residual});
        return report_;
    }

    template <class T>
    void let_engines_work(T& task) {
        sweeps_left_ = params.max_sweeps;
        factorizations_left_ = params.max_factorizations;
        passes_ = 0;
        memory_.clear();
        constexpr double untried = 1e9;
        speed_ = {2.0 * untried, untried};
        polished_at_ = untried;
        constexpr int first_sweeps = 6, first_passes = 15;
        if (sweep(task, first_sweeps) || accelerate(task, first_passes)) return;
        while (ends_soon())
            if (accelerate(task, 2 * last_passes_)) return;
        if (!take_system(task)) {
            while (!accelerate(task, 2 * last_passes_)) {
            }
            return;
        }
        // Double sweeps that cost as much as an interior-point solve, about.
        constexpr double usual_factorizations = 15.0, most = 4000.0;
        double worth = usual_factorizations * passes_per_factorization_;
        // Sweeps go on while they promise an end soon, and at least for a quarter of that cost.
        while (sweeps_left_ > 1 && (passes_ < 0.25 * worth ||
                                    passes_to_go(std::max(speed_[0], speed_[1])) < 0.5 * worth))
            if (accelerate(task, 2 * last_passes_)) return;
        worth = std::clamp(worth, 20.0, most);
        for (int round = 0; play(task, round, worth); ++round)
            if (round > 2) worth = std::min(2.0 * worth, most);
    }

    /// A turn of the engines. False if the solve is over.
    template <class T>
    bool play(T& task, int round, double worth) {
        constexpr std::array margins{0.1, 1.0, 0.01};
        const bool interior = round < static_cast<int>(margins.size());
        if (factorizations_left_ > 0) {
            start_cone_engines(task.r);
            polish_where_new(8);
            if (interior) {
                interior_.params.margin = margins[static_cast<std::size_t>(round)];
                factorize("interior_point", interior_, 60);
            } else {
                factorize("proximal_newton", proximal_,
                          std::max(60, static_cast<int>(worth / passes_per_factorization_)));
            }
            polish(20);
            if (take_over(task)) return false;
            if (proximal_.report().status == SolveStatus::no_solution ||
                (interior && certificate_.by_sweeps(task.w, task.free_velocity, system_))) {
                report_.status = SolveStatus::no_solution;
                return false;
            }
        }
        const int turn = static_cast<int>(worth);
        if (accelerate(task, turn)) return false;
        return interior || (!descend(task, GradientStep::spectral, turn) &&
                            !descend(task, GradientStep::accelerated, turn));
    }

    void note(std::string_view engine, const SolveReport& part, double residual) {
        const int before = report_.iterations;
        for (const ResidualSample& s : part.history)
            report_.history.push_back({before + s.iteration, s.residual});
        report_.iterations += part.iterations;
        report_.stages.push_back({engine, part.iterations, residual});
    }
    /// Before an engine that may leave worse impulses than it was given.
    void keep(std::span<const Vector<Dim>> r) {
        memory_.keep(r, report_.iterations == 0 ? ImpulseMemory<Dim>::unknown : report_.residual);
    }

    // Sweeps. All return true if the solve is over.

    template <class T>
    bool sweep(T& task, int sweeps) {
        gauss_seidel_.params = {.max_sweeps = std::min(sweeps, sweeps_left_),
                                .tolerance = params.tolerance};
        return sweep_with("gauss_seidel", gauss_seidel_, task, 1);
    }
    template <class Engine, class T>
    bool sweep_with(std::string_view name, Engine& engine, T& task, int sweeps) {
        keep(task.r);
        const SolveReport& part = engine.solve(task.w, task.free_velocity, task.laws, task.r);
        note(name, part, part.residual);
        report_.status = part.status;
        report_.residual = part.residual;
        sweeps_left_ -= sweeps * part.iterations;
        return is_over(task);
    }
    template <class T>
    bool accelerate(T& task, int passes) {
        constexpr int longest = 4000;
        last_passes_ = std::min({passes, longest, sweeps_left_ / 2});
        if (last_passes_ == 0) return true;
        // The accelerator that gained more per pass when it was last used; both are tried first,
        // unless one is about to be done.
        const std::size_t momentum = ends_soon() ? last_used_ : speed_[1] > speed_[0];
        last_used_ = momentum;
        const double before = report_.residual;
        accelerated_.params = {
            .max_iterations = last_passes_,
            .tolerance = params.tolerance,
            .acceleration = momentum ? Acceleration::nesterov : Acceleration::anderson};
        const bool over = sweep_with(momentum ? "nesterov" : "anderson", accelerated_, task, 2);
        const int done = accelerated_.report().iterations;
        speed_[momentum] = done > 0 ? std::log(before / report_.residual) / done : 0.0;
        passes_ += done;
        if (over) return true;
        // It ended before its time: nothing moves any more, and no sweep will change that.
        if (done < last_passes_) {
            report_.status = SolveStatus::stalled;
            sweeps_left_ = 0;
        }
        return false;
    }
    /// Double sweeps that the tolerance will take at a rate.
    double passes_to_go(double speed) const {
        const double wanted = std::log(report_.residual / std::max(params.tolerance, 1e-16));
        constexpr double never = 1e9;
        return speed > 0.0 ? wanted / speed : never;
    }
    /// Whether the accelerator used last needs no more passes than it was just given.
    bool ends_soon() const {
        return passes_ > 0 && sweeps_left_ > 1 && passes_to_go(speed_[last_used_]) <= last_passes_;
    }

    // Engines that treat all contacts at once.

    /// The problem for them. False if there are laws that they cannot work on.
    template <class T>
    bool take_system(T& task) {
        if (params.max_factorizations == 0) return false;
        auto cones = cones_of<Dim>(task.laws);
        if (!cones) return false;
        measure_.prepare(task.w);
        system_.assign(task.source(), task.free_velocity, std::move(*cones), measure_);
        constexpr double cost_of_pass = 2.6;  // visits of each contact
        passes_per_factorization_ = system_.factorization_cost() / (cost_of_pass * task.visits);
        if (system_.factorization_bytes() > params.max_factor_bytes) factorizations_left_ = 0;
        return true;
    }
    void start_cone_engines(std::span<const Vector<Dim>> r) {
        system_.to_scaled(r, scaled_);
        scaled_residual_ = report_.residual;
    }
    template <class Engine>
    void improve(std::string_view name, Engine& engine, int at_most) {
        engine.params.tolerance = params.tolerance;
        engine.params.max_iterations = at_most;
        scaled_residual_ = engine.improve(system_, scaled_, scaled_residual_);
        note(name, engine.report(), scaled_residual_);
    }
    template <class Engine>
    void factorize(std::string_view name, Engine& engine, int at_most) {
        at_most = std::min(at_most, factorizations_left_);
        if (at_most == 0 || scaled_residual_ <= params.tolerance) return;
        improve(name, engine, at_most);
        factorizations_left_ -= engine.report().iterations;
    }
    void polish(int at_most) {
        polished_at_ = scaled_residual_;
        factorize("newton_polish", polish_, at_most);
    }
    /// Near a solution, and where the last polish has not been already.
    void polish_where_new(int at_most) {
        constexpr double settled = 1e-2, clear = 0.03;
        if (scaled_residual_ < std::min(settled, clear * polished_at_)) polish(at_most);
    }
    template <class T>
    bool descend(T& task, GradientStep step, int products) {
        products = std::min(products, sweeps_left_);
        if (products == 0) return true;
        start_cone_engines(task.r);
        gradient_.params.step = step;
        improve(step == GradientStep::spectral ? "spectral_gradient" : "accelerated_gradient",
                gradient_, products);
        sweeps_left_ -= gradient_.report().iterations;
        return take_over(task);
    }
    /// Takes the impulses of these engines if they are better by the one measure. True if the solve
    /// is over.
    template <class T>
    bool take_over(T& task) {
        keep(task.r);
        system_.to_impulses(scaled_, task.r);
        velocity_.resize(task.r.size());
        task.w.multiply(task.r, velocity_);
        const double residual =
            measure_
                .template evaluate<Law>(task.free_velocity, task.laws, task.r,
                                        [&](std::size_t i) { return velocity_[i]; })
                .relative;
        if (residual <= report_.residual)
            report_.residual = residual;
        else
            memory_.return_to_kept(task.r);
        report_.history.push_back({report_.iterations, report_.residual});
        if (report_.residual <= params.tolerance) report_.status = SolveStatus::converged;
        return is_over(task);
    }

    /// Whether the engine that has just worked ended the solve. Impulses that run away make any
    /// residual small: large ones must show that they may be, or those kept before them return.
    template <class T>
    bool is_over(T& task) {
        if (report_.status == SolveStatus::not_finite) return true;
        if (report_.status != SolveStatus::converged) return false;
        if (runs_away(task) && cannot_separate(task)) {
            memory_.return_to_kept(task.r);
            report_.residual = memory_.kept_residual(report_.history.front().residual);
            report_.status = SolveStatus::no_solution;
        }
        return true;
    }
    template <class T>
    bool runs_away(T& task) {
        constexpr double suspicious = 1e5;
        measure_.prepare(task.w);
        velocity_.assign(task.r.size(), Vector<Dim>::Zero());
        return measure_.scale(velocity_, task.r) >
               suspicious * measure_.scale(task.free_velocity, velocity_);
    }
    template <class T>
    bool cannot_separate(T& task) {
        auto cones = cones_of<Dim>(task.laws);
        if (!cones) return false;
        for (FrictionCone<Dim>& cone : *cones) cone.mu = 0.0;
        system_.assign(task.source(), task.free_velocity, std::move(*cones), measure_);
        return certificate_.by_sweeps(task.w, task.free_velocity, system_) ||
               certificate_.by_newton(polish_, system_);
    }

    GaussSeidel<Dim, Law> gauss_seidel_;
    AcceleratedGaussSeidel<Dim, Law> accelerated_;
    InteriorPoint<Dim, Law> interior_;
    NewtonPolish<Dim, Law> polish_;
    ProximalNewton<Dim, Law> proximal_;
    ProjectedGradient<Dim, Law> gradient_;
    DelassusProduct<Dim> product_;
    DelassusProduct<Dim, double> scalar_product_;
    System system_;
    ResidualMeasure<Dim> measure_;
    ImpulseMemory<Dim> memory_;
    std::vector<Vector<Dim>> velocity_;
    OverlapCertificate<Dim> certificate_;
    Eigen::VectorXd scaled_;
    SolveReport report_;
    int sweeps_left_ = 0, factorizations_left_ = 0;
    int last_passes_ = 0, passes_ = 0;
    std::array<double, 2> speed_{};  ///< digits (natural) per pass: anderson, nesterov
    std::size_t last_used_ = 0;      ///< index into speed_
    double passes_per_factorization_ = 0.0;
    double scaled_residual_ = 0.0, polished_at_ = 0.0;
};

// Not inline, so that `extern template class` spares a user all of it.

template <int Dim, ContactLaw<Dim> Law>
const SolveReport& Automatic<Dim, Law>::solve(const ContactProblem<Dim, Law>& problem,
                                              std::span<Vector<Dim>> r) {
    const auto source = [&] { return BodyMap<Dim>(problem.jacobian, problem.inverse_mass); };
    const double visits = static_cast<double>(problem.contact_count());
    if (has_scalar_inertia(problem.inverse_mass)) {
        scalar_product_.assign(problem.jacobian, problem.inverse_mass);
        return run(scalar_product_, problem.free_velocity, problem.laws, r, visits, source);
    }
    product_.assign(problem.jacobian, problem.inverse_mass);
    return run(product_, problem.free_velocity, problem.laws, r, visits, source);
}

template <int Dim, ContactLaw<Dim> Law>
const SolveReport& Automatic<Dim, Law>::solve(DelassusSparse<Dim>& w,
                                              std::span<const Vector<Dim>> free_velocity,
                                              std::span<const Law> laws, std::span<Vector<Dim>> r) {
    return run(w, free_velocity, laws, r, sweep_visits(w),
               [&]() -> const DelassusSparse<Dim>& { return w; });
}

template <int Dim, ContactLaw<Dim> Law>
const SolveReport& Automatic<Dim, Law>::solve(DelassusGlobal<Dim>& w,
                                              std::span<const Vector<Dim>> free_velocity,
                                              std::span<const Law> laws, std::span<Vector<Dim>> r) {
    const double visits = sweep_visits(w.assembled());
    if (w.bodies() == nullptr)
        return run(w, free_velocity, laws, r, visits,
                   [&]() -> const DelassusSparse<Dim>& { return w.assembled(); });
    return run(w, free_velocity, laws, r, visits, [&] { return *w.bodies(); });
}

}  // namespace talus
