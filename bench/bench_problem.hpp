// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/law/coulomb.hpp>
#include <talus/problem/body_map.hpp>
#include <talus/problem/matrix_problem.hpp>
#include <talus/problem/residual.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace bench {

template <int Dim>
using Law = talus::Coulomb<Dim>;

/// A problem that solvers are compared on: made of bodies, or given by its matrix.
template <int Dim>
class BenchProblem {
  public:
    using Bodies = talus::ContactProblem<Dim, Law<Dim>>;
    using Assembled = talus::AssembledProblem<Dim, Law<Dim>>;

    explicit BenchProblem(Bodies problem) : bodies_(std::move(problem)) {}
    explicit BenchProblem(Assembled problem) : assembled_(std::move(problem)) {}
    explicit BenchProblem(const talus::GlobalProblem<Dim, Law<Dim>>& problem)
        : assembled_(talus::assembled(problem)) {
        global_.emplace(assembled_->delassus, problem.mass, problem.contact_map);
    }

    /// Null for a problem that came as a matrix.
    const Bodies* bodies() const { return bodies_ ? &*bodies_ : nullptr; }
    /// Null unless it came as M and H.
    const talus::DelassusGlobal<Dim>* global() const { return global_ ? &*global_ : nullptr; }
    /// Assembled when first asked for.
    const Assembled& assembled() const {
        if (!assembled_)
            assembled_.emplace(Assembled{
                {bodies_->jacobian, bodies_->inverse_mass}, bodies_->free_velocity, bodies_->laws});
        return *assembled_;
    }
    std::size_t contact_count() const { return free_velocity().size(); }
    std::span<const talus::Vector<Dim>> free_velocity() const {
        if (bodies_) return bodies_->free_velocity;
        return assembled_->free_velocity;
    }
    std::span<const Law<Dim>> laws() const {
        if (bodies_) return bodies_->laws;
        return assembled_->laws;
    }

    /// Calls visit(w) with the operator: the product where bodies are known, else the matrix.
    template <class Visit>
    decltype(auto) with_operator(Visit&& visit) const {
        if (!bodies_) return visit(assembled_->delassus);
        const talus::DelassusProduct<Dim> w(bodies_->jacobian, bodies_->inverse_mass);
        return visit(w);
    }

    /// Impulses that every solver starts from; empty: zero [N s].
    std::vector<talus::Vector<Dim>> start;

  private:
    std::optional<Bodies> bodies_;
    mutable std::optional<Assembled> assembled_;
    std::optional<talus::DelassusGlobal<Dim>> global_;
};

using AnyProblem = std::variant<BenchProblem<2>, BenchProblem<3>>;

/// A problem that is made when its turn comes.
struct ProblemEntry {
    std::string name;
    std::function<AnyProblem()> make;
    int dimension = 0;  ///< 0: known only when made
};

/// What impulses are worth, by two measures.
struct Judgement {
    double residual = 0.0;     ///< of problem/residual.hpp [-]
    double worst_share = 0.0;  ///< see talus::Residual [-]
    /// Siconos' normalisation: || r - P_K(r - (u + mu |u_t| n)) || / max(|q|, |r|, |u|), with the
    /// step rho = 1 in the units of the file, whatever they are.
    double residual_siconos = 0.0;
};

/// The one judge of all solvers.
template <int Dim>
Judgement judge(const BenchProblem<Dim>& problem, std::span<const talus::Vector<Dim>> r) {
    using Vec = talus::Vector<Dim>;
    std::vector<Vec> u(r.size());
    talus::ResidualMeasure<Dim> measure;
    problem.with_operator([&](const auto& w) {
        measure.prepare(w);
        w.multiply(r, u);
    });
    const talus::Residual own = measure.template evaluate<Law<Dim>>(
        problem.free_velocity(), problem.laws(), r, [&](std::size_t i) { return u[i]; });
    double error = 0.0, q2 = 0.0, r2 = 0.0, u2 = 0.0;
    for (std::size_t i = 0; i < r.size(); ++i) {
        const Vec velocity = u[i] + problem.free_velocity()[i];
        error += (r[i] - problem.laws()[i].natural_map(velocity, r[i], 1.0)).squaredNorm();
        q2 += problem.free_velocity()[i].squaredNorm();
        r2 += r[i].squaredNorm();
        u2 += velocity.squaredNorm();
    }
    const double scale = std::sqrt(std::max({q2, r2, u2}));
    return {own.relative, own.worst_share, error == 0.0 ? 0.0 : std::sqrt(error) / scale};
}

}  // namespace bench
