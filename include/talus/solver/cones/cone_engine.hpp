// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/check.hpp>
#include <talus/core/input.hpp>
#include <talus/law/cone_of.hpp>
#include <talus/problem/matrix_problem.hpp>
#include <talus/problem/residual.hpp>
#include <talus/solver/concepts.hpp>
#include <talus/solver/cones/cone_system.hpp>

#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace talus {

/// What the solvers have in common that treat all contacts at once: how a problem comes in, how the
/// best impulses are kept, and what the report says. `Engine` has `params.tolerance`,
/// `params.max_iterations` and `iterate(r)`, which improves the scaled impulses r by offering
/// iterates; an engine that finds a certificate sets the status to `no_solution`.
template <int Dim, ContactLaw<Dim> Law, class Engine>
class ConeEngine {
  public:
    /// Solves a problem of bodies from the warm start `r`, into `r`. Throws input_error on
    /// parameters out of range or arrays of different lengths.
    const SolveReport& solve(const ContactProblem<Dim, Law>& problem, std::span<Vector<Dim>> r) {
        const DelassusProduct<Dim> w(problem.jacobian, problem.inverse_mass);
        return run(w, problem.free_velocity, problem.laws, r,
                   [&] { return BodyMap<Dim>(problem.jacobian, problem.inverse_mass); });
    }
    /// The same for a problem given by its blocks.
    const SolveReport& solve(const AssembledProblem<Dim, Law>& problem, std::span<Vector<Dim>> r) {
        return solve(problem.delassus, problem.free_velocity, problem.laws, r);
    }
    const SolveReport& solve(const DelassusSparse<Dim>& w,
                             std::span<const Vector<Dim>> free_velocity, std::span<const Law> laws,
                             std::span<Vector<Dim>> r) {
        return run(w, free_velocity, laws, r, [&]() -> const DelassusSparse<Dim>& { return w; });
    }
    const SolveReport& solve(const DelassusGlobal<Dim>& w,
                             std::span<const Vector<Dim>> free_velocity, std::span<const Law> laws,
                             std::span<Vector<Dim>> r) {
        if (w.bodies() == nullptr) return solve(w.assembled(), free_velocity, laws, r);
        return run(w, free_velocity, laws, r, [&] { return *w.bodies(); });
    }

    const SolveReport& report() const { return report_; }  ///< of the last solve

    using System = ConeSystem<Dim>;
    /// Works on a problem that is already in scaled form, lent for the time of the call: improves
    /// `best`, whose residual is given; returns the residual reached. For solvers made of engines.
    double improve(System& system, Eigen::VectorXd& best, double residual) {
        std::swap(system_, system);
        report_ = {};
        best_residual_ = residual;
        engine().iterate(best);
        std::swap(system_, system);
        report_.residual = best_residual_;
        return best_residual_;
    }

  protected:
    /// Notes an iterate; true if the solve is over.
    bool offer(int iteration, const Eigen::VectorXd& r, const Eigen::VectorXd& u,
               Eigen::VectorXd& best) {
        const double residual = system_.residual(r, u);
        report_.iterations = iteration;
        report_.history.push_back({iteration, residual});
        if (residual < best_residual_) {
            best_residual_ = residual;
            best = r;
        }
        return best_residual_ <= engine().params.tolerance;
    }
    double best_residual() const { return best_residual_; }

    System system_;
    SolveReport report_;

  private:
    Engine& engine() { return static_cast<Engine&>(*this); }

    template <class W, class Source>
    const SolveReport& run(const W& w, std::span<const Vector<Dim>> free_velocity,
                           std::span<const Law> laws, std::span<Vector<Dim>> r, Source&& source) {
        require_count("free velocities", free_velocity.size(), w.contact_count());
        require_count("laws", laws.size(), w.contact_count());
        require_count("impulses", r.size(), w.contact_count());
        require_non_negative("max_iterations", engine().params.max_iterations);
        require_non_negative("tolerance", engine().params.tolerance);
        report_ = {};
        measure_.prepare(w);
        const double begin = evaluate(w, free_velocity, laws, r);
        report_.history.push_back({0, begin});
        report_.residual = begin;
        if (!std::isfinite(begin)) {
            report_.status = SolveStatus::not_finite;
            return report_;
        }
        if (begin <= engine().params.tolerance) {
            report_.status = SolveStatus::converged;
            return report_;
        }
        report_.status = SolveStatus::stalled;
        auto cones = cones_of<Dim>(laws);
        if (!cones) return report_;
        system_.assign(source(), free_velocity, std::move(*cones), measure_);
        best_residual_ = begin;
        Eigen::VectorXd best;
        system_.to_scaled(r, best);
        engine().iterate(best);
        if (best_residual_ < begin) {
            kept_.assign(r.begin(), r.end());
            system_.to_impulses(best, r);
            const double end = evaluate(w, free_velocity, laws, r);
            if (end < begin)
                report_.residual = end;
            else
                std::copy(kept_.begin(), kept_.end(), r.begin());
        }
        report_.history.push_back({report_.iterations, report_.residual});
        if (report_.status == SolveStatus::no_solution) return report_;
        if (report_.residual <= engine().params.tolerance)
            report_.status = SolveStatus::converged;
        else if (report_.iterations >= engine().params.max_iterations)
            report_.status = SolveStatus::iteration_limit;
        return report_;
    }

    template <class W>
    double evaluate(const W& w, std::span<const Vector<Dim>> free_velocity,
                    std::span<const Law> laws, std::span<const Vector<Dim>> r) {
        velocity_.resize(r.size());
        w.multiply(r, velocity_);
        return measure_
            .template evaluate<Law>(free_velocity, laws, r,
                                    [&](std::size_t i) { return velocity_[i]; })
            .relative;
    }
    static void require_count(const char* item, std::size_t size, std::size_t contacts) {
        if (size != contacts)
            throw input_error("number of " + std::string(item) + " is " + std::to_string(size) +
                              ", but must be that of contacts, " + std::to_string(contacts));
    }

    ResidualMeasure<Dim> measure_;
    std::vector<Vector<Dim>> velocity_, kept_;
    double best_residual_ = 0.0;
};

}  // namespace talus
