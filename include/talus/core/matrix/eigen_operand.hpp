// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstddef>

#ifdef EIGEN_DEFAULT_TO_ROW_MAJOR
#error "talus needs Eigen's usual order of storage, by columns: EIGEN_DEFAULT_TO_ROW_MAJOR is set"
#endif

namespace talus {

template <int Rows, int Cols, class Real>
class SmallMatrix;

}  // namespace talus

/// What makes a SmallMatrix an operand of Eigen's expressions, of assignments to Eigen's matrices
/// and of their constructors, for programs that include Eigen; it compiles without. Eigen's
/// templates are declared here and its class hierarchy ends, for a SmallMatrix, in three bases of
/// our own, which hold nothing.
namespace Eigen {

struct Dense;
template <class Derived>
struct EigenBase;
template <class Derived>
class DenseBase;
template <class Derived>
class MatrixBase;
template <class Derived>
class DiagonalBase;
template <class Scalar, int Rows, int Cols, int Options, int MaxRows, int MaxCols>
class Matrix;
template <int OuterStride, int InnerStride>
class Stride;
template <class PlainObject, int Options, class Strides>
class Map;
template <class PlainObject, int Options, class Strides>
class Ref;
template <class Operation, class PlainObject>
class CwiseNullaryOp;

namespace internal {

template <class T>
struct traits;
template <class T>
struct evaluator;
template <class Scalar>
struct scalar_constant_op;

}  // namespace internal
}  // namespace Eigen

namespace talus::detail {

template <class T>
inline constexpr bool is_small_matrix = false;
template <int Rows, int Cols, class Real>
inline constexpr bool is_small_matrix<SmallMatrix<Rows, Cols, Real>> = true;

/// Of those that derive from a template of Eigen's, which ones are Eigen's.
template <class D>
concept EigenExpression = !is_small_matrix<D>;

/// Those of which a number of rows or columns may be `wanted`; Eigen says -1 for any.
constexpr bool may_be(int number, int wanted) { return number == wanted || number == -1; }
/// Those that can have as many rows and columns, or, of vectors, columns and rows.
template <class D, int Rows, int Cols>
concept FitsInto = EigenExpression<D> &&
    ((may_be(int(D::RowsAtCompileTime), Rows) && may_be(int(D::ColsAtCompileTime), Cols)) ||
     ((Rows == 1 || Cols == 1) && may_be(int(D::RowsAtCompileTime), Cols) &&
      may_be(int(D::ColsAtCompileTime), Rows)));

/// Eigen's matrix of the same numbers in the same order.
template <int Rows, int Cols, class Real>
using EigenMatrix = Eigen::Matrix<Real, Rows, Cols, Rows == 1 && Cols != 1 ? 1 : 0, Rows, Cols>;

/// Vectors and matrices that fill whole pairs of doubles are aligned as those are, for whatever
/// instructions a file is compiled.
template <int Rows, int Cols, class Real>
inline constexpr std::size_t matrix_alignment = sizeof(Real) * Rows* Cols % 16 == 0 ? 16
                                                                                    : alignof(Real);

/// The numbers at some place, as an Eigen matrix. `Matrix` is an EigenMatrix, const or not.
template <class Matrix, std::size_t Alignment>
using EigenMap = Eigen::Map<Matrix, Alignment == 16 ? 16 : 0, Eigen::Stride<0, 0>>;

}  // namespace talus::detail

template <int Rows, int Cols, class Real>
struct Eigen::EigenBase<talus::SmallMatrix<Rows, Cols, Real>> {
    using Derived = talus::SmallMatrix<Rows, Cols, Real>;
    using Index = std::ptrdiff_t;
    using StorageKind = Dense;

    Derived& derived() { return *static_cast<Derived*>(this); }
    const Derived& derived() const { return *static_cast<const Derived*>(this); }
    Derived& const_cast_derived() const { return *const_cast<Derived*>(&derived()); }
    const Derived& const_derived() const { return derived(); }
    static constexpr Index rows() { return Rows; }
    static constexpr Index cols() { return Cols; }
    static constexpr Index size() { return Index{Rows} * Cols; }
};

