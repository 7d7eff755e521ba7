// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/column.hpp>
#include <talus/core/input.hpp>
#include <talus/core/instantiate.hpp>
#include <talus/law/cone_of.hpp>
#include <talus/law/coulomb.hpp>
#include <talus/law/weighted_mean.hpp>
#include <talus/solver/cone_team.hpp>
#include <talus/solver/impulse_memory.hpp>
#include <talus/solver/sweeps/accelerated_gauss_seidel.hpp>
#include <talus/solver/sweeps/gauss_seidel.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string_view>
#include <type_traits>

namespace talus {

struct AutomaticParams {
    /// On the residual of problem/residual.hpp [-].
    double tolerance = 1e-8;
    /// Sweeps allowed in all [-], not negative. A double sweep counts as two, a product with W in a
    /// gradient method as one. (A look for a proof that nothing solves the problem adds 64.)
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
/// the same input takes the same way on a machine, to the bit. Engines that treat all contacts at
/// once need laws with a cone (law/cone_of.hpp); with others sweeps do everything.
///
/// The report's `stages` tell who did what; `iterations` counts those of all engines (a proof's
/// factorisations are in neither, but within `max_factorizations`). `no_solution` is reported where
/// there is a certificate: normal impulses that move nothing and yet would gain energy from the
/// prescribed motion, so that no motion separates all contacts.
template <int Dim, LawWithoutRolling<Dim> Law>
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
    template <class W>
    using Task = AutomaticTask<Dim, Law, W>;

    template <class W>
    const SolveReport& run(Task<W> task) {
        require_non_negative("tolerance", params.tolerance);
        require_non_negative("max_sweeps", params.max_sweeps);
        require_non_negative("max_factorizations", params.max_factorizations);
        require_non_negative("max_factor_bytes", params.max_factor_bytes);
        report_ = {};
        start_.assign(task.r.begin(), task.r.end());
        let_engines_work(task);
        if (report_.status != SolveStatus::not_finite) {
            memory_.return_to_best(task.r, report_.residual);
            judge_contacts(task);
        }
        // An engine that gained nothing leaves samples of what it tried at the end.
        if (report_.history.back().residual != report_.residual)
            report_.history.push_back({report_.iterations, report_.residual});
        return report_;
    }

    /// What the report says of single contacts: of the impulses returned, which need not be those
    /// measured last.
    template <class T>
    void judge_contacts(T& task) {
        measure_.template prepare<std::remove_reference_t<decltype(task.w)>, Law>(
            task.w, task.free_velocity, task.laws, start_);
        task.w.start(task.r);
        const Residual now =
            measure_.template evaluate<Law>(task.free_velocity, task.laws, task.r,
                                            [&](std::size_t i) { return task.w.velocity(i); });
        report_.take(now);
        // An engine that went on from impulses of another one took them for a jam's. (What is
        // beyond the tolerance by rounding alone was below it as measured on the way.)
        constexpr double slack = 1.0 + 1e-6;
        if (report_.status == SolveStatus::converged &&
            now.relative > slack * params.tolerance + Residual::share_of_contact * now.rounding)
            report_.status = SolveStatus::stalled;
    }

    template <class T>
    void let_engines_work(T& task) {
        sweeps_left_ = params.max_sweeps;
        if constexpr (ConeLaw<Law, Dim>)
            team_.begin(params.tolerance, params.max_factorizations, params.max_factor_bytes);
        passes_ = 0;
        memory_.clear();
        constexpr double untried = 1e9;
        // Anderson first: the faster one on small problems.
        speed_ = {2.0 * untried, untried};
        // Enough for most warm-started steps, and cheap beside anything that follows.
        constexpr int first_sweeps = 6, first_passes = 15;
        if (sweep(task, first_sweeps) || accelerate(task, first_passes)) return;
        while (ends_soon())
            if (accelerate(task, 2 * last_passes_)) return;
        if constexpr (ConeLaw<Law, Dim>)
            if (take_system(task)) return take_turns(task);
        while (!accelerate(task, 2 * last_passes_)) {
        }
    }

