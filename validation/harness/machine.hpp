// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/lagrangian/simulation.hpp>

#include <Eigen/Core>

#include <cmath>
#include <memory>
#include <utility>

#include "case.hpp"
#include "faulty.hpp"
#include "gsl.hpp"
#include "observed.hpp"

namespace validation {

/// Faults between the stages of the step of a Lagrangian system: what they are of bodies, said of
/// coordinates.
struct FaultyMachine : talus::NoHooks {
    Fault fault = Fault::none;
    Eigen::MatrixXd first_mass = {};

    template <class System, class Data>
    void at_midpoint(System&, Data& data) {
        if (fault != Fault::begin_point) return;
        data.q_mid = data.q_begin;
        data.t_mid = data.t_begin;
    }
    template <class System, class Data>
    void matrices_known(System&, Data& data) {
        if (first_mass.size() == 0) first_mass = data.mass;
        if (fault == Fault::stale_inertia) data.mass = first_mass;
        for (std::size_t k = 0; k < data.contacts.size(); ++k) {
            auto& contact = data.contacts[k];
            if (fault == Fault::obstacle_velocity_forgotten) contact.prescribed.setZero();
            if (fault == Fault::tilted_normal) contact.rows.row(0) += 1e-3 * contact.rows.row(1);
            if (fault == Fault::short_arm) contact.rows.rightCols(1) *= 0.99;
        }
    }
    template <class System, class Data>
    void forces_known(System& system, Data& data) {
        typename Data::Coordinates change = 0.0 * data.begin;
        if (fault == Fault::force_at_begin)
            system.force(data.t_begin, data.q_begin, data.begin, change);
        else if (fault == Fault::gyroscopic_dropped)
            system.force(data.t_mid, data.q_mid, typename Data::Coordinates(change), change);
        else
            return;
        change *= data.h;
        data.factor.solve(change);
        data.free = data.begin + change;
    }
    template <class System, class Data>
    void problem_known(System&, Data& data) {
        for (std::size_t c = 0; c < data.contact_count(); ++c) {
            const V<2> u = data.begin_velocity(c);
            const auto& law = data.problem.laws[c];
            V<2>& b = data.problem.free_velocity[c];
            if (fault == Fault::restitution_weight)
                b[0] -= 0.02 * (1.0 + law.restitution_normal) * u[0];
            if (fault == Fault::friction_on_end_velocity) b[1] -= law.restitution_tangential * u[1];
        }
        if (fault == Fault::wrong_warm_start && data.contact_count() > 1)
            std::rotate(data.impulse.begin(), data.impulse.begin() + 1, data.impulse.end());
        if (fault == Fault::begin_point) data.q_mid = data.q_begin + 0.5 * data.h * data.begin;
    }
    template <class System, class Data>
    void velocities_known(System&, Data& data) {
        if (fault == Fault::reaction_lost) data.end -= 0.01 * (data.end - data.free);
    }
    template <class System, class Data>
    void finished(System&, Data& data) {
        if (fault == Fault::end_point_drift) data.q_end = data.q_begin + data.h * data.end;
    }
};

/// How a machine steps.
struct MachineParams {
    double h = 1e-3;  ///< [s]
    talus::VelocityForces velocity_forces = talus::VelocityForces::explicit_begin;
    double contact_tolerance = 0.0;  ///< [m]
    double size = 1.0;               ///< of what touches, for the fault of loose contacts [m]
    talus::GaussSeidelParams solver = {.max_sweeps = 20000, .tolerance = 1e-14};
};

/// A talus::LagrangianSimulation whose residuals the trial judges, and that a fault can be put
/// into; without one it is the library's own with nothing added. (A run that names a solver changes
/// worlds alone.)
template <talus::LagrangianSystem System>
class Machine {
  public:
    using Sound = talus::LagrangianSimulation<System>;
    using Faulty = talus::LagrangianSimulation<System, FaultySolver<2>, FaultyMachine>;
    using Coordinates = typename Sound::Coordinates;
    using Data = typename Sound::Data;

    Machine(TrialRecord& trial, const System& system, const Coordinates& q, const Coordinates& u,
            const MachineParams& params, double t = 0.0)
        : trial_(trial), params_(params) {
        talus::LagrangianParams settings{.h = params.h,
                                         .contact_tolerance = params.contact_tolerance,
                                         .velocity_forces = params.velocity_forces};
        const Fault fault = trial.fault();
        if (fault == Fault::none) {
            sound_ = std::make_unique<Sound>(system, q, u, t, settings,
                                             typename Solvers::Plain(params.solver));
            return;
        }
        if (fault == Fault::loose_contact) settings.contact_tolerance += 0.02 * params.size;
        faulty_ = std::make_unique<Faulty>(system, q, u, t, settings,
                                           FaultySolver<2>(params.solver, fault));
        faulty_->hooks().fault = fault;
    }

    const Data& step() {
        const Data& data = sound_ ? sound_->step() : faulty_->step();
        trial_.solved(data.report.residual, params_.solver.tolerance);
        if (data.free_report.status != talus::FreeVelocityStatus::converged)
            trial_.solved(data.free_report.error, 0.0);
        return data;
    }
    /// Makes the steps of a duration [s]; `on_step(const Data&)` may return false to stop.
    template <class OnStep = talus::Ignore>
    void run(double duration, OnStep on_step = {}) {
        const auto steps = std::llround(duration / params_.h);
        for (long long k = 0; k < steps; ++k)
            if (!talus::notify(on_step, step())) return;
    }
    const Coordinates& q() const { return sound_ ? sound_->position() : faulty_->position(); }
    const Coordinates& u() const { return sound_ ? sound_->velocity() : faulty_->velocity(); }
    double time() const { return sound_ ? sound_->time() : faulty_->time(); }

  private:
    struct Solvers {
        using Plain = talus::GaussSeidel<2, Law<2>>;
    };
    TrialRecord& trial_;
    MachineParams params_;
    std::unique_ptr<Sound> sound_;
    std::unique_ptr<Faulty> faulty_;
};

/// Coordinates of a system of one degree of freedom.
using One = Eigen::Matrix<double, 1, 1>;

}  // namespace validation
