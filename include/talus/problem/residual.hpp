// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/check.hpp>
#include <talus/problem/concepts.hpp>
#include <talus/problem/contact_problem.hpp>
#include <talus/problem/delassus_product.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace talus {

/// How far impulses are from obeying all laws.
struct Residual {
    double relative = 0.0;  ///< the measure of ResidualMeasure [-]; NaN or infinity, see there
    std::size_t worst_contact = 0;  ///< the contact with the largest share
    double worst_share = 0.0;       ///< its error over the root mean square scale of a contact [-]

    bool finite() const { return std::isfinite(relative); }
};

/// The one measure that every solver is judged by. With u = W r + u_free,
///
///   eta = || D^-1/2 (r - f) || / max( || D^-1/2 r ||, || D^1/2 u_free || ),   D = diag(rho_c),
///
/// where f_c = natural_map(u_c, r_c, rho_c) of the contact's own exact law and rho_c [kg] is the
/// effective mass of the contact, Rows / trace(W_cc). Norms are Euclidean over all contacts.
///
/// Why so. (1) rho_c is the step that makes r_c - rho_c u_c a sum of comparable terms, so that f is
/// neither blind to r nor to u. (2) D^-1/2 r and D^1/2 u both are square roots of energies, so that
/// light and heavy contacts weigh alike and the quotient is the same in all units of length, mass
/// and time: grains of a micrometre and of a metre converge alike. (3) Both norms grow alike when
/// the problem is duplicated; `worst_share` keeps one bad contact among many visible. (4) The scale
/// takes the larger of the impulses and of the velocities to be stopped: a heavily loaded system
/// at rest and a fast one without load both have one.
///
/// Conventions. 0/0 is 0. If the scale is 0 and the error is not (a law that attracts), eta is 1.
/// A contact with W_cc = 0 (between obstacles) has no effective mass: it gets the Rows / trace of
/// the mean block (1 kg if all are 0), so that a velocity that no impulse can mend stays in eta.
/// Rows of different units (with rolling friction) need a length that makes them one, see
/// RollingCoulomb: sums over the rows of a contact, as here, are of one unit or of none.
/// Whatever is not finite in r, u, f or u_free makes eta not finite.
template <int Rows>
class ResidualMeasure {
  public:
    /// Takes the effective masses from W. Allocates only for a larger problem than any before.
    template <DelassusOperator<Rows> W>
    void prepare(const W& w) {
        rho_.resize(w.contact_count());
        double sum = 0.0;
        std::size_t positive = 0;
        for (std::size_t i = 0; i < rho_.size(); ++i) {
            const double trace = w.diagonal_block(i).trace();
            rho_[i] = Rows / trace;
            if (trace == 0.0) continue;
            sum += trace;
            ++positive;
        }
        const double spare = positive > 0 ? Rows * static_cast<double>(positive) / sum : 1.0;
        for (double& rho : rho_)
            if (std::isinf(rho)) rho = spare;
    }

    /// rho_c [kg].
    double effective_mass(std::size_t contact) const { return rho_[contact]; }

    /// max( || D^-1/2 r ||, || D^1/2 u_free || ) [sqrt(J)].
    double scale(std::span<const Vector<Rows>> free_velocity,
                 std::span<const Vector<Rows>> r) const {
        double impulses = 0.0, velocities = 0.0;
        for (std::size_t i = 0; i < rho_.size(); ++i) {
            impulses += r[i].squaredNorm() / rho_[i];
            velocities += free_velocity[i].squaredNorm() * rho_[i];
        }
        // Not std::max, which drops a NaN in its second argument.
        return std::sqrt(impulses > velocities || std::isnan(impulses) ? impulses : velocities);
    }

    /// The measure at r, where `velocity(i)` gives row i of W r.
    template <ContactLaw<Rows> Law, class Velocity>
    Residual evaluate(std::span<const Vector<Rows>> free_velocity, std::span<const Law> laws,
                      std::span<const Vector<Rows>> r, Velocity&& velocity) const {
        TALUS_CHECK(r.size() == rho_.size(), "one impulse per contact");
        Residual result;
        double sum = 0.0, worst = 0.0;
        for (std::size_t i = 0; i < rho_.size(); ++i) {
            const Vector<Rows> u = velocity(i) + free_velocity[i];
            const Vector<Rows> off = r[i] - laws[i].natural_map(u, r[i], rho_[i]);
            // A law may map a velocity that is not finite to a finite impulse (max(0, -inf)).
            const double share = off.squaredNorm() / rho_[i] + 0.0 * u.sum();
            sum += share;
            if (share > worst || std::isnan(share)) {
                worst = share;
                result.worst_contact = i;
            }
        }
        const double scale = this->scale(free_velocity, r);
        if (sum == 0.0 && std::isfinite(scale)) return result;
        const bool no_scale = scale == 0.0;
        result.relative = no_scale ? 1.0 + 0.0 * sum : std::sqrt(sum) / scale + 0.0 * scale;
        const double count = static_cast<double>(rho_.size());
        result.worst_share = no_scale ? 1.0 : std::sqrt(worst * count) / scale;
        return result;
    }

  private:
    std::vector<double> rho_;
};

/// The measure for a whole problem at impulses r, from scratch. Allocates; solvers keep a
/// ResidualMeasure instead. Throws input_error unless there is one impulse per contact.
template <int Dim, class Law>
Residual residual(const ContactProblem<Dim, Law>& problem, std::span<const Vector<Dim>> r) {
    if (r.size() != problem.contact_count())
        throw input_error("number of impulses is " + std::to_string(r.size()) +
                          ", but must be that of contacts, " +
                          std::to_string(problem.contact_count()));
    DelassusProduct<Dim> w(problem.jacobian, problem.inverse_mass);
    ResidualMeasure<Dim> measure;
    measure.prepare(w);
    w.start(r);
    return measure.template evaluate<Law>(problem.free_velocity, problem.laws, r,
                                          [&](std::size_t i) { return w.velocity(i); });
}

}  // namespace talus
