// SPDX-License-Identifier: BSL-1.0
#include <talus/problem/concepts.hpp>

namespace {

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

}  // namespace