    /// Sweeps beside the engines that treat all contacts at once.
    template <class T>
    void take_turns(T& task) {
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
        // Paths from elsewhere may go through where the first one turned back.
        constexpr std::array margins{0.1, 1.0, 0.01};
        const bool interior = round < static_cast<int>(margins.size());
        if (team_.may_factorize()) {
            team_.start(task.r, report_.residual);
            team_.polish_where_new(8, report_);
            if (interior)
                team_.follow_path(margins[static_cast<std::size_t>(round)], 60, report_);
            else
                team_.approach(std::max(60, static_cast<int>(worth / passes_per_factorization_)),
                               report_);
            team_.polish(20, report_);
            if (take_over(task)) return false;
            if (team_.proves_overlap(task, interior)) {
                report_.status = SolveStatus::no_solution;
                return false;
            }
        }
        const int turn = static_cast<int>(worth);
        if (accelerate(task, turn)) return false;
        return interior || (!descend(task, GradientStep::spectral, turn) &&
                            !descend(task, GradientStep::accelerated, turn));
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
        report_.add_stage(name, part, part.residual);
        report_.status = part.status;
        report_.residual = part.residual;
        sweeps_left_ -= sweeps * part.iterations;
        return is_over(task);
    }
    template <class T>
    bool accelerate(T& task, int passes) {
        // Between two looks at who is the faster one.
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
            .acceleration = momentum ? Acceleration::nesterov : Acceleration::anderson,
            .patience = 0};
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
        if (!team_.take(task, start_, measure_)) return false;
        constexpr double cost_of_pass = 2.6;  // visits of each contact
        passes_per_factorization_ = team_.factorization_cost() / (cost_of_pass * task.visits);
        return true;
    }
    template <class T>
    bool descend(T& task, GradientStep step, int products) {
        products = std::min(products, sweeps_left_);
        if (products == 0) return true;
        team_.start(task.r, report_.residual);
        sweeps_left_ -= team_.descend(step, products, report_);
        return take_over(task);
    }
    /// Takes the impulses of these engines if they are better by the one measure. True if the solve
    /// is over.
    template <class T>
    bool take_over(T& task) {
        keep(task.r);
        team_.to_impulses(task.r);
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
        if constexpr (ConeLaw<Law, Dim>)
            return team_.cannot_separate(task, measure_);
        else
            return false;
    }

    GaussSeidel<Dim, Law> gauss_seidel_;
    AcceleratedGaussSeidel<Dim, Law> accelerated_;
    ConeTeam<Dim, Law> team_;
    RigidBodyOperators<Dim> bodies_;
    ResidualMeasure<Dim> measure_;
    ImpulseMemory<Dim> memory_;
    Column<Vector<Dim>> velocity_, start_;
    SolveReport report_;
    int sweeps_left_ = 0;
    int last_passes_ = 0, passes_ = 0;
    std::array<double, 2> speed_{};  ///< digits (natural) per pass: anderson, nesterov
    std::size_t last_used_ = 0;      ///< index into speed_
    double passes_per_factorization_ = 0.0;
};

// Not inline, so that `extern template class` spares a user all of it.

template <int Dim, LawWithoutRolling<Dim> Law>
const SolveReport& Automatic<Dim, Law>::solve(const ContactProblem<Dim, Law>& problem,
                                              std::span<Vector<Dim>> r) {
    const auto solve_with = [&](auto& w) -> const SolveReport& {
        return run(Task<std::remove_reference_t<decltype(w)>>{
            {w, problem.free_velocity, problem.laws, r},
            static_cast<double>(problem.contact_count()),
            nullptr,
            [&problem] { return BodyMap<Dim>(problem.jacobian, problem.inverse_mass); }});
    };
    return bodies_.with(problem.jacobian, problem.inverse_mass, solve_with);
}

template <int Dim, LawWithoutRolling<Dim> Law>
const SolveReport& Automatic<Dim, Law>::solve(DelassusSparse<Dim>& w,
                                              std::span<const Vector<Dim>> free_velocity,
                                              std::span<const Law> laws, std::span<Vector<Dim>> r) {
    return run(Task<DelassusSparse<Dim>>{{w, free_velocity, laws, r}, sweep_visits(w), &w});
}

template <int Dim, LawWithoutRolling<Dim> Law>
const SolveReport& Automatic<Dim, Law>::solve(DelassusGlobal<Dim>& w,
                                              std::span<const Vector<Dim>> free_velocity,
                                              std::span<const Law> laws, std::span<Vector<Dim>> r) {
    DelassusSparse<Dim>& blocks = w.assembled();
    if (w.bodies() == nullptr) return solve(blocks, free_velocity, laws, r);
    return run(Task<DelassusSparse<Dim>>{
        {blocks, free_velocity, laws, r}, sweep_visits(blocks), nullptr, [&w] {
            return *w.bodies();
        }});
}

}  // namespace talus

TALUS_IN_PLANE(class talus::Automatic<2, talus::Coulomb<2>>)
TALUS_IN_PLANE(class talus::Automatic<2, talus::WeightedMean<2, talus::Coulomb<2>>>)
TALUS_IN_SPACE(class talus::Automatic<3, talus::Coulomb<3>>)
TALUS_IN_SPACE(class talus::Automatic<3, talus::WeightedMean<3, talus::Coulomb<3>>>)
