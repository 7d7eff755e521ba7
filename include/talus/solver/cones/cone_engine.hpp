// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/check.hpp>
#include <talus/core/input.hpp>
#include <talus/law/cone_of.hpp>
#include <talus/problem/assembled_problem.hpp>
#include <talus/problem/residual.hpp>
#include <talus/solver/concepts.hpp>
#include <talus/solver/cones/cone_system.hpp>

#include <Eigen/Core>

#include <algorithm>
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
///
/// All need laws with a cone: without, they do not compile. Where a law is chosen at run time
/// (AnyLaw) and has none at some contact, `solve` throws input_error that names the contact, and
/// leaves r alone.
///
/// For programs of several files, which compile an engine once:
///
///     extern template class talus::NewtonPolish<3, Law>;
///     extern template class talus::ConeEngine<3, Law, talus::NewtonPolish<3, Law>>;
template <int Dim, ConeLaw<Dim> Law, class Engine>
class ConeEngine {
  public:
    /// Solves a problem of bodies from the warm start `r`, into `r`. Throws input_error on
    /// parameters out of range, arrays of different lengths or contacts without a cone.
    const SolveReport& solve(const ContactProblem<Dim, Law>& problem, std::span<Vector<Dim>> r);
    /// The same for a problem given by its blocks.
    const SolveReport& solve(const AssembledProblem<Dim, Law>& problem, std::span<Vector<Dim>> r) {
        return solve(problem.delassus, problem.free_velocity, problem.laws, r);
    }
    const SolveReport& solve(const DelassusSparse<Dim>& w,
                             std::span<const Vector<Dim>> free_velocity, std::span<const Law> laws,
                             std::span<Vector<Dim>> r);
    const SolveReport& solve(const DelassusGlobal<Dim>& w,
                             std::span<const Vector<Dim>> free_velocity, std::span<const Law> laws,
                             std::span<Vector<Dim>> r);

    const SolveReport& report() const { return report_; }  ///< of the last solve

