// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/check.hpp>
#include <talus/core/column.hpp>
#include <talus/core/input.hpp>
#include <talus/core/room.hpp>
#include <talus/problem/concepts.hpp>
#include <talus/problem/contact_problem.hpp>
#include <talus/problem/delassus_product.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace talus {

/// How far impulses are from obeying all laws: in the whole, and at the worst contact.
struct Residual {
    /// What tolerances are set on [-]: the larger of `whole` and a tenth of `contact`. NaN or
    /// infinity, see ResidualMeasure.
    double relative = 0.0;
    double whole = 0.0;  ///< eta of ResidualMeasure: of all contacts together [-]
    /// zeta of ResidualMeasure: the worst contact, in the scale of its own island [-].
    double contact = 0.0;
    /// What the rounding of velocities may make of `contact`, of which as much is not counted [-].
    double rounding = 0.0;
    std::size_t worst_contact = 0;  ///< where that is
    /// The largest velocity by which a contact's law is violated [m/s]: times sqrt(1 + mu^2) or 2,
    /// whichever is less, no overlap grows faster for the residual's sake.
    double velocity = 0.0;
    std::size_t fastest_contact = 0;  ///< where that is
    double worst_share = 0.0;  ///< largest error over the root mean square scale of a contact [-]

    /// Of `contact` in `relative`.
    static constexpr double share_of_contact = 0.1;
    /// A `contact` that no impulses at all would hardly exceed: without them it is 1 or less.
    static constexpr double worse_than_none = 10.0;

    bool finite() const { return std::isfinite(relative); }
    /// Sets `relative` from the other two. What is not finite in the whole stays so.
    void combine() {
        const bool contact_counts = std::isfinite(whole) && share_of_contact * contact > whole;
        relative = contact_counts ? share_of_contact * contact : whole;
    }
};

/// The scale V of each contact, and the worst contact by it: the part of ResidualMeasure that makes
/// zeta.
class ContactScales {
  public:
    /// The islands of an operator, which may say what hangs together by `islands(label)`; otherwise
    /// it is one island.
    template <class W>
    void find_islands(const W& w) {
        make_room(w.contact_count());
        if constexpr (requires(std::span<std::uint32_t> label) { w.islands(label); })
            w.islands(std::span<std::uint32_t>(label_));
        number_islands();
    }
    std::size_t contact_count() const { return label_.size(); }
    /// Knows no problem.
    void clear() { label_.clear(); }
    /// Squares of the velocity by which contact i violates its law without any impulse, and of its
    /// free velocity.
    void see_violation(std::size_t i, double square, double free) {
        Island& island = island_[label_[i]];
        island.violated = std::max(island.violated, std::sqrt(square));
        island.fastest = std::max(island.fastest, std::sqrt(free));
        fastest_ = std::max(fastest_, std::sqrt(free));
    }

    /// Square of r_i / rho_i of the impulses that the free velocities were computed beside: those
    /// that a solve begins with.
    void see_start(std::size_t i, double square) {
        Island& island = island_[label_[i]];
        island.noise = std::max(island.noise, lost * std::sqrt(square));
    }

    /// V of contact i, as far as it does not depend on impulses [m/s].
    double velocity(std::size_t i) const { return free_scale(island_[label_[i]]); }

