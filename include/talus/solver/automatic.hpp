// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/law/cone_of.hpp>
#include <talus/solver/accelerated_gauss_seidel.hpp>
#include <talus/solver/gauss_seidel.hpp>
#include <talus/solver/interior_point.hpp>
#include <talus/solver/newton_polish.hpp>
#include <talus/solver/overlap_certificate.hpp>

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
    /// Sweeps allowed in all, a double sweep counting as two [-], not negative.
    int max_sweeps = 40000;
    /// Factorisations allowed in all [-], not negative. 0 leaves everything to sweeps.
    int max_factorizations = 120;
    /// Memory that the factors may take [bytes], not negative. A problem that needs more is left to
    /// sweeps.
    double max_factor_bytes = 2e9;
};

/// The solver to use when nothing is known of the problem. Engines take turns on the same impulses:
///
///   gauss_seidel     a few sweeps: enough for small and for well warm-started problems;
///   anderson, nesterov  accelerated double sweeps, by whichever gains more, as long as that
///                    promises an end before that of a factorising engine;
///   newton_polish    once the residual is small, where a factor is cheap beside sweeps to come;
///   interior_point   for what sweeps do not finish, followed by newton_polish again;
///   anderson, nesterov  for the rest of the sweeps, if there is still something to do.
///
/// Costs are counted in visits of contacts, from the structure of the problem and never by a clock:
/// the same input takes the same way on any machine, to the bit. Engines that treat all contacts at
/// once need laws with a cone (law/cone_of.hpp); with others sweeps do everything.
///
/// The report's `stages` tell who did what; `iterations` counts those of all engines. `no_solution`
/// is reported where sweeps end with a certificate: normal impulses that move nothing and yet would
/// gain energy from the prescribed motion, so that no motion separates all contacts.
template <int Dim, ContactLaw<Dim> Law>
class Automatic {
  public:
    explicit Automatic(AutomaticParams params = {}) : params(params) {}
    AutomaticParams params;

    /// Solves `problem` from the warm start `r`, into `r`. Throws input_error on parameters out of
    /// range or arrays of different lengths.
    const SolveReport& solve(const ContactProblem<Dim, Law>& problem, std::span<Vector<Dim>> r) {
        const auto source = [&] { return BodyMap<Dim>(problem.jacobian, problem.inverse_mass); };
        const double visits = static_cast<double>(problem.contact_count());
        if (has_scalar_inertia(problem.inverse_mass)) {
            scalar_product_.assign(problem.jacobian, problem.inverse_mass);
            return run(scalar_product_, problem.free_velocity, problem.laws, r, visits, source);
        }
        product_.assign(problem.jacobian, problem.inverse_mass);
        return run(product_, problem.free_velocity, problem.laws, r, visits, source);
    }
    const SolveReport& solve(AssembledProblem<Dim, Law>& problem, std::span<Vector<Dim>> r) {
        return solve(problem.delassus, problem.free_velocity, problem.laws, r);
    }
    const SolveReport& solve(DelassusSparse<Dim>& w, std::span<const Vector<Dim>> free_velocity,
                             std::span<const Law> laws, std::span<Vector<Dim>> r) {
        return run(w, free_velocity, laws, r, visits_of(w),
                   [&]() -> const DelassusSparse<Dim>& { return w; });
    }
    const SolveReport& solve(DelassusGlobal<Dim>& w, std::span<const Vector<Dim>> free_velocity,
                             std::span<const Law> laws, std::span<Vector<Dim>> r) {
        const double visits = visits_of(w.assembled());
        if (w.bodies() == nullptr)
            return run(w, free_velocity, laws, r, visits,
                       [&]() -> const DelassusSparse<Dim>& { return w.assembled(); });
        return run(w, free_velocity, laws, r, visits, [&] { return *w.bodies(); });
    }

    const SolveReport& report() const { return report_; }  ///< of the last solve

  private:
    using System = ConeSystem<Dim>;

    /// A sweep of an assembled W costs its blocks, of which five are one visit of a contact.
    static double visits_of(const DelassusSparse<Dim>& w) {
        return 0.5 * static_cast<double>(w.contact_count()) +
               0.2 * static_cast<double>(w.block_count());
    }

    template <class W, class Source>
    const SolveReport& run(W& w, std::span<const Vector<Dim>> free_velocity,
                           std::span<const Law> laws, std::span<Vector<Dim>> r, double visits,
                           Source&& source) {
        require_non_negative("tolerance", params.tolerance);
        require_non_negative("max_sweeps", params.max_sweeps);
        require_non_negative("max_factorizations", params.max_factorizations);
        require_non_negative("max_factor_bytes", params.max_factor_bytes);
        report_ = {};
        let_engines_work(w, free_velocity, laws, r, visits, source);
        // An engine that gained nothing leaves samples of what it tried at the end.
        if (report_.history.back().residual != report_.residual)
            report_.history.push_back({report_.iterations, report_.residual});
        if (report_.status != SolveStatus::converged) return report_;
        measure_.prepare(w);
        if (!run_away(free_velocity, r)) return report_;
        if (auto cones = cones_of<Dim>(laws)) {
            for (FrictionCone<Dim>& cone : *cones) cone.mu = 0.0;
            system_.assign(source(), free_velocity, std::move(*cones), measure_);
            if (certificate_.by_sweeps(w, free_velocity, system_) ||
                certificate_.by_newton(polish_, system_))
                report_.status = SolveStatus::no_solution;
        }
        return report_;
    }

