// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/number_record.hpp>
#include <talus/dynamics/bodies.hpp>
#include <talus/problem/contact_problem.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace talus {

/// Kinetic energy of all free bodies [J].
template <int Dim>
double kinetic_energy(const Bodies<Dim>& bodies) {
    double sum = 0.0;
    for (std::size_t i = 0; i < bodies.count(); ++i) sum += kinetic_energy(bodies, i);
    return sum;
}

/// Potential energy of all free bodies in uniform gravity, zero at the origin [J].
template <int Dim>
double potential_energy(const Bodies<Dim>& bodies, const Vector<Dim>& gravity) {
    double sum = 0.0;
    for (std::size_t i = 0; i < bodies.count(); ++i)
        if (!bodies.is_obstacle(i)) sum -= bodies.mass(i) * gravity.dot(bodies.position[i]);
    return sum;
}

/// Energy given to the bodies, by the way it came [J]. Losses are negative.
struct EnergyFlows {
    double friction = 0.0;     ///< tangential impulses on their slip
    double restitution = 0.0;  ///< normal impulses on approach and separation: the loss of impacts
    double walls = 0.0;        ///< prescribed motion of obstacles
    double applied = 0.0;      ///< forces other than gravity
    double gyroscopic = 0.0;   ///< error of the gyroscopic term (zero for balls and in the plane)
    double correction = 0.0;   ///< position correction against gravity
    double exchange = 0.0;     ///< bodies that came, less those that went
    double rolling = 0.0;      ///< moments of rolling friction on the relative spin
    /// Contacts with images on the deformation of the periodic cell, V sigma : L of what is at rest
    /// in the mean, and what it gives to bodies away from home.
    double cell = 0.0;

    double sum() const {
        return friction + restitution + walls + applied + gyroscopic + correction + exchange +
               rolling + cell;
    }
    double magnitude() const {
        return std::abs(friction) + std::abs(restitution) + std::abs(walls) + std::abs(applied) +
               std::abs(gyroscopic) + std::abs(correction) + std::abs(exchange) +
               std::abs(rolling) + std::abs(cell);
    }
};

/// Books where the energy of a run comes from and goes to. The kinetic and potential energies are
/// taken from the state, the flows from impulses and velocities; for constant mass and uniform
/// gravity
///
///   T_end - T_begin = sum_c r_c . (U_c,begin + U_c,end)/2 - r_c . W_c
///                     + h F . (u_begin + u_end)/2
///
/// (with the rolling rows of r, U and W, where a law has some)
/// holds in every step to rounding (identity of the midpoint rule), so that what is missing at the
/// end is rounding, or a fault.
template <int Dim>
requires SpaceDimension<Dim>
class EnergyLedger {
  public:
    EnergyLedger() = default;
    /// Opens the books at a state.
    EnergyLedger(const Bodies<Dim>& bodies, const Vector<Dim>& gravity) : gravity_(gravity) {
        kinetic_ = kinetic_start_ = kinetic_energy(bodies);
        potential_ = potential_start_ = potential_energy(bodies, gravity);
    }

    /// Books a step. `step` offers what `StepData` has: h, begin, end, applied, gyroscopic,
    /// problem, impulse, contacts, correction_work, and `moment` where it knows rolling friction;
    /// `bodies` is the state at the end of the step.
    /// Throws input_error if bodies have come or gone since the step.
    template <class Step>
    void record(const Step& step, const Bodies<Dim>& bodies) {
        require_count("bodies", bodies.count(), "bodies of the step", step.begin.size());
        if constexpr (requires { step.contacts.require_bodies(bodies.id); })
            step.contacts.require_bodies(bodies.id);
        record_contacts(step);
        if constexpr (requires { step.moment; }) record_rolling(step);
        record_forces(step, bodies);
        if constexpr (requires { step.from_home; })
            if (!step.from_home.empty()) record_cell(step, bodies);
        flows_.correction += step.correction_work;
        look_at(bodies);
    }
    /// Books bodies that came or went since the last record, or were changed otherwise between two
    /// steps: what the energy of the state is more now. O(bodies).
    void record_exchange(const Bodies<Dim>& bodies) {
        const double before = kinetic_ + potential_;
        look_at(bodies);
        flows_.exchange += kinetic_ + potential_ - before;
    }