    using System = ConeSystem<Dim>;
    /// Works on a problem that is already in scaled form, lent for the time of the call: improves
    /// `best`, whose residual is given; returns the residual reached. For solvers made of engines.
    double improve(System& system, Eigen::VectorXd& best, double residual) {
        // Lent, not copied: it may hold factors of some GB.
        std::swap(system_, system);
        report_ = {};
        best_residual_ = residual;
        try {
            engine().iterate(best);
        } catch (...) {
            std::swap(system_, system);
            throw;
        }
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

    /// The cones of all contacts. Throws input_error that names the first contact without one.
    static std::vector<FrictionCone<Dim>> require_cones(std::span<const Law> laws) {
        std::vector<FrictionCone<Dim>> cones;
        cones.reserve(laws.size());
        for (std::size_t c = 0; c < laws.size(); ++c) {
            const std::optional<FrictionCone<Dim>> cone = cone_of<Dim>(laws[c]);
            if (!cone)
                throw input_error("contact " + std::to_string(c) +
                                  " has a law without a friction cone, which this solver needs: "
                                  "use Automatic, GaussSeidel or AcceleratedGaussSeidel");
            cones.push_back(*cone);
        }
        return cones;
    }

    System system_;
    SolveReport report_;

  private:
    Engine& engine() { return static_cast<Engine&>(*this); }

    template <class W, class Source>
    const SolveReport& run(const W& w, std::span<const Vector<Dim>> free_velocity,
                           std::span<const Law> laws, std::span<Vector<Dim>> r, Source&& source);
    template <class W>
    void improve_impulses(const W& w, std::span<const Vector<Dim>> free_velocity,
                          std::span<const Law> laws, std::span<Vector<Dim>> r, double begin);

    template <class W>
    Residual evaluate(const W& w, std::span<const Vector<Dim>> free_velocity,
                      std::span<const Law> laws, std::span<const Vector<Dim>> r) {
        velocity_.resize(r.size());
        w.multiply(r, velocity_);
        return measure_.template evaluate<Law>(free_velocity, laws, r,
                                               [&](std::size_t i) { return velocity_[i]; });
    }

    ResidualMeasure<Dim> measure_;
    std::vector<Vector<Dim>> velocity_, kept_;
    double best_residual_ = 0.0;
};

// Not inline, so that `extern template class` spares a user all of it.

template <int Dim, ConeLaw<Dim> Law, class Engine>
const SolveReport& ConeEngine<Dim, Law, Engine>::solve(const ContactProblem<Dim, Law>& problem,
                                                       std::span<Vector<Dim>> r) {
    // The product is for the residual; systems are solved in the space of bodies.
    const DelassusProduct<Dim> w(problem.jacobian, problem.inverse_mass);
    return run(w, problem.free_velocity, problem.laws, r,
               [&] { return BodyMap<Dim>(problem.jacobian, problem.inverse_mass); });
}
template <int Dim, ConeLaw<Dim> Law, class Engine>
const SolveReport& ConeEngine<Dim, Law, Engine>::solve(const DelassusSparse<Dim>& w,
                                                       std::span<const Vector<Dim>> free_velocity,
                                                       std::span<const Law> laws,
                                                       std::span<Vector<Dim>> r) {
    return run(w, free_velocity, laws, r, [&]() -> const DelassusSparse<Dim>& { return w; });
}
template <int Dim, ConeLaw<Dim> Law, class Engine>
const SolveReport& ConeEngine<Dim, Law, Engine>::solve(const DelassusGlobal<Dim>& w,
                                                       std::span<const Vector<Dim>> free_velocity,
                                                       std::span<const Law> laws,
                                                       std::span<Vector<Dim>> r) {
    if (w.bodies() == nullptr) return solve(w.assembled(), free_velocity, laws, r);
    return run(w, free_velocity, laws, r, [&] { return *w.bodies(); });
}

template <int Dim, ConeLaw<Dim> Law, class Engine>
template <class W, class Source>
const SolveReport& ConeEngine<Dim, Law, Engine>::run(const W& w,
                                                     std::span<const Vector<Dim>> free_velocity,
                                                     std::span<const Law> laws,
                                                     std::span<Vector<Dim>> r, Source&& source) {
    require_count("free velocities", free_velocity.size(), "contacts", w.contact_count());
    require_count("laws", laws.size(), "contacts", w.contact_count());
    require_count("impulses", r.size(), "contacts", w.contact_count());
    require_non_negative("max_iterations", engine().params.max_iterations);
    require_non_negative("tolerance", engine().params.tolerance);
    std::vector<FrictionCone<Dim>> cones = require_cones(laws);
    report_ = {};
    measure_.template prepare<W, Law>(w, free_velocity, laws, r);
    report_.take(evaluate(w, free_velocity, laws, r));
    const double begin = report_.residual;
    report_.history.push_back({0, begin});
    if (!std::isfinite(begin)) {
        report_.status = SolveStatus::not_finite;
        return report_;
    }
    if (begin <= engine().params.tolerance) {
        report_.status = SolveStatus::converged;
        return report_;
    }
    // What is left where neither the tolerance nor the limit is reached.
    report_.status = SolveStatus::stalled;
    system_.assign(source(), free_velocity, std::move(cones), measure_);
    improve_impulses(w, free_velocity, laws, r, begin);
    // The last sample is the residual in the report: in the caller's units, as the first one.
    report_.history.push_back({report_.iterations, report_.residual});
    if (report_.status == SolveStatus::no_solution) return report_;
    if (report_.residual <= engine().params.tolerance)
        report_.status = SolveStatus::converged;
    else if (report_.iterations >= engine().params.max_iterations)
        report_.status = SolveStatus::iteration_limit;
    return report_;
}

/// Lets the engine work on r, whose residual is `begin`. What it says of its best iterate is
/// measured again in the caller's units: r changes only if it became better by that.
template <int Dim, ConeLaw<Dim> Law, class Engine>
template <class W>
void ConeEngine<Dim, Law, Engine>::improve_impulses(const W& w,
                                                    std::span<const Vector<Dim>> free_velocity,
                                                    std::span<const Law> laws,
                                                    std::span<Vector<Dim>> r, double begin) {
    best_residual_ = begin;
    Eigen::VectorXd best;
    system_.to_scaled(r, best);
    engine().iterate(best);
    if (!(best_residual_ < begin)) return;
    kept_.assign(r.begin(), r.end());
    system_.to_impulses(best, r);
    const Residual end = evaluate(w, free_velocity, laws, r);
    if (end.relative < begin)
        report_.take(end);
    else
        std::copy(kept_.begin(), kept_.end(), r.begin());
}

}  // namespace talus