    template <class W, class Source>
    const SolveReport& let_engines_work(W& w, std::span<const Vector<Dim>> free_velocity,
                                        std::span<const Law> laws, std::span<Vector<Dim>> r,
                                        double visits, Source&& source) {
        sweeps_left_ = params.max_sweeps;
        passes_ = 0;
        constexpr double untried = 1e9;
        speed_ = {2.0 * untried, untried};
        constexpr int first_sweeps = 6, first_passes = 15;
        sweep(w, free_velocity, laws, r, first_sweeps);
        if (finished()) return report_;
        if (accelerate(w, free_velocity, laws, r, first_passes)) return report_;
        while (ends_soon())
            if (accelerate(w, free_velocity, laws, r, 2 * last_passes_)) return report_;

        if (!take_factors(w, free_velocity, laws, source)) {
            while (accelerate_on(w, free_velocity, laws, r, 2 * last_passes_)) {
            }
            return report_;
        }
        // Double sweeps that cost as much as an interior-point solve, about.
        constexpr double usual_factorizations = 15.0, cost_of_pass = 2.6;
        const double worth =
            usual_factorizations * system_.factorization_cost() / (cost_of_pass * visits);
        // Sweeps go on while they promise an end soon, and at least for a quarter of that cost.
        while (sweeps_left_ > 1 && (passes_ < 0.25 * worth ||
                                    passes_to_go(std::max(speed_[0], speed_[1])) < 0.5 * worth))
            if (accelerate(w, free_velocity, laws, r, 2 * last_passes_)) return report_;
        factorizations_left_ = params.max_factorizations;
        for (const double margin : {0.1, 1.0, 0.01}) {
            if (factorizations_left_ == 0) break;
            if (factorize_all(w, free_velocity, laws, r, margin)) return report_;
            if (certificate_.by_sweeps(w, free_velocity, system_)) {
                report_.status = SolveStatus::no_solution;
                return report_;
            }
            constexpr double most = 1e6;
            if (!accelerate_on(w, free_velocity, laws, r,
                               static_cast<int>(std::clamp(worth, 20.0, most))))
                return report_;
        }
        while (accelerate_on(w, free_velocity, laws, r, 2 * last_passes_)) {
            constexpr double clear = 0.03;  // of the residual where statuses were not settled yet
            if (factorizations_left_ == 0 || report_.residual > clear * polished_at_) continue;
            start_factors(r);
            if (polish(8) && take_over(w, free_velocity, laws, r)) return report_;
        }
        return report_;
    }

    /// Polish, interior point, polish. True if the solve is over.
    template <class W>
    bool factorize_all(W& w, std::span<const Vector<Dim>> free_velocity, std::span<const Law> laws,
                       std::span<Vector<Dim>> r, double margin) {
        start_factors(r);
        constexpr double settled = 1e-2;
        if (report_.residual < settled) polish(8);
        if (factor_residual_ > params.tolerance) {
            interior_.params.margin = margin;
            factorize("interior_point", interior_, 60);
            if (factor_residual_ > params.tolerance) polish(20);
        }
        return take_over(w, free_velocity, laws, r);
    }

    bool finished() const {
        return report_.status == SolveStatus::converged ||
               report_.status == SolveStatus::not_finite;
    }

    void note(std::string_view engine, const SolveReport& part) {
        const int before = report_.iterations;
        for (const ResidualSample& s : part.history)
            report_.history.push_back({before + s.iteration, s.residual});
        report_.iterations += part.iterations;
        report_.status = part.status;
        report_.residual = part.residual;
        report_.stages.push_back({engine, part.iterations, part.residual});
    }

    template <class W>
    void sweep(W& w, std::span<const Vector<Dim>> free_velocity, std::span<const Law> laws,
               std::span<Vector<Dim>> r, int sweeps) {
        gauss_seidel_.params = {.max_sweeps = std::min(sweeps, sweeps_left_),
                                .tolerance = params.tolerance};
        note("gauss_seidel", gauss_seidel_.solve(w, free_velocity, laws, r));
        sweeps_left_ -= gauss_seidel_.report().iterations;
    }

