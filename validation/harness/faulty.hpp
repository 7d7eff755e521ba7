// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/assembly/contact_detection.hpp>
#include <talus/assembly/contact_jacobian.hpp>
#include <talus/collision/hierarchical_grid.hpp>
#include <talus/core/column.hpp>
#include <talus/geometry/shape_view.hpp>
#include <talus/solver/sweeps/gauss_seidel.hpp>
#include <talus/stepping/moreau_midpoint.hpp>
#include <talus/stepping/step_hooks.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <span>
#include <vector>

#include "dense_problem.hpp"
#include "faults.hpp"
#include "setting.hpp"

/// The faults, put in through the library's own doors: a law, a solver, a broad phase, hooks
/// between the stages.
namespace validation {

/// The law of the cases with a fault in it. The broken cones have no closed form: their contact is
/// solved by a fixed-point iteration on the natural map.
template <int Dim>
struct FaultyLaw {
    Law<Dim> law;
    Fault fault = Fault::none;

    using Tangent = Eigen::Matrix<double, Dim - 1, 1>;

    bool broken_cone() const {
        return (fault == Fault::faceted_cone && Dim == 3) || fault == Fault::axis_bias ||
               fault == Fault::pulling_contact;
    }
    double mu() const { return (fault == Fault::friction_off ? 1.02 : 1.0) * law.law.mu; }

    V<Dim> solve(const talus::LocalProblem<Dim>& p, const V<Dim>& start) const {
        if (!broken_cone()) return talus::Coulomb<Dim>{mu()}.solve(p, start);
        V<Dim> r = V<Dim>::Zero();
        const double rho = 1.0 / p.W.trace();
        for (int k = 0; k < 300; ++k) {
            const V<Dim> next = projected(p.velocity(r), r, rho);
            const double change = (next - r).norm();
            r = next;
            if (change <= 1e-15 * r.norm()) break;
        }
        return r;
    }
    V<Dim> natural_map(const V<Dim>& u, const V<Dim>& r, double rho) const {
        if (!broken_cone()) return talus::Coulomb<Dim>{mu()}.natural_map(u, r, rho);
        return projected(u, r, rho);
    }

  private:
    V<Dim> projected(const V<Dim>& u, const V<Dim>& r, double rho) const {
        V<Dim> result;
        const double push = r[0] - rho * u[0];
        result[0] = fault == Fault::pulling_contact ? push : std::max(0.0, push);
        const double bound = mu() * std::abs(result[0]);
        Tangent t = r.template tail<Dim - 1>() - rho * u.template tail<Dim - 1>();
        if (fault == Fault::faceted_cone)
            t = onto_diamond(t, bound);
        else
            t = onto_round(t, bound * (fault == Fault::axis_bias && t[0] > 0.0 ? 1.02 : 1.0));
        result.template tail<Dim - 1>() = t;
        return result;
    }
    static Tangent onto_round(const Tangent& t, double bound) {
        const double length = t.norm();
        return length > bound ? Tangent(bound / length * t) : t;
    }
    /// Nearest point of |t_1| + |t_2| <= bound.
    static Tangent onto_diamond(const Tangent& t, double bound) {
        const Tangent magnitude = t.cwiseAbs();
        if (magnitude.sum() <= bound) return t;
        double shift = (magnitude.sum() - bound) / static_cast<double>(Dim - 1);
        if (magnitude.minCoeff() < shift) shift = magnitude.maxCoeff() - bound;
        Tangent result;
        for (int k = 0; k < Dim - 1; ++k)
            result[k] = std::copysign(std::max(0.0, magnitude[k] - shift), t[k]);
        return result;
    }
};
static_assert(talus::ContactLaw<FaultyLaw<2>, 2> && talus::ContactLaw<FaultyLaw<3>, 3>);

/// Gauss-Seidel with a faulty law, or with a stop that is too early.
template <int Dim>
class FaultySolver {
  public:
    FaultySolver() = default;
    FaultySolver(const talus::GaussSeidelParams& params, Fault fault)
        : fault_(fault), solver_(params) {
        if (fault == Fault::residual_ignored) solver_.params.max_sweeps = 2;
        // A wrong problem may have no solution: a mutant is not worth a million sweeps.
        const int most = FaultyLaw<Dim>{{}, fault}.broken_cone() ? 500 : 200000;
        solver_.params.max_sweeps = std::min(solver_.params.max_sweeps, most);
    }
    const talus::SolveReport& solve(const talus::ContactProblem<Dim, Law<Dim>>& problem,
                                    std::span<V<Dim>> r) {
        faulty_.inverse_mass = problem.inverse_mass;
        faulty_.jacobian = problem.jacobian;
        faulty_.free_velocity = problem.free_velocity;
        faulty_.laws = faulty(problem.laws);
        return claimed([&]() -> const auto& { return solver_.solve(faulty_, r); });
    }
    const talus::SolveReport& solve(talus::AssembledProblem<Dim, Law<Dim>>& problem,
                                    std::span<V<Dim>> r) {
        faulty_.laws = faulty(problem.laws);
        return claimed([&]() -> const auto& {
            return solver_.solve(problem.delassus, std::span<const V<Dim>>(problem.free_velocity),
                                 std::span<const FaultyLaw<Dim>>(faulty_.laws), r);
        });
    }
    const talus::SolveReport& solve(const DenseProblem<Dim>& problem, std::span<V<Dim>> r) {
        DenseDelassus<Dim> w(problem.w);
        faulty_.laws = faulty(problem.laws);
        return claimed([&]() -> const auto& {
            return solver_.solve(w, std::span<const V<Dim>>(problem.free_velocity),
                                 std::span<const FaultyLaw<Dim>>(faulty_.laws), r);
        });
    }

