// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/law/cone_of.hpp>
#include <talus/problem/residual.hpp>
#include <talus/solver/cones/interior_point.hpp>
#include <talus/solver/cones/newton_polish.hpp>
#include <talus/solver/cones/overlap_certificate.hpp>
#include <talus/solver/cones/projected_gradient.hpp>
#include <talus/solver/cones/proximal_newton.hpp>
#include <talus/solver/report.hpp>
#include <talus/solver/sweeps/sweep_kernel.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <functional>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace talus {

/// A problem that Automatic solves, and its impulses.
template <int Dim, LawWithoutRolling<Dim> Law, class W>
struct AutomaticTask : SweepTask<Dim, Law, W> {
    double visits;  ///< of contacts in a sweep
    /// What a ConeSystem takes of W: the bodies it is made of, or its blocks where none are known.
    const DelassusSparse<Dim>* blocks = nullptr;
    std::function<BodyMap<Dim>()> bodies = {};
};

/// The engines of Automatic that treat all contacts at once, on one problem that they all see in
/// the same scaled form. Empty for laws that have no cone: nothing of these engines is compiled
/// then.
template <int Dim, LawWithoutRolling<Dim> Law>
class ConeTeam {};

template <int Dim, ConeLaw<Dim> Law>
class ConeTeam<Dim, Law> {
  public:
    /// Before a solve: what may be spent on it.
    void begin(double tolerance, int factorizations, double max_bytes) {
        tolerance_ = tolerance;
        factorizations_left_ = factorizations;
        max_bytes_ = max_bytes;
        polished_at_ = unpolished;
        overlap_proven_ = false;
    }
    /// Takes the problem in, and what its solve began with. False if a contact has no cone, as one
    /// of AnyLaw's may.
    template <class T>
    bool take(T& task, std::span<const Vector<Dim>> start, ResidualMeasure<Dim>& measure) {
        auto cones = cones_of<Dim>(task.laws);
        if (!cones) return false;
        measure.template prepare<std::remove_reference_t<decltype(task.w)>, Law>(
            task.w, task.free_velocity, task.laws, start);
        assign(task, std::move(*cones), measure);
        return true;
    }
    /// In visits of a contact.
    double factorization_cost() { return system_.factorization_cost(); }
    bool may_factorize() const { return factorizations_left_ > 0; }

    /// The engines below go on from r, whose residual is given, one after the other, and add a
    /// stage each to the report.
    void start(std::span<const Vector<Dim>> r, double residual) {
        system_.to_scaled(r, scaled_);
        residual_ = residual;
    }
    void to_impulses(std::span<Vector<Dim>> r) const { system_.to_impulses(scaled_, r); }

    /// InteriorPoint from a margin, ProximalNewton, NewtonPolish and the gradients.
    void follow_path(double margin, int at_most, SolveReport& report) {
        interior_.params.margin = margin;
        factorize("interior_point", interior_, at_most, report);
    }
    void approach(int at_most, SolveReport& report) {
        if (factorize("proximal_newton", proximal_, at_most, report))
            overlap_proven_ = proximal_.report().status == SolveStatus::no_solution;
    }
    void polish(int at_most, SolveReport& report) {
        polished_at_ = residual_;
        factorize("newton_polish", polish_, at_most, report);
    }
    /// Near a solution, and where the last polish has not been already.
    void polish_where_new(int at_most, SolveReport& report) {
        constexpr double settled = 1e-2, clear = 0.03;
        if (residual_ < std::min(settled, clear * polished_at_)) polish(at_most, report);
    }
    /// Returns the products with W that it took.
    int descend(GradientStep step, int products, SolveReport& report) {
        gradient_.params.step = step;
        improve(step == GradientStep::spectral ? "spectral_gradient" : "accelerated_gradient",
                gradient_, products, report);
        return gradient_.report().iterations;
    }

    /// Whether the engines have met a proof that no solution exists; a path that broke off is a
    /// reason to look for one.
    template <class T>
    bool proves_overlap(T& task, bool path_broke_off) {
        return overlap_proven_ ||
               (path_broke_off && certificate_.by_sweeps(task.w, task.free_velocity, system_));
    }
    /// Whether there is a proof for the problem without friction, which is then the one held. Its
    /// factorisations are of what may be spent on the solve.
    template <class T>
    bool cannot_separate(T& task, const ResidualMeasure<Dim>& measure) {
        auto cones = cones_of<Dim>(task.laws);
        if (!cones) return false;
        for (FrictionCone<Dim>& cone : *cones) cone.mu = 0.0;
        assign(task, std::move(*cones), measure);
        if (certificate_.by_sweeps(task.w, task.free_velocity, system_)) return true;
        if (!may_factorize()) return false;
        constexpr int usual_steps = 30;
        const bool proven =
            certificate_.by_newton(polish_, system_, std::min(usual_steps, factorizations_left_));
        factorizations_left_ -= polish_.report().iterations;
        return proven;
    }

  private:
    static constexpr double unpolished = 1e9;

    template <class T>
    void assign(T& task, std::vector<FrictionCone<Dim>> cones,
                const ResidualMeasure<Dim>& measure) {
        if (task.blocks != nullptr)
            system_.assign(*task.blocks, task.free_velocity, std::move(cones), measure);
        else
            system_.assign(task.bodies(), task.free_velocity, std::move(cones), measure);
        if (system_.factorization_bytes() > max_bytes_) factorizations_left_ = 0;
    }

    template <class Engine>
    void improve(std::string_view name, Engine& engine, int at_most, SolveReport& report) {
        engine.params.tolerance = tolerance_;
        engine.params.max_iterations = at_most;
        residual_ = engine.improve(system_, scaled_, residual_);
        report.add_stage(name, engine.report(), residual_);
    }
    /// False if there was nothing to do, or nothing left to do it with.
    template <class Engine>
    bool factorize(std::string_view name, Engine& engine, int at_most, SolveReport& report) {
        at_most = std::min(at_most, factorizations_left_);
        // The budget is one for all engines of a solve.
        if (at_most == 0 || residual_ <= tolerance_) return false;
        improve(name, engine, at_most, report);
        factorizations_left_ -= engine.report().iterations;
        return true;
    }

    InteriorPoint<Dim, Law> interior_;
    NewtonPolish<Dim, Law> polish_;
    ProximalNewton<Dim, Law> proximal_;
    ProjectedGradient<Dim, Law> gradient_;
    OverlapCertificate<Dim> certificate_;
    ConeSystem<Dim> system_;  ///< lent to one engine at a time, with its factors' plan
    Eigen::VectorXd scaled_;  ///< the impulses that engines hand to each other
    double tolerance_ = 0.0, residual_ = 0.0, polished_at_ = unpolished, max_bytes_ = 0.0;
    int factorizations_left_ = 0;
    bool overlap_proven_ = false;  ///< by the proximal engine, in this solve
};

}  // namespace talus