    /// True if the solve is over.
    template <class W>
    bool accelerate(W& w, std::span<const Vector<Dim>> free_velocity, std::span<const Law> laws,
                    std::span<Vector<Dim>> r, int passes) {
        last_passes_ = std::min(passes, sweeps_left_ / 2);
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
        note(momentum ? "nesterov" : "anderson", accelerated_.solve(w, free_velocity, laws, r));
        const int done = accelerated_.report().iterations;
        speed_[momentum] = done > 0 ? std::log(before / report_.residual) / done : 0.0;
        sweeps_left_ -= 2 * done;
        passes_ += done;
        if (finished()) return true;
        // It ended before its time: nothing moves any more, and no sweep will change that.
        if (done < last_passes_) {
            report_.status = SolveStatus::stalled;
            sweeps_left_ = 0;
        }
        return false;
    }
    /// The same, the other way round.
    template <class W>
    bool accelerate_on(W& w, std::span<const Vector<Dim>> free_velocity, std::span<const Law> laws,
                       std::span<Vector<Dim>> r, int passes) {
        constexpr int longest = 4000;
        return !accelerate(w, free_velocity, laws, r, std::min(passes, longest));
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

    /// The problem for the factorising engines. False if they may not or cannot work on it.
    template <class W, class Source>
    bool take_factors(const W& w, std::span<const Vector<Dim>> free_velocity,
                      std::span<const Law> laws, Source&& source) {
        if (params.max_factorizations == 0) return false;
        auto cones = cones_of<Dim>(laws);
        if (!cones) return false;
        measure_.prepare(w);
        system_.assign(source(), free_velocity, std::move(*cones), measure_);
        return system_.factorization_bytes() <= params.max_factor_bytes;
    }
    void start_factors(std::span<const Vector<Dim>> r) {
        system_.to_scaled(r, scaled_);
        factor_residual_ = report_.residual;
    }
    bool polish(int at_most) {
        polished_at_ = factor_residual_;
        factorize("newton_polish", polish_, at_most);
        return factor_residual_ < polished_at_;
    }
    template <class Engine>
    void factorize(std::string_view name, Engine& engine, int at_most) {
        engine.params.tolerance = params.tolerance;
        engine.params.max_iterations = std::min(at_most, factorizations_left_);
        if (engine.params.max_iterations == 0) return;
        factor_residual_ = engine.improve(system_, scaled_, factor_residual_);
        factorizations_left_ -= engine.report().iterations;
        for (const ResidualSample& s : engine.report().history)
            report_.history.push_back({report_.iterations + s.iteration, s.residual});
        report_.iterations += engine.report().iterations;
        report_.stages.push_back({name, engine.report().iterations, factor_residual_});
    }

    /// Impulses that run away make any residual small: large ones must show that they may be.
    static constexpr double suspicious = 1e5;
    bool runs_away() const { return scaled_.norm() > suspicious * system_.free_velocity().norm(); }
    bool run_away(std::span<const Vector<Dim>> free_velocity, std::span<const Vector<Dim>> r) {
        velocity_.assign(r.size(), Vector<Dim>::Zero());
        return measure_.scale(velocity_, r) > suspicious * measure_.scale(free_velocity, velocity_);
    }
    /// Takes the impulses of the factorising engines if they are better by the one measure.
    template <class W>
    bool take_over(W& w, std::span<const Vector<Dim>> free_velocity, std::span<const Law> laws,
                   std::span<Vector<Dim>> r) {
        kept_.assign(r.begin(), r.end());
        system_.to_impulses(scaled_, r);
        velocity_.resize(r.size());
        w.multiply(r, velocity_);
        const double residual =
            measure_
                .template evaluate<Law>(free_velocity, laws, r,
                                        [&](std::size_t i) { return velocity_[i]; })
                .relative;
        if (!(residual <= report_.residual)) {
            std::copy(kept_.begin(), kept_.end(), r.begin());
        } else if (residual <= params.tolerance && runs_away() &&
                   certificate_.by_sweeps(w, free_velocity, system_)) {
            std::copy(kept_.begin(), kept_.end(), r.begin());
            report_.history.push_back({report_.iterations, report_.residual});
            report_.status = SolveStatus::no_solution;
            return true;
        } else {
            report_.residual = residual;
        }
        report_.history.push_back({report_.iterations, report_.residual});
        if (report_.residual > params.tolerance) return false;
        report_.status = SolveStatus::converged;
        return true;
    }

    GaussSeidel<Dim, Law> gauss_seidel_;
    AcceleratedGaussSeidel<Dim, Law> accelerated_;
    InteriorPoint<Dim, Law> interior_;
    NewtonPolish<Dim, Law> polish_;
    DelassusProduct<Dim> product_;
    DelassusProduct<Dim, double> scalar_product_;
    System system_;
    ResidualMeasure<Dim> measure_;
    std::vector<Vector<Dim>> kept_, velocity_;
    OverlapCertificate<Dim> certificate_;
    Eigen::VectorXd scaled_;
    SolveReport report_;
    int sweeps_left_ = 0, last_passes_ = 0;
    int factorizations_left_ = 0;
    int passes_ = 0;
    std::array<double, 2> speed_{};  ///< digits (natural) per pass: anderson, nesterov
    std::size_t last_used_ = 0;      ///< index into speed_
    double factor_residual_ = 0.0, polished_at_ = 0.0;
};

}  // namespace talus
