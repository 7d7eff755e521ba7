// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/assembly/apply_impulses.hpp>
#include <talus/assembly/contact_jacobian.hpp>
#include <talus/core/column.hpp>
#include <talus/core/input.hpp>
#include <talus/core/room.hpp>
#include <talus/law/signorini.hpp>
#include <talus/solver/sweeps/gauss_seidel.hpp>
#include <talus/stepping/step_data.hpp>
#include <talus/stepping/system.hpp>

#include <algorithm>
#include <cstddef>
#include <span>

namespace talus {

/// Settings of the position correction.
struct GapCorrectionParams {
    /// Share of each overlap removed per step [-], in [0, 1]. 0.2 takes away overlaps within some
    /// ten steps and does not disturb the solver's warm start; 0 corrects nothing, like the paper.
    double fraction = 0.2;
    /// Sweeps and tolerance of the displacement problem: a rough answer is enough, since what is
    /// left is corrected in the next step.
    GaussSeidelParams solver{.max_sweeps = 50, .tolerance = 1e-2};
};

/// Moves overlapping bodies apart, positions only: the smallest displacement (in the kinetic
/// metric) that takes a share of each overlap away, a frictionless contact problem in
/// displacements. Velocities stay, and spins in body axes do, so that a body which is turned keeps
/// its kinetic energy and its spin turns with it. Lifting bodies against gravity is paid for out of
/// what the contacts have dissipated so far: displacements that would cost more are shortened, so
/// the total energy never exceeds what it would have been without dissipation. Work against other
/// forces (springs, say) is not accounted for.
template <int Dim>
requires SpaceDimension<Dim>
class GapCorrection {
  public:
    GapCorrectionParams params;

    /// Throws input_error if the fraction is out of range.
    void require_valid() const {
        require_in("fraction of the gap correction", params.fraction, 0.0, 1.0);
    }
    /// Corrects the configuration at the end of the step described by `data`, whose correction_work
    /// it sets.
    template <class Law, class ShapeType>
    void apply(System<Dim, Law, ShapeType>& system, StepData<Dim, Law>& data) {
        const double earned = dissipated(data);
        if (!(params.fraction > 0.0)) {
            budget_ += earned;
            return;
        }
        const bool overlap = pose_problem(data);
        detail::make_room(impulse_, data.contact_count());
        impulse_.assign(data.contact_count(), Vector<Dim>::Zero());
        solver_.params = params.solver;
        // Without overlap there is nothing to sweep; it is made ready for as many contacts.
        solver_.solve(problem_, std::span<Vector<Dim>>(impulse_));
        displacement_.assign(system.bodies.count(), Twist<Dim>{});
        apply_impulses<Dim>(problem_.jacobian, problem_.inverse_mass, impulse_, displacement_);
        budget_ += earned;  // from here on nothing throws
        if (overlap) displace(system, data);
    }

    /// Of the last displacement problem that was solved (none without a `fraction`): where it did
    /// not converge, bodies have moved by what was found, and what is left is seen to in the next
    /// step.
    const SolveReport& report() const { return solver_.report(); }
    /// Dissipated energy not yet spent on lifting [J].
    double budget() const { return budget_; }

    void write(NumberRecord& out) const { out.real(budget_); }
    void restore(NumberRecordReader& in) { budget_ = in.real(); }

  private:
    template <class Law>
    static double dissipated(const StepData<Dim, Law>& data) {
        double work = 0.0;
        for (std::size_t c = 0; c < data.contact_count(); ++c)
            work += 0.5 * data.impulse[c].dot(
                              relative_velocity<Dim>(data.problem.jacobian, c, data.begin) +
                              relative_velocity<Dim>(data.problem.jacobian, c, data.end,
                                                     data.cell_rate_end));
        if constexpr (has_rolling_rows<Law>)
            for (std::size_t c = 0; c < data.contact_count(); ++c) {
                const auto a = static_cast<std::size_t>(data.problem.jacobian.a[c]);
                const auto b = static_cast<std::size_t>(data.problem.jacobian.b[c]);
                work += 0.5 * data.moment[c].dot(data.begin[a].angular - data.begin[b].angular +
                                                 data.end[a].angular - data.end[b].angular);
            }
        return -work;
    }

    /// Fills the displacement problem; whether anything overlaps. Gaps are those of the next
    /// midpoint.
    template <class Law>
    bool pose_problem(const StepData<Dim, Law>& data) {
        bool overlap = false;
        const std::size_t n = data.contact_count();
        detail::make_room(problem_.free_velocity, n);
        problem_.free_velocity.assign(n, Vector<Dim>::Zero());
        for (std::size_t c = 0; c < n; ++c) {
            const double gap = data.contacts.gap[c] +
                               data.h * relative_velocity<Dim>(data.problem.jacobian, c, data.end,
                                                               data.cell_rate_end)[0];
            problem_.free_velocity[c][0] = gap < 0.0 ? params.fraction * gap : gap;
            overlap = overlap || gap < 0.0;
        }
        problem_.jacobian.make_room(n);
        problem_.jacobian = data.problem.jacobian;
        problem_.inverse_mass = data.problem.inverse_mass;
        problem_.jacobian.cell_lever.clear();  // bodies are moved, the cell stays
        problem_.laws.resize(n);
        return overlap;
    }

    template <class Law, class ShapeType>
    void displace(System<Dim, Law, ShapeType>& system, StepData<Dim, Law>& data) {
        Bodies<Dim>& bodies = system.bodies;
        double lift = 0.0;
        for (std::size_t i = 0; i < bodies.count(); ++i)
            if (!bodies.is_obstacle(i))
                lift -= bodies.mass(i) * system.gravity.dot(displacement_[i].linear);
        const double share = lift > 0.0 ? std::clamp(budget_ / lift, 0.0, 1.0) : 1.0;
        for (std::size_t i = 0; i < bodies.count(); ++i) {
            if (bodies.is_obstacle(i)) continue;
            bodies.position[i] += share * displacement_[i].linear;
            const AngularVector<Dim> turn = share * displacement_[i].angular;
            bodies.rotation[i] = (Rotation<Dim>::exp(turn) * bodies.rotation[i]).normalized();
        }
        data.correction_work = share * lift;
        budget_ -= data.correction_work;
    }

    double budget_ = 0.0;
    ContactProblem<Dim, Signorini<Dim>> problem_;
    GaussSeidel<Dim, Signorini<Dim>> solver_;
    Column<Vector<Dim>> impulse_;
    Column<Twist<Dim>> displacement_;
};

}  // namespace talus
