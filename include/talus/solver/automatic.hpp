// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/solver/accelerated_gauss_seidel.hpp>
#include <talus/solver/gauss_seidel.hpp>
#include <talus/solver/interior_point.hpp>
#include <talus/solver/newton_polish.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
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
};

/// The solver to use when nothing is known of the problem. Engines take turns on the same impulses:
///
///   gauss_seidel     a few sweeps: enough for small and for well warm-started problems;
///   anderson         accelerated double sweeps, as long as the digits they gain per sweep promise
///                    an end before that of a factorising engine;
///   newton_polish    once the residual is small, where a factor is cheap beside the sweeps to
///   come; interior_point   for what sweeps do not finish, followed by newton_polish again;
///   anderson         for the rest of the sweeps, if there is still something to do.
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
        report_ = {};
        sweeps_left_ = params.max_sweeps;
        constexpr int first_sweeps = 6, first_passes = 15;
        sweep(w, free_velocity, laws, r, first_sweeps);
        if (finished()) return report_;
        if (accelerate(w, free_velocity, laws, r, first_passes)) return report_;

        const bool factors = params.max_factorizations > 0 && take_cones(laws);
        if (factors) {
            measure_.prepare(w);
            system_.assign(source(), free_velocity, std::move(cones_), measure_);
            const double factor = system_.factorization_cost();
            // Double sweeps that cost as much as an interior-point solve, about.
            const double usual_factorizations = 20.0, pass = 2.6 * visits;
            const double worth = usual_factorizations * factor / pass;
            while (passes_to_go() < 0.5 * worth)
                if (accelerate(w, free_velocity, laws, r, 2 * last_passes_)) return report_;
            int left = params.max_factorizations;
            scaled_.resize(0);
            system_.to_scaled(r, scaled_);
            constexpr double settled = 1e-2;
            double residual = report_.residual;
            if (residual < settled)
                residual = factorize("newton_polish", polish_, 8, residual, left);
            if (residual > params.tolerance)
                residual = factorize("interior_point", interior_, 80, residual, left);
            if (residual > params.tolerance)
                residual = factorize("newton_polish", polish_, 30, residual, left);
            if (take_over(w, free_velocity, laws, r)) return report_;
        }
        while (sweeps_left_ > 1)
            if (accelerate(w, free_velocity, laws, r, 2 * last_passes_)) return report_;
        return report_;
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
        before_ = report_.residual;
        accelerated_.params = {.max_iterations = last_passes_, .tolerance = params.tolerance};
        note("anderson", accelerated_.solve(w, free_velocity, laws, r));
        sweeps_left_ -= 2 * accelerated_.report().iterations;
        return finished();
    }
    /// Double sweeps that the tolerance will take at the rate of the last ones.
    double passes_to_go() const {
        const double gained = std::log(before_ / report_.residual);
        const double wanted = std::log(report_.residual / std::max(params.tolerance, 1e-16));
        constexpr double never = 1e9;
        return gained > 0.0 ? wanted / gained * last_passes_ : never;
    }

    bool take_cones(std::span<const Law> laws) {
        cones_.clear();
        for (const Law& law : laws) {
            const std::optional<FrictionCone<Dim>> cone = cone_of<Dim>(law);
            if (!cone) return false;
            cones_.push_back(*cone);
        }
        return true;
    }

    template <class Engine>
    double factorize(std::string_view name, Engine& engine, int at_most, double residual,
                     int& left) {
        engine.params.tolerance = params.tolerance;
        engine.params.max_iterations = std::min(at_most, left);
        if (left == 0) return residual;
        residual = engine.improve(system_, scaled_, residual);
        left -= engine.report().iterations;
        const int before = report_.iterations;
        for (const ResidualSample& s : engine.report().history)
            report_.history.push_back({before + s.iteration, s.residual});
        report_.iterations += engine.report().iterations;
        report_.stages.push_back({name, engine.report().iterations, residual});
        return residual;
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
        if (residual <= report_.residual)
            report_.residual = residual;
        else
            std::copy(kept_.begin(), kept_.end(), r.begin());
        report_.history.push_back({report_.iterations, report_.residual});
        if (report_.residual <= params.tolerance) report_.status = SolveStatus::converged;
        return finished();
    }

    GaussSeidel<Dim, Law> gauss_seidel_;
    AcceleratedGaussSeidel<Dim, Law> accelerated_;
    InteriorPoint<Dim, Law> interior_;
    NewtonPolish<Dim, Law> polish_;
    DelassusProduct<Dim> product_;
    DelassusProduct<Dim, double> scalar_product_;
    System system_;
    ResidualMeasure<Dim> measure_;
    std::vector<FrictionCone<Dim>> cones_;
    std::vector<Vector<Dim>> kept_, velocity_;
    Eigen::VectorXd scaled_;
    SolveReport report_;
    int sweeps_left_ = 0, last_passes_ = 0;
    double before_ = 0.0;
};

}  // namespace talus