  private:
    std::vector<FaultyLaw<Dim>> faulty(const std::vector<Law<Dim>>& laws) const {
        std::vector<FaultyLaw<Dim>> result;
        for (const Law<Dim>& law : laws) result.push_back({law, fault_});
        return result;
    }
    /// What the solver says of its answer, `solve()` being a solve from where the last one ended.
    template <class Solve>
    const talus::SolveReport& claimed(const Solve& solve) {
        if (fault_ == Fault::worst_contact_ignored) return content_as_a_whole(solve);
        report_ = solve();
        if (fault_ == Fault::residual_ignored) {
            report_.status = talus::SolveStatus::converged;
            report_.residual = 0.0;
        }
        return report_;
    }
    /// Looks after 1, 2, 4... sweeps, as the solver itself does.
    template <class Solve>
    const talus::SolveReport& content_as_a_whole(const Solve& solve) {
        talus::GaussSeidelParams& params = solver_.params;
        const int most = params.max_sweeps;
        params.max_sweeps = 1;
        for (int left = most; left > 0; params.max_sweeps = std::min(2 * params.max_sweeps, left)) {
            report_ = solve();
            report_.residual = report_.whole;
            if (report_.whole <= params.tolerance) report_.status = talus::SolveStatus::converged;
            if (report_.status != talus::SolveStatus::iteration_limit ||
                report_.iterations < params.max_sweeps)
                break;
            left -= report_.iterations;
        }
        params.max_sweeps = most;
        return report_;
    }

    Fault fault_ = Fault::none;
    talus::GaussSeidel<Dim, FaultyLaw<Dim>> solver_;
    talus::ContactProblem<Dim, FaultyLaw<Dim>> faulty_;
    talus::SolveReport report_;
};

/// A broad phase that keeps to the pairs that it found first, or does not.
template <int Dim, bool Stale>
class FaultyPairs {
  public:
    template <std::predicate<talus::BodyIndex> IsObstacle>
    void find_pairs(std::span<const talus::Aabb<Dim>> boxes, const IsObstacle& is_obstacle,
                    talus::Column<talus::CandidatePair>& pairs) {
        if (!Stale || bodies_ != boxes.size()) grid_.find_pairs(boxes, is_obstacle, first_);
        bodies_ = boxes.size();
        pairs = first_;
    }

