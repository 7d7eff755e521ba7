// SPDX-License-Identifier: BSL-1.0
#include <talus/law/prepared.hpp>

namespace law_concepts {

using talus::LocalProblem;
using talus::Matrix;
using talus::Vector;

/// The least that a law must have.
template <int Dim>
struct Archetype {
    Vector<Dim> solve(const LocalProblem<Dim>&, const Vector<Dim>& r) const { return r; }
    Vector<Dim> natural_map(const Vector<Dim>&, const Vector<Dim>& r, double) const { return r; }
};
static_assert(talus::ContactLaw<Archetype<2>, 2> && talus::ContactLaw<Archetype<3>, 3>);
static_assert(!talus::ContactLaw<Archetype<2>, 3>);
static_assert(!talus::PreparableLaw<Archetype<3>, 3> && !talus::RestitutionLaw<Archetype<3>, 3>);
static_assert(std::same_as<talus::Prepared<Archetype<3>, 3>, talus::PlainBlock<3>>);

struct WithoutNaturalMap {
    Vector<3> solve(const LocalProblem<3>&, const Vector<3>& r) const { return r; }
};
static_assert(!talus::ContactLaw<WithoutNaturalMap, 3>);

struct SolveNotConst {
    Vector<3> solve(const LocalProblem<3>&, const Vector<3>& r) { return r; }
    Vector<3> natural_map(const Vector<3>&, const Vector<3>& r, double) const { return r; }
};
static_assert(!talus::ContactLaw<SolveNotConst, 3>);

struct NotCopyable : Archetype<3> {
    NotCopyable(const NotCopyable&) = delete;
};
static_assert(!talus::ContactLaw<NotCopyable, 3>);

struct WithPreparation : Archetype<3> {
    double prepare(const Matrix<3>& w) const { return w(0, 0); }
    Vector<3> improved(double, const Vector<3>&, const Vector<3>& r) const { return r; }
};
static_assert(talus::PreparableLaw<WithPreparation, 3>);
static_assert(std::same_as<talus::Prepared<WithPreparation, 3>, double>);

/// Prepares, but cannot use what it prepared: an ordinary law.
struct HalfPrepared : Archetype<3> {
    double prepare(const Matrix<3>& w) const { return w(0, 0); }
};
static_assert(talus::ContactLaw<HalfPrepared, 3> && !talus::PreparableLaw<HalfPrepared, 3>);

/// Laws may have more rows than space, of a known number.
static_assert(talus::ContactLaw<Archetype<5>, 5> && !talus::ContactLaw<Archetype<5>, 3>);
template <int N>
constexpr bool is_contact = talus::ContactRows<N>;
template <int N>
constexpr bool is_rolling = talus::RollingRows<N>;
static_assert(is_contact<2> && is_contact<3> && is_contact<5> && !is_contact<4> && !is_contact<6>);
static_assert(!is_rolling<2> && is_rolling<3> && is_rolling<5>);
static_assert(!talus::has_rolling_rows<Archetype<3>>);

}  // namespace law_concepts