    /// Before the contacts are judged.
    void begin() {
        for (Island& island : island_) {
            island.largest = island.error = 0.0;
            island.worst = island.strongest = 0;
        }
    }
    /// Contact i: squares of the velocity by which its law is violated and of r_i / rho_i.
    void see(std::size_t i, double error, double largest) {
        Island& island = island_[label_[i]];
        if (largest > island.largest) {
            island.largest = largest;
            island.strongest = i;
        }
        if (!(error > island.error)) return;
        island.error = error;
        island.worst = i;
    }
    /// Fills `contact`, `rounding`, `velocity` and the contacts they are of.
    void judge(Residual& result) const {
        for (const Island& island : island_) {
            const double error = std::sqrt(island.error);
            if (error > result.velocity) {
                result.velocity = error;
                result.fastest_contact = island.worst;
            }
            const double largest = std::sqrt(island.largest);
            const double v = free_scale(island);
            // Without any load there is no other scale than the impulses' own.
            const bool jam = v > 0.0 && v <= island.noise;
            const double scale = jam ? island.noise : v > 0.0 ? v : largest;
            const double rounded = rounding * (largest + fastest_);
            if (scale > 0.0) result.rounding = std::max(result.rounding, rounded / scale);
            const double counted = error - rounded;
            double zeta = 0.0;
            if (counted > 0.0) zeta = scale > 0.0 ? counted / scale : 1.0;
            const bool illegible = lost * largest > (jam ? growth : 1.0) * scale;
            if (illegible) zeta = std::max(zeta, Residual::worse_than_none);
            if (!(zeta > result.contact)) continue;
            result.contact = zeta;
            result.worst_contact = illegible ? island.strongest : island.worst;
        }
    }

  private:
    struct Island {
        double violated = 0.0;  ///< largest velocity of violation without impulses [m/s]
        double fastest = 0.0;   ///< free velocity [m/s]
        double noise = 0.0;     ///< what free velocities are when they should be zero [m/s]
        double error = 0.0;     ///< square of the largest velocity of violation [m^2/s^2]
        double largest = 0.0;   ///< of the squares of r_c / rho_c [m^2/s^2]
        std::size_t worst = 0, strongest = 0;  ///< contacts of `error` and of `largest`
    };
    static constexpr double nothing = 1e-12, share_of_speed = 1e-3;
    /// Of the last digits of velocities that large.
    static constexpr double rounding = 32.0 * std::numeric_limits<double>::epsilon();
    /// V over the largest r / rho, below which impulses hide it in their digits, and below which a
    /// jam that a solve begins with explains it: `rounding` of r / rho is then up to 2e-4 of V,
    /// less than the 1e-3 of V that a tolerance of 1e-4 allows. One number for both, so that no jam
    /// is in between: what it begins with, V does not hide.
    static constexpr double lost = 4e-11;
    /// How often the largest impulse that it begins with a jam may have.
    static constexpr double growth = 1.01;
    double free_scale(const Island& island) const {
        const double v = std::max(island.violated, share_of_speed * island.fastest);
        return v > nothing * fastest_ ? v : share_of_speed * fastest_;
    }

    void make_room(std::size_t n) {
        detail::make_room(label_, n);
        detail::make_room(index_, n);
        detail::make_room(island_, n);
        label_.assign(n, 0);
    }
    /// Labels without gaps, in the order of their first contacts.
    void number_islands() {
        index_.assign(label_.size(), unseen);
        std::uint32_t count = 0;
        for (std::uint32_t& label : label_) {
            if (index_[label] == unseen) index_[label] = count++;
            label = index_[label];
        }
        island_.assign(count, Island{});
        fastest_ = 0.0;
    }

    static constexpr std::uint32_t unseen = std::numeric_limits<std::uint32_t>::max();
    Column<std::uint32_t> label_;  ///< island of each contact
    Column<std::uint32_t> index_;
    Column<Island> island_;
    double fastest_ = 0.0;  ///< free velocity of any contact [m/s]
};