  private:
    talus::HierarchicalGrid<Dim> grid_;
    std::size_t bodies_ = 0;
    talus::Column<talus::CandidatePair> first_;
};
static_assert(talus::BroadPhase<FaultyPairs<2, true>, 2>);

/// Faults between the stages of a step.
template <int Dim>
struct FaultyHooks : talus::NoHooks {
    Fault fault = Fault::none;
    talus::StepParams step = {};
    talus::ContactDetection<Dim, ShapeType<Dim>, talus::HierarchicalGrid<Dim>> detection = {};

    template <class System, class Data>
    void at_midpoint(System& system, Data& data) {
        if (fault == Fault::begin_point) {
            talus::drift(system.bodies, -0.5 * data.h);
            system.place_obstacles(data.t_begin);
        }
        if (fault == Fault::obstacle_velocity_forgotten)
            for (std::size_t i = 0; i < data.begin.size(); ++i)
                if (system.bodies.is_obstacle(i)) {
                    system.bodies.velocity[i].setZero();
                    system.bodies.spin[i].setZero();
                    data.begin[i] = {};
                }
    }
    template <class System, class Data>
    void matrices_known(System& system, Data& data) {
        if ((fault == Fault::ghost_edge || fault == Fault::control) &&
            step.scheme == talus::Scheme::gap_anticipating)
            anticipate_again(system, data);
        if (fault == Fault::sliver_face) draw_together(system, data);
        auto& j = data.problem.jacobian;
        const std::size_t n = data.contact_count();
        if (fault == Fault::stale_inertia)
            for (std::size_t i = 0; i < system.bodies.count(); ++i)
                data.problem.inverse_mass.angular[i] =
                    system.bodies.inverse_inertia[i].asDiagonal();
        if (fault == Fault::short_arm)
            for (std::size_t c = 0; c < n; ++c) {
                j.arm_a[c] *= 0.99;
                j.arm_b[c] *= 0.99;
            }
        if (fault == Fault::tilted_normal)
            for (std::size_t c = 0; c < n; ++c) {
                const V<Dim> normal = (j.frame[c].row(0) + 1e-3 * j.frame[c].row(1)).normalized();
                j.frame[c] = talus::local_frame<Dim>(normal);
            }
    }
    template <class System, class Data>
    void forces_known(System& system, Data& data) {
        if (fault == Fault::gyroscopic_dropped)
            for (std::size_t i = 0; i < data.gyroscopic.size(); ++i)
                data.free[i].angular -= system.bodies.rotation[i].spin_world(data.gyroscopic[i]);
    }
    template <class System, class Data>
    void problem_known(System& system, Data& data) {
        for (std::size_t c = 0; c < data.contact_count(); ++c) {
            const V<Dim> u = talus::relative_velocity<Dim>(data.problem.jacobian, c, data.begin);
            const auto& law = data.problem.laws[c];
            V<Dim>& b = data.problem.free_velocity[c];
            if constexpr (requires { law.restitution_normal; }) {
                // theta = 1 / (1 + e) too large by 2 %: e too small by 2 % of (1 + e).
                if (fault == Fault::restitution_weight)
                    b[0] -= 0.02 * (1.0 + law.restitution_normal) * u[0];
                if (fault == Fault::friction_on_end_velocity)
                    b.template tail<Dim - 1>() -=
                        law.restitution_tangential * u.template tail<Dim - 1>();
            }
        }
        if (fault == Fault::wrong_warm_start && data.contact_count() > 1)
            std::rotate(data.impulse.begin(), data.impulse.begin() + 1, data.impulse.end());
        if (fault == Fault::begin_point) {
            talus::drift(system.bodies, 0.5 * data.h);
            system.place_obstacles(data.t_mid());
        }
    }
    template <class System, class Data>
    void velocities_known(System&, Data& data) {
        if (fault != Fault::reaction_lost) return;
        const auto& j = data.problem.jacobian;
        const auto& m = data.problem.inverse_mass;
        for (std::size_t c = 0; c < data.contact_count(); ++c) {
            const auto b = static_cast<std::size_t>(j.b[c]);
            const V<Dim> lost = 0.01 * (j.frame[c].transpose() * data.impulse[c]);
            data.end[b].linear += m.linear[b] * lost;
            data.end[b].angular += m.angular[b] * talus::moment<Dim>(j.arm_b[c], lost);
        }
    }
    template <class System, class Data>
    void finished(System& system, Data& data) {
        if (fault != Fault::end_point_drift) return;
        auto& bodies = system.bodies;
        for (std::size_t i = 0; i < bodies.count(); ++i) {
            if (bodies.is_obstacle(i)) continue;
            const talus::Twist<Dim>&u = data.begin[i], &v = data.end[i];
            bodies.position[i] += 0.5 * data.h * (v.linear - u.linear);
            bodies.rotation[i] = talus::Rotation<Dim>::exp(0.5 * data.h * (v.angular - u.angular)) *
                                 bodies.rotation[i];
        }
    }