template <int Rows, int Cols, class Real>
class Eigen::DenseBase<talus::SmallMatrix<Rows, Cols, Real>>
    : public Eigen::EigenBase<talus::SmallMatrix<Rows, Cols, Real>> {
  public:
    using Scalar = Real;
    using value_type = Real;
    using RealScalar = Real;
    using CoeffReturnType = const Real&;
    using StorageIndex = std::ptrdiff_t;
    using PlainObject = talus::detail::EigenMatrix<Rows, Cols, Real>;
    using PlainMatrix = PlainObject;
    using ConstantReturnType =
        Eigen::CwiseNullaryOp<Eigen::internal::scalar_constant_op<Real>, PlainObject>;
    using Base = PlainObject;  ///< whose sizes an Eigen::Map checks
    /// Expressions hold it by value: it may be one that a function returned.
    using Nested = const talus::SmallMatrix<Rows, Cols, Real>;
    static constexpr int RowsAtCompileTime = Rows, ColsAtCompileTime = Cols,
                         SizeAtCompileTime = Rows * Cols, MaxRowsAtCompileTime = Rows,
                         MaxColsAtCompileTime = Cols, MaxSizeAtCompileTime = Rows * Cols,
                         IsRowMajor = Rows == 1 && Cols != 1 ? 1 : 0, InnerStrideAtCompileTime = 1,
                         InnerSizeAtCompileTime = Rows == 1 ? Cols : Rows,
                         OuterStrideAtCompileTime = InnerSizeAtCompileTime,
                         NumDimensions = Rows * Cols == 1         ? 0
                                         : Rows == 1 || Cols == 1 ? 1
                                                                  : 2,
                         IsPlainObjectBase = 0;
    static constexpr bool IsVectorAtCompileTime = Rows == 1 || Cols == 1;
    /// RowMajorBit, LvalueBit and DirectAccessBit of Eigen; not NestByRefBit.
    static constexpr int Flags = IsRowMajor | 0x20 | 0x40;

    static constexpr std::ptrdiff_t innerStride() { return 1; }
    static constexpr std::ptrdiff_t outerStride() { return OuterStrideAtCompileTime; }
    static constexpr std::ptrdiff_t innerSize() { return InnerSizeAtCompileTime; }
    static constexpr std::ptrdiff_t outerSize() { return Rows * Cols / InnerSizeAtCompileTime; }
    PlainObject eval() const { return this->derived().eigen(); }
};

template <int Rows, int Cols, class Real>
class Eigen::MatrixBase<talus::SmallMatrix<Rows, Cols, Real>>
    : public Eigen::DenseBase<talus::SmallMatrix<Rows, Cols, Real>> {
  public:
    // For functions that take a MatrixBase and ask it: SmallMatrix has its own, which hide these.
    decltype(auto) operator()(auto... at) { return this->derived()(at...); }
    decltype(auto) operator()(auto... at) const { return this->derived()(at...); }
    decltype(auto) operator[](std::ptrdiff_t i) { return this->derived()[i]; }
    decltype(auto) operator[](std::ptrdiff_t i) const { return this->derived()[i]; }
    auto norm() const { return this->derived().norm(); }
    auto squaredNorm() const { return this->derived().squaredNorm(); }
    auto normalized() const { return this->derived().normalized(); }
    auto sum() const { return this->derived().sum(); }
    auto trace() const { return this->derived().trace(); }
    auto transpose() const { return this->derived().transpose(); }
    auto dot(const auto& other) const { return this->derived().dot(other.derived()); }
    auto cross(const auto& other) const { return this->derived().cross(other.derived()); }

    // By Eigen, lazy as ever, for programs that include what of Eigen they need.
    auto array() { return this->derived().eigen().array(); }
    auto array() const { return this->derived().eigen().array(); }
    talus::SmallMatrix<Cols, Rows, Real> inverse() const requires(Rows == Cols) {
        return this->derived().eigen().inverse();
    }
    auto asDiagonal() const { return this->derived().eigen().asDiagonal(); }
    auto colwise() const { return this->derived().eigen().colwise(); }
    auto rowwise() const { return this->derived().eigen().rowwise(); }
    template <int P>
    Real lpNorm() const {
        return this->derived().eigen().template lpNorm<P>();
    }
    template <unsigned Mode>
    auto triangularView() const {
        return this->derived().eigen().template triangularView<Mode>();
    }
    template <unsigned Mode>
    auto selfadjointView() const {
        return this->derived().eigen().template selfadjointView<Mode>();
    }
    auto llt() const { return this->derived().eigen().llt(); }
    auto ldlt() const { return this->derived().eigen().ldlt(); }
    auto partialPivLu() const { return this->derived().eigen().partialPivLu(); }
    auto fullPivLu() const { return this->derived().eigen().fullPivLu(); }
    auto lu() const { return this->derived().eigen().lu(); }
    auto householderQr() const { return this->derived().eigen().householderQr(); }
    auto colPivHouseholderQr() const { return this->derived().eigen().colPivHouseholderQr(); }
    auto jacobiSvd(unsigned options = 0) const {
        return this->derived().eigen().jacobiSvd(options);
    }
    auto eigenvalues() const { return this->derived().eigen().eigenvalues(); }
};

template <int Rows, int Cols, class Real>
struct Eigen::internal::traits<talus::SmallMatrix<Rows, Cols, Real>>
    : Eigen::internal::traits<talus::detail::EigenMatrix<Rows, Cols, Real>> {
    static constexpr int Flags = talus::SmallMatrix<Rows, Cols, Real>::Flags,
                         Alignment =
                             talus::detail::matrix_alignment<Rows, Cols, Real> == 16 ? 16 : 0;
};

template <int Rows, int Cols, class Real>
struct Eigen::internal::evaluator<talus::SmallMatrix<Rows, Cols, Real>>
    : Eigen::internal::evaluator<
          talus::detail::EigenMap<const talus::detail::EigenMatrix<Rows, Cols, Real>,
                                  talus::detail::matrix_alignment<Rows, Cols, Real>>> {
    using Numbers = talus::detail::EigenMap<const talus::detail::EigenMatrix<Rows, Cols, Real>,
                                            talus::detail::matrix_alignment<Rows, Cols, Real>>;
    explicit evaluator(const talus::SmallMatrix<Rows, Cols, Real>& m)
        : Eigen::internal::evaluator<Numbers>(Numbers(m.data())) {}
};