    double kinetic() const { return kinetic_; }      ///< now [J]
    double potential() const { return potential_; }  ///< now, zero at the origin [J]
    double kinetic_start() const { return kinetic_start_; }
    double potential_start() const { return potential_start_; }
    const EnergyFlows& flows() const { return flows_; }

    /// Change of the energy of the state that no flow accounts for [J].
    double missing() const {
        return (kinetic_ - kinetic_start_) + (potential_ - potential_start_) - flows_.sum();
    }
    /// The same relative to the largest energy that was around or went through [-]; 0 when nothing
    /// ever moved. About 1e-13 is rounding; more than 1e-10 is a fault.
    double closure() const {
        const double scale = std::max({largest_, kinetic_start_, flows_.magnitude()});
        return scale > 0.0 ? std::abs(missing()) / scale : 0.0;
    }

    /// To be carried through a checkpoint.
    void write(NumberRecord& out) const {
        out.array(gravity_);
        for (const double x :
             {flows_.friction, flows_.restitution, flows_.walls, flows_.applied, flows_.gyroscopic,
              flows_.correction, flows_.exchange, kinetic_, kinetic_start_, potential_,
              potential_start_, largest_, flows_.rolling, flows_.cell})
            out.real(x);
    }
    static EnergyLedger read(NumberRecordReader& in) {
        EnergyLedger books;
        books.gravity_ = in.array<Vector<Dim>>();
        for (double* x : {&books.flows_.friction, &books.flows_.restitution, &books.flows_.walls,
                          &books.flows_.applied, &books.flows_.gyroscopic, &books.flows_.correction,
                          &books.flows_.exchange, &books.kinetic_, &books.kinetic_start_,
                          &books.potential_, &books.potential_start_, &books.largest_})
            *x = in.real();
        // Books of before there were rolling friction and cells end here.
        for (double* x : {&books.flows_.rolling, &books.flows_.cell})
            if (in.has_real()) *x = in.real();
        return books;
    }

  private:
    void look_at(const Bodies<Dim>& bodies) {
        kinetic_ = kinetic_energy(bodies);
        potential_ = potential_energy(bodies, gravity_);
        largest_ = std::max(largest_, kinetic_ + std::abs(potential_ - potential_start_));
    }
    template <class Step>
    void record_contacts(const Step& step) {
        const ContactJacobian<Dim>& j = step.problem.jacobian;
        for (std::size_t c = 0; c < step.impulse.size(); ++c) {
            const auto a = static_cast<std::size_t>(j.a[c]);
            const auto b = static_cast<std::size_t>(j.b[c]);
            const auto local = [&](std::size_t i, const Vector<Dim>& arm) {
                return Vector<Dim>(j.frame[c] *
                                   (0.5 * (step.begin[i].at(arm) + step.end[i].at(arm))));
            };
            Vector<Dim> u_a = local(a, j.arm_a[c]);
            Vector<Dim> u_b = local(b, j.arm_b[c]);
            // Of a moving surface, what its shape does not do; only obstacles have one.
            const InverseMass<Dim>& w = step.problem.inverse_mass;
            const bool a_is_obstacle = w.linear[a] == 0.0;
            if (!j.held.empty()) {
                if (a_is_obstacle)
                    u_a[0] += j.held[c];
                else
                    u_b[0] -= j.held[c];
            }
            Vector<Dim> u = u_a - u_b;
            const Vector<Dim>& r = step.impulse[c];
            if (!j.carried.empty()) {
                Vector<Dim> of_cell = j.image_velocity(c);
                if (!j.cell_lever.empty())
                    of_cell += (0.5 * (step.cell_rate_end - j.cell_rate)) * j.carried[c];
                u -= j.frame[c] * of_cell;
                flows_.cell += r.dot(j.frame[c] * of_cell);
            }
            flows_.restitution += r[0] * u[0];
            flows_.friction += tangential(r).dot(tangential(u));
            if (a_is_obstacle) flows_.walls -= r.dot(u_a);
            if (w.linear[b] == 0.0) flows_.walls += r.dot(u_b);
        }
    }

