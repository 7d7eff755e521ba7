// SPDX-License-Identifier: BSL-1.0
#include <talus/law/any_law.hpp>
#include <talus/law/cohesive.hpp>
#include <talus/law/coulomb.hpp>
#include <talus/law/rolling_coulomb.hpp>
#include <talus/problem/concepts.hpp>
#include <talus/problem/contact_problem.hpp>
#include <talus/problem/delassus_product.hpp>

namespace problem_concepts {

using talus::Matrix;
using talus::Vector;
using In = std::span<const Vector<3>>;
using Out = std::span<Vector<3>>;

struct Operator {
    std::size_t contact_count() const { return 0; }
    Matrix<3> diagonal_block(std::size_t) const { return Matrix<3>::Zero(); }
    void multiply(In, Out) const {}
};
static_assert(talus::DelassusOperator<Operator, 3>);
static_assert(!talus::DelassusOperator<Operator, 2>);
static_assert(!talus::SweepableDelassus<Operator, 3>);

struct Sweepable : Operator {
    void start(In) {}
    Vector<3> velocity(std::size_t) const { return Vector<3>::Zero(); }
    void add(std::size_t, const Vector<3>&) {}
};
static_assert(talus::SweepableDelassus<Sweepable, 3>);

struct MultiplyNotConst : Sweepable {
    void multiply(In, Out) {}
};
static_assert(!talus::DelassusOperator<MultiplyNotConst, 3>);

struct BlockWithoutValue : Sweepable {
    void diagonal_block(std::size_t) const {}
};
static_assert(!talus::DelassusOperator<BlockWithoutValue, 3>);

/// Rigid bodies give the rows that a law asks for; three rows of the plane are not those of space.
template <class Law, int Dim>
concept OfRigidBodies = requires {
    typename talus::ContactProblem<Dim, Law>;
};
using Rolling = talus::RollingCoulomb<3>;
static_assert(OfRigidBodies<talus::Coulomb<3>, 3> && !OfRigidBodies<talus::Coulomb<3>, 2>);
static_assert(OfRigidBodies<Rolling, 2> && !OfRigidBodies<Rolling, 3>);
static_assert(OfRigidBodies<talus::RollingCoulomb<5>, 3> &&
              !OfRigidBodies<talus::RollingCoulomb<5>, 5>);
static_assert(OfRigidBodies<talus::Cohesive<3, Rolling>, 2> &&
              !OfRigidBodies<talus::AnyLaw<3, talus::Coulomb<3>, Rolling>, 3>);
using RollingW = talus::DelassusProduct<3, talus::AngularMatrix<3>, 5>;
static_assert(talus::SweepableDelassus<RollingW, 5> && !talus::DelassusOperator<RollingW, 3>);

}  // namespace problem_concepts