/// The one measure that every solver is judged by: max(eta, zeta / 10). With u = W r + u_free,
///
///   eta  = || D^-1/2 (r - f) || / max( || D^-1/2 r ||, || D^1/2 u_free || ),   D = diag(rho_c),
///   zeta = max_c  max( | r_c - f_c |, s_c ) / ( rho_c V_c ),
///
/// where f_c = natural_map(u_c, r_c, rho_c) of the contact's own exact law and rho_c [kg] is the
/// effective mass of the contact, Rows / trace(W_cc). Norms of eta are Euclidean over all contacts.
///
/// Why eta so. (1) rho_c is the step that makes r_c - rho_c u_c a sum of comparable terms, so that
/// f is neither blind to r nor to u. (2) D^-1/2 r and D^1/2 u both are square roots of energies, so
/// that light and heavy contacts weigh alike and the quotient is the same in all units of length,
/// mass and time: grains of a micrometre and of a metre converge alike. (3) Both norms grow alike
/// when the problem is duplicated. (4) The scale takes the larger of the impulses and of the
/// velocities to be stopped: a heavily loaded system at rest and a fast one without load both have
/// one.
///
/// Why zeta beside it. An error of a velocity v costs eta only v sqrt(rho_c): where a light grain
/// carries a heavy one, rho_c is the light one's, and the heavy one may fall freely with an eta of
/// the root of the ratio of masses. |r_c - f_c| / rho_c is the velocity by which contact c violates
/// its law; with Coulomb friction above mu = 0.8 the larger of it and of s_c / rho_c, half the
/// violation that the natural map hides on a steep cone (FrictionCone::steep_error; laws without a
/// `steep_error`, as RollingCoulomb, are judged by their natural map alone). V_c is the largest of
/// the first kind that there would be without any impulse, among the contacts of its island: those
/// that chains of free bodies connect with it. For bodies at rest under gravity V is h g, and never
/// less than a thousandth of the largest u_free of the island, so that contacts which separate by
/// themselves are not judged by nothing; what happens elsewhere, however fast, hides nothing. (An
/// island in which nothing moves, to 1e-12 of the largest u_free anywhere, has no scale of its own:
/// V is a thousandth of that. Where V is no more than 4e-11 of the largest r_c / rho_c that a solve
/// begins with, as in a wedge that stays jammed without loads, it is what rounding has left of
/// zero, and V is those 4e-11 themselves: a jam must balance to its last digits. Where V is zero,
/// nothing is loaded at all: it is the largest r_c / rho_c.) What the rounding of the largest
/// velocity r_c / rho_c of the island, and of the largest of u_free anywhere, explains, 32 epsilon
/// of them, is not counted as an error; but where V is less than 4e-11 of that velocity, too little
/// of V is left in its digits, and zeta is at least 10: a body between obstacles that close on it
/// would have impulses without end, beside which the violation is no more than a last digit. A
/// tenth of zeta is asked for, since the worst of many contacts is some way above their mean: in
/// piles at rest zeta is some 400 eta.
///
/// What it means for motion. A contact's overlap grows by no more than (10 tolerance + 2e-4) V h
/// min(2, sqrt(1 + mu^2)) in a step for want of accuracy, where the 2e-4 are what rounding may
/// explain of V beside impulses of 2.5e10 times V (`rounding` says how much it is; more only where
/// something elsewhere is faster than that): at rest, where V = g h, by some 1e-3 g h^2 at a
/// tolerance of 1e-4. A contact of an island that something fast has hit is judged in the scale of
/// that: it may be left to fall freely for a step where its g h is a thousandth of the fastest
/// violation.
///
/// Conventions. 0/0 is 0. If the scale is 0 and the error is not (a law that attracts), eta and
/// zeta are 1. A contact with W_cc = 0 (between obstacles) has no effective mass: it gets the Rows
/// / trace of the mean block (1 kg if all are 0), so that a velocity that no impulse can mend
/// stays. Rows of different units (with rolling friction) need a length that makes them one, see
/// RollingCoulomb: sums over the rows of a contact, as here, are of one unit or of none.
/// Whatever is not finite in r, u, f or u_free makes eta not finite.
template <int Rows>
class ResidualMeasure {
  public:
    /// Takes the effective masses from W: enough for effective_mass and scale. Allocates only for a
    /// larger problem than any before.
    template <DelassusOperator<Rows> W>
    void prepare(const W& w) {
        scales_.clear();
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
    /// Takes also what zeta needs: islands, and the velocities V of their contacts. An operator
    /// that does not say what hangs together is one island.
    /// `start`, one impulse per contact or none: those that a solve begins with, whose rounding is
    /// in the free velocities.
    template <DelassusOperator<Rows> W, ContactLaw<Rows> Law>
    void prepare(const W& w, std::span<const Vector<Rows>> free_velocity, std::span<const Law> laws,
                 std::span<const Vector<Rows>> start = {}) {
        prepare(w);
        scales_.find_islands(w);
        for (std::size_t i = 0; i < rho_.size(); ++i) {
            const Vector<Rows> f =
                laws[i].natural_map(free_velocity[i], Vector<Rows>::Zero(), rho_[i]);
            scales_.see_violation(i, f.squaredNorm() / (rho_[i] * rho_[i]),
                                  free_velocity[i].squaredNorm());
            if (!start.empty()) scales_.see_start(i, start[i].squaredNorm() / (rho_[i] * rho_[i]));
        }
    }

    /// What zeta needs; empty if W alone was given.
    const ContactScales& scales() const { return scales_; }
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

    /// The measure at r, where `velocity(i)` gives row i of W r, of the problem that `prepare` was
    /// given; without zeta if that was given W alone.
    template <ContactLaw<Rows> Law, class Velocity>
    Residual evaluate(std::span<const Vector<Rows>> free_velocity, std::span<const Law> laws,
                      std::span<const Vector<Rows>> r, Velocity&& velocity) {
        TALUS_CHECK(r.size() == rho_.size(), "one impulse per contact");
        const bool by_contacts = scales_.contact_count() == rho_.size();
        Residual result;
        double sum = 0.0, worst = 0.0;
        scales_.begin();
        for (std::size_t i = 0; i < rho_.size(); ++i) {
            const Vector<Rows> u = velocity(i) + free_velocity[i];
            const Vector<Rows> off = r[i] - laws[i].natural_map(u, r[i], rho_[i]);
            // A law may map a velocity that is not finite to a finite impulse (max(0, -inf)).
            const double share = off.squaredNorm() / rho_[i] + 0.0 * u.sum();
            sum += share;
            if (share > worst || std::isnan(share)) worst = share;
            if (!by_contacts) continue;
            const double steep = steep_error<Rows>(laws[i], u, r[i], rho_[i]) / rho_[i];
            scales_.see(i, std::max(share / rho_[i], steep * steep),
                        r[i].squaredNorm() / (rho_[i] * rho_[i]));
        }
        const double scale = this->scale(free_velocity, r);
        if (sum != 0.0 || !std::isfinite(scale)) {
            const bool no_scale = scale == 0.0;
            result.whole = no_scale ? 1.0 + 0.0 * sum : std::sqrt(sum) / scale + 0.0 * scale;
            const double count = static_cast<double>(rho_.size());
            result.worst_share = no_scale ? 1.0 : std::sqrt(worst * count) / scale;
        }
        if (by_contacts) scales_.judge(result);
        result.combine();
        return result;
    }

  private:
    Column<double> rho_;
    ContactScales scales_;
};

/// The measure for a whole problem at impulses r, from scratch. Allocates; solvers keep a
/// ResidualMeasure instead. `start`, one impulse per contact or none: those that the solver began
/// with, without which a jam with loads of rounding alone is not told from impulses without end.
/// Throws input_error unless there is one impulse per contact.
template <int Dim, class Law>
Residual residual(const ContactProblem<Dim, Law>& problem,
                  std::span<const Vector<law_rows<Law, Dim>>> r,
                  std::span<const Vector<law_rows<Law, Dim>>> start = {}) {
    constexpr int rows = law_rows<Law, Dim>;
    using W = DelassusProduct<Dim, AngularMatrix<Dim>, rows>;
    require_count("impulses", r.size(), "contacts", problem.contact_count());
    if (!start.empty())
        require_count("impulses of the start", start.size(), "contacts", problem.contact_count());
    W w(problem.jacobian, problem.inverse_mass);
    ResidualMeasure<rows> measure;
    measure.template prepare<W, Law>(w, problem.free_velocity, problem.laws, start);
    w.start(r);
    return measure.template evaluate<Law>(problem.free_velocity, problem.laws, r,
                                          [&](std::size_t i) { return w.velocity(i); });
}

}  // namespace talus