  private:
    /// Finds the contacts of the gap-anticipating scheme again: those that the motion leads to, or
    /// with the fault those at the nearest points.
    template <class System, class Data>
    void anticipate_again(System& system, Data& data) {
        const talus::Bodies<Dim>& bodies = system.bodies;
        const double tolerance = step.contact_tolerance.value_or(0.0);
        std::vector<double> reach;
        std::vector<talus::Twist<Dim>> motion;
        for (std::size_t i = 0; i < bodies.count(); ++i) {
            const double gained = (data.free[i].linear - data.begin[i].linear).norm();
            reach.push_back(0.5 * tolerance +
                            talus::anticipation_reach<Dim>(bodies, i, system.bounding_radius()[i],
                                                           gained, data.h));
            if (fault != Fault::ghost_edge)
                motion.push_back({data.h * data.begin[i].linear, data.h * data.begin[i].angular});
        }
        detection.detect(bodies, system.shape_list(), 0.0, reach, motion, tolerance, system.ignored,
                         data.contacts);
        data.contacts.keep_if([&](std::size_t c) {
            return data.contacts.gap[c] <= tolerance ||
                   !talus::bounces<Dim>(system.law_of(data.contacts.key[c]));
        });
        talus::assemble_jacobian(data.contacts, bodies, data.problem.jacobian);
    }

    /// Draws the contacts of two hulls that have one normal together about their mean.
    template <class System, class Data>
    void draw_together(const System& system, Data& data) {
        constexpr double share = 0.1;
        auto& contacts = data.contacts;
        const auto is_hull = [&](talus::BodyIndex i) {
            return talus::view_of<Dim>(system.shapes()[static_cast<std::size_t>(i)]).kind() ==
                   talus::ShapeKind::core;
        };
        for (std::size_t first = 0, last = 0; first < contacts.count(); first = last) {
            const talus::BodyIndex a = contacts.key[first].a, b = contacts.key[first].b;
            const V<Dim> normal = contacts.normal[first];
            V<Dim> sum = V<Dim>::Zero();
            bool flat = is_hull(a) && is_hull(b);
            for (;
                 last < contacts.count() && contacts.key[last].a == a && contacts.key[last].b == b;
                 ++last) {
                sum += contacts.point[last];
                flat = flat && contacts.normal[last].dot(normal) > 1.0 - 1e-9;
            }
            const V<Dim> mean = sum / static_cast<double>(last - first);
            for (std::size_t c = first; flat && c < last; ++c) {
                V<Dim> shift = (share - 1.0) * (contacts.point[c] - mean);
                shift -= normal.dot(shift) * normal;
                contacts.point[c] += shift;
                data.problem.jacobian.arm_a[c] += shift;
                data.problem.jacobian.arm_b[c] += shift;
            }
        }
    }
};

}  // namespace validation
