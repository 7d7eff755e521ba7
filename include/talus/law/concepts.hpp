// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/law/local_problem.hpp>

#include <concepts>

namespace talus {

/// The relation that a contact of gap <= 0 imposes between its relative velocity u [m/s] and its
/// impulse r [N s], both in the local frame, normal first. Models are of prospective type
/// [Moreau, (6)(7)]: u_n >= 0 always, and u_n > 0 implies r = 0 (a bilateral constraint, which is
/// no contact, excepted, and a cohesive one, whose r is then the cohesion's).
///
/// `natural_map(u, r, rho)` is a map whose fixed points in r are the impulses that obey the law
/// with u, for any rho > 0 [kg]: the law's one measure of error. `solve` answers the one-contact
/// problem; when that has several solutions (the Painleve range) it returns one of them, the same
/// for the same input, and when it has none (W r + b cannot meet the law) the r it returns shows it
/// in the natural map. It never fails otherwise and never returns a NaN.
template <class L, int Rows>
concept ContactLaw = std::copyable<L> &&
    requires(const L& law, const LocalProblem<Rows>& p, const Vector<Rows>& u,
             const Vector<Rows>& r, double rho) {
    { law.solve(p, r) } -> std::convertible_to<Vector<Rows>>;             // started from r [N s]
    { law.natural_map(u, r, rho) } -> std::convertible_to<Vector<Rows>>;  // = r iff obeyed [N s]
};

/// Optional extension: a law that does once what depends on W alone. `prepare(W)` returns a value
/// kept over the sweeps of one solve; `improved(prepared, u, r)` is the impulse that solves the
/// one-contact problem, given the velocity u = W r + b that the present impulse r leads to. Solvers
/// take any ContactLaw and use the extension where a law has it (law/prepared.hpp).
template <class L, int Rows>
concept PreparableLaw = ContactLaw<L, Rows> &&
    requires(const L& law, const Matrix<Rows>& w, const Vector<Rows>& u, const Vector<Rows>& r) {
    { law.prepare(w) } -> std::copyable;
    { law.improved(law.prepare(w), u, r) } -> std::convertible_to<Vector<Rows>>;  // [N s]
};

/// A law that looks at a weighted mean of the velocities at begin and end of the step: in terms of
/// the end velocity it is the law without restitution with `restitution_shift(u_begin)` added to
/// the velocity, which assembly adds to b once per step.
template <class L, int Rows>
concept RestitutionLaw = ContactLaw<L, Rows> &&
    requires(const L& law, const Vector<Rows>& u_begin) {
    { law.restitution_shift(u_begin) } -> std::convertible_to<Vector<Rows>>;  // [m/s]
};

/// What the natural map hides of the error of r beside u: of a law that says so by a member
/// `steep_error` (FrictionCone), otherwise 0 [N s].
template <int Rows, class Law>
double steep_error(const Law& law, const Vector<Rows>& u, const Vector<Rows>& r, double rho) {
    if constexpr (requires { law.steep_error(u, r, rho); })
        return law.steep_error(u, r, rho);
    else
        return 0.0;
}

/// A law that `WeightedMean` can adapt. One that has a restitution itself, even if of an inner law,
/// would lose it: a contact has one weighted mean.
template <class L, int Rows>
concept LawWithoutRestitution = ContactLaw<L, Rows> && !RestitutionLaw<L, Rows>;

/// Whether the rows after the tangents are rolling components: laws say so by a member
/// `rolling_rows`, adaptors pass on what they hold.
template <class L>
inline constexpr bool has_rolling_rows = [] {
    if constexpr (requires { L::rolling_rows; })
        return L::rolling_rows;
    else
        return false;
}();

/// The rows that a law asks of a contact in space of that dimension: those of space, or the rolling
/// ones as well.
template <class L, int Dim>
requires SpaceDimension<Dim>
inline constexpr int law_rows = has_rolling_rows<L> ? rows_with_rolling<Dim> : Dim;

/// A law of rigid bodies in space of that dimension.
template <class L, int Dim>
concept BodyLaw = ContactLaw<L, law_rows<L, Dim>>;

/// The dimension of the space in which a law of so many rows is one of rigid bodies.
template <class L, int Rows>
inline constexpr int law_space = has_rolling_rows<L> ? (Rows + 1) / 2 : Rows;

/// A law with the rows of space alone: what solvers take that do not know rolling ones.
template <class L, int Dim>
concept LawWithoutRolling = !has_rolling_rows<L> && SpaceDimension<Dim> && ContactLaw<L, Dim>;

/// Whether a law says of itself, by `pushes_only`, that it never pulls, so that nobody need ask it
/// at every contact. Adaptors pass on what they hold.
template <class L>
inline constexpr bool pushes_only = [] {
    if constexpr (requires { L::pushes_only; })
        return L::pushes_only;
    else
        return false;
}();

}  // namespace talus