    /// What bodies away from the home of a cell gain as it carries them along: before, at and after
    /// the midpoint, and against gravity.
    template <class Step>
    void record_cell(const Step& step, const Bodies<Dim>& bodies) {
        const Matrix<Dim> change = step.cell_rate_end - step.problem.jacobian.cell_rate;
        for (std::size_t i = 0; i < bodies.count(); ++i) {
            const Vector<Dim>& s = step.from_home[i];
            if (bodies.is_obstacle(i) || s.isZero(0.0)) continue;
            const Vector<Dim>& begin = step.begin[i].linear;
            const Vector<Dim>& end = step.end[i].linear;
            const Vector<Dim> before = step.cell_gains.begin * s, after = step.cell_gains.end * s;
            const double gained = before.dot(begin - 0.5 * before) +
                                  Vector<Dim>(change * s).dot(0.5 * (begin + end)) +
                                  after.dot(end + 0.5 * after) -
                                  gravity_.dot(step.cell_gains.way * s);
            flows_.cell += bodies.mass(i) * gained;
        }
    }

    template <class Step>
    void record_rolling(const Step& step) {
        const ContactJacobian<Dim>& j = step.problem.jacobian;
        const auto& linear = step.problem.inverse_mass.linear;
        for (std::size_t c = 0; c < step.moment.size(); ++c) {
            const auto work = [&](BodyIndex body) {
                const auto i = static_cast<std::size_t>(body);
                return step.moment[c].dot(0.5 * (step.begin[i].angular + step.end[i].angular));
            };
            flows_.rolling += work(j.a[c]) - work(j.b[c]);
            if (linear[static_cast<std::size_t>(j.a[c])] == 0.0) flows_.walls -= work(j.a[c]);
            if (linear[static_cast<std::size_t>(j.b[c])] == 0.0) flows_.walls += work(j.b[c]);
        }
    }

    template <class Step>
    void record_forces(const Step& step, const Bodies<Dim>& bodies) {
        if (step.applied.empty() && step.gyroscopic.empty()) return;
        for (std::size_t i = 0; i < bodies.count(); ++i) {
            if (bodies.is_obstacle(i)) continue;
            const Twist<Dim> mean{0.5 * (step.begin[i].linear + step.end[i].linear),
                                  0.5 * (step.begin[i].angular + step.end[i].angular)};
            if (!step.applied.empty()) flows_.applied += applied_work(step, bodies, i, mean);
            if (!step.gyroscopic.empty() && bodies.inverse_inertia[i].minCoeff() > 0.0) {
                const AngularVector<Dim> spin =
                    mid_rotation(bodies, i, step).spin_body(mean.angular);
                flows_.gyroscopic +=
                    spin.dot(step.gyroscopic[i].cwiseQuotient(bodies.inverse_inertia[i]));
            }
        }
    }

    template <class Step>
    static double applied_work(const Step& step, const Bodies<Dim>& bodies, std::size_t i,
                               const Twist<Dim>& mean) {
        Wrench<Dim> wrench = step.applied[i];
        const AngularVector<Dim>& inverse = bodies.inverse_inertia[i];
        if (inverse.minCoeff() == 0.0) {
            // Principal axes that do not turn take no work; moments about them have no meaning.
            const Rotation<Dim> mid = mid_rotation(bodies, i, step);
            AngularVector<Dim> torque = mid.spin_body(wrench.torque);
            for (int k = 0; k < rotation_dof<Dim>; ++k)
                if (inverse[k] == 0.0) torque[k] = 0.0;
            wrench.torque = mid.spin_world(torque);
        }
        return step.h * power<Dim>(wrench, mean);
    }

    /// That of the midpoint, from the state at the end: the body turned back by h/2 at its end
    /// spin.
    template <class Step>
    static Rotation<Dim> mid_rotation(const Bodies<Dim>& bodies, std::size_t i, const Step& step) {
        return bodies.rotation[i] * Rotation<Dim>::exp(-0.5 * step.h * bodies.spin[i]);
    }

    Vector<Dim> gravity_ = Vector<Dim>::Zero();
    EnergyFlows flows_;
    double kinetic_ = 0.0, kinetic_start_ = 0.0;
    double potential_ = 0.0, potential_start_ = 0.0;
    double largest_ = 0.0;
};

}  // namespace talus
