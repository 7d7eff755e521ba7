// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/small_matrix.hpp>

#include <cassert>
#include <cmath>
#include <cstddef>
#include <type_traits>

namespace talus {

// Results are constant so that what would be lost does not compile.
// NOLINTBEGIN(readability-const-return-type,bugprone-branch-clone,bugprone-unhandled-self-assignment)

/// Part of a SmallMatrix: the value that it had when it was asked for, and, as long as it has no
/// name, a way to the matrix. `m.col(0) = v` and `m.diagonal() *= 2.0` change m; `auto v =
/// m.col(0);` is a value, which m has no more to do with and which nothing can be assigned to. (A
/// block of Eigen's with a name is a view.) Component (i, j) is Inner i + Outer j places from the
/// first.
template <int Rows, int Cols, class Real, int Inner, int Outer>
class MatrixPart : public SmallMatrix<Rows, Cols, Real> {
  public:
    using Value = SmallMatrix<Rows, Cols, Real>;
    using Index = std::ptrdiff_t;
    static constexpr int least = Rows < Cols ? Rows : Cols;
    template <int N>
    using Along = SmallMatrix<Cols == 1 ? N : 1, Cols == 1 ? 1 : N, Real>;
    template <int N>
    using PartAlong = MatrixPart<Cols == 1 ? N : 1, Cols == 1 ? 1 : N, Real, Inner, Outer>;

    explicit MatrixPart(Real* first) : first_(first) {
        for (int j = 0; j < Cols; ++j)
            for (int i = 0; i < Rows; ++i)
                Value::data()[i + j * Rows] = first[Inner * i + Outer * j];
    }
    MatrixPart(const MatrixPart&) = default;
    ~MatrixPart() = default;

    void operator=(const Value& x) const&& { put(x); }
    // NOLINTNEXTLINE(misc-unconventional-assign-operator)
    void operator=(const MatrixPart& x) const&& { put(x); }
    void operator+=(const Value& x) const&& { put(now() + x); }
    void operator-=(const Value& x) const&& { put(now() - x); }
    void operator*=(Real s) const&& { put(now() * s); }
    void operator/=(Real s) const&& { put(now() / s); }
    void setZero() const&& { put(Value::Zero()); }
    void setOnes() const&& { put(Value::Ones()); }
    void setConstant(Real x) const&& { put(Value::Constant(x)); }
    void setIdentity() const&& { put(Value::Identity()); }
    void fill(Real x) const&& { put(Value::Constant(x)); }
    void normalize() const&& { put(now().normalized()); }
    const MatrixPart&& noalias() const&& { return unnamed(); }
    template <int I, int O>
    void swap(const MatrixPart<Rows, Cols, Real, I, O>&& o) const&& {
        const Value kept = now();
        put(o.now());
        static_cast<const MatrixPart<Rows, Cols, Real, I, O>&&>(o) = kept;
    }
    template <class X>
    RowFiller<const MatrixPart> operator<<(const X& x) const&& {
        return RowFiller<const MatrixPart>(*this, x);
    }

    const Real& operator[](Index i) const& requires(Value::is_vector) {
        return Value::operator[](i);
    }
    const Real& operator()(Index i) const& requires(Value::is_vector) {
        return Value::operator()(i);
    }
    const Real& operator()(Index i, Index j) const& { return Value::operator()(i, j); }
    Real& operator[](Index i) const&& requires(Value::is_vector) { return at(i); }
    Real& operator()(Index i) const&& requires(Value::is_vector) { return at(i); }
    Real& operator()(Index i, Index j) const&& { return at(i, j); }
    /// What the matrix has there now.
    Value now() const { return MatrixPart(first_); }

    const Real* data() const { return Value::data(); }
    template <int R, int C>
    const SmallMatrix<R, C, Real> block(Index i, Index j) const& {
        return Value::template block<R, C>(i, j);
    }
    template <int R, int C>
    const MatrixPart<R, C, Real, Inner, Outer> block(Index i, Index j) const&& {
        assert(i >= 0 && i + R <= Rows && j >= 0 && j + C <= Cols);
        return MatrixPart<R, C, Real, Inner, Outer>(first_ + Inner * i + Outer * j);
    }
    template <int N>
    const Along<N> segment(Index k) const& {
        return Value::template segment<N>(k);
    }
    template <int N>
    const PartAlong<N> segment(Index k) const&& {
        assert(k >= 0 && k + N <= Value::Size);
        return PartAlong<N>(first_ + k * (Cols == 1 ? Inner : Outer));
    }
    template <int N>
    const Along<N> head() const& {
        return Value::template head<N>();
    }
    template <int N>
    const PartAlong<N> head() const&& {
        return PartAlong<N>(first_);
    }
    template <int N>
    const Along<N> tail() const& {
        return Value::template tail<N>();
    }
    template <int N>
    const PartAlong<N> tail() const&& {
        return PartAlong<N>(first_ + (Value::Size - N) * (Cols == 1 ? Inner : Outer));
    }
    const SmallMatrix<1, Cols, Real> row(Index i) const& { return Value::row(i); }
    const MatrixPart<1, Cols, Real, Inner, Outer> row(Index i) const&& {
        return MatrixPart<1, Cols, Real, Inner, Outer>(first_ + Inner * i);
    }
    const SmallMatrix<Rows, 1, Real> col(Index j) const& { return Value::col(j); }
    const MatrixPart<Rows, 1, Real, Inner, Outer> col(Index j) const&& {
        return MatrixPart<Rows, 1, Real, Inner, Outer>(first_ + Outer * j);
    }
    const SmallMatrix<least, 1, Real> diagonal() const& { return Value::diagonal(); }
    const MatrixPart<least, 1, Real, Inner + Outer, 0> diagonal() const&& {
        return MatrixPart<least, 1, Real, Inner + Outer, 0>(first_);
    }
    template <int N>
    decltype(auto) topRows() const& {
        return this->template block<N, Cols>(0, 0);
    }
    template <int N>
    decltype(auto) topRows() const&& {
        return unnamed().template block<N, Cols>(0, 0);
    }
    template <int N>
    decltype(auto) bottomRows() const& {
        return this->template block<N, Cols>(Rows - N, 0);
    }
    template <int N>
    decltype(auto) bottomRows() const&& {
        return unnamed().template block<N, Cols>(Rows - N, 0);
    }
    template <int N>
    decltype(auto) middleRows(Index i) const& {
        return this->template block<N, Cols>(i, 0);
    }
    template <int N>
    decltype(auto) middleRows(Index i) const&& {
        return unnamed().template block<N, Cols>(i, 0);
    }
    template <int N>
    decltype(auto) leftCols() const& {
        return this->template block<Rows, N>(0, 0);
    }
    template <int N>
    decltype(auto) leftCols() const&& {
        return unnamed().template block<Rows, N>(0, 0);
    }
    template <int N>
    decltype(auto) rightCols() const& {
        return this->template block<Rows, N>(0, Cols - N);
    }
    template <int N>
    decltype(auto) rightCols() const&& {
        return unnamed().template block<Rows, N>(0, Cols - N);
    }
    template <int N>
    decltype(auto) middleCols(Index j) const& {
        return this->template block<Rows, N>(0, j);
    }
    template <int N>
    decltype(auto) middleCols(Index j) const&& {
        return unnamed().template block<Rows, N>(0, j);
    }
    template <int R, int C>
    decltype(auto) topLeftCorner() const& {
        return this->template block<R, C>(0, 0);
    }
    template <int R, int C>
    decltype(auto) topLeftCorner() const&& {
        return unnamed().template block<R, C>(0, 0);
    }
    template <int R, int C>
    decltype(auto) topRightCorner() const& {
        return this->template block<R, C>(0, Cols - C);
    }
    template <int R, int C>
    decltype(auto) topRightCorner() const&& {
        return unnamed().template block<R, C>(0, Cols - C);
    }
    template <int R, int C>
    decltype(auto) bottomLeftCorner() const& {
        return this->template block<R, C>(Rows - R, 0);
    }
    template <int R, int C>
    decltype(auto) bottomLeftCorner() const&& {
        return unnamed().template block<R, C>(Rows - R, 0);
    }
    template <int R, int C>
    decltype(auto) bottomRightCorner() const& {
        return this->template block<R, C>(Rows - R, Cols - C);
    }
    template <int R, int C>
    decltype(auto) bottomRightCorner() const&& {
        return unnamed().template block<R, C>(Rows - R, Cols - C);
    }
    void set_column(Index j, const SmallMatrix<Rows, 1, Real>& x) const&& { unnamed().col(j) = x; }
    const Real& x() const& { return Value::x(); }
    const Real& y() const& { return Value::y(); }
    const Real& z() const& { return Value::z(); }
    const Real& w() const& { return Value::w(); }
    Real& x() const&& { return at(0); }
    Real& y() const&& { return at(1); }
    Real& z() const&& { return at(2); }
    Real& w() const&& { return at(3); }
    const Real& coeff(Index i) const { return Value::coeff(i); }
    const Real& coeff(Index i, Index j) const { return Value::coeff(i, j); }
    Real& coeffRef(Index i) const&& { return at(i); }
    Real& coeffRef(Index i, Index j) const&& { return at(i, j); }
    const Real* begin() const requires(Value::is_vector) { return Value::begin(); }
    const Real* end() const requires(Value::is_vector) { return Value::end(); }
    /// What Eigen would change behind a Ref would be the value alone: refused.
    template <class T, int O, class S>
    requires(!std::is_const_v<T>) operator Eigen::Ref<T, O, S>() const = delete;
    /// For Eigen: the components in the matrix, which may change; of a part with a name its own.
    auto eigen() const& { return Value::eigen(); }
    auto eigen() const&& {
        constexpr bool is_row = Rows == 1 && Cols != 1;
        using Strides = Eigen::Stride<is_row ? Cols * Outer : Outer, is_row ? Outer : Inner>;
        return Eigen::Map<typename Value::OfEigen, 0, Strides>(first_);
    }
    auto array() const& { return Value::eigen().array(); }
    auto array() const&& { return unnamed().eigen().array(); }

  private:
    const MatrixPart&& unnamed() const { return static_cast<const MatrixPart&&>(*this); }
    void put(const Value& x) const {
        for (int j = 0; j < Cols; ++j)
            for (int i = 0; i < Rows; ++i) at(i, j) = x.data()[i + j * Rows];
    }
    Real& at(Index i) const { return Cols == 1 ? at(i, 0) : at(0, i); }
    Real& at(Index i, Index j) const {
        assert(i >= 0 && i < Rows && j >= 0 && j < Cols);
        return first_[Inner * i + Outer * j];
    }

    Real* first_;
};

// NOLINTEND(readability-const-return-type,bugprone-branch-clone,bugprone-unhandled-self-assignment)

/// What follows `m <<`: fills a matrix row by row, with numbers and with matrices side by side.
template <class Matrix>
class RowFiller {
  public:
    template <class X>
    RowFiller(Matrix& m, const X& x) : m_(m) {
        put(x);
    }
    template <class X>
    RowFiller& operator,(const X& x) {
        put(x);
        return *this;
    }
    Matrix& finished() {
        assert(row_ + height_ == m_.rows() && column_ == m_.cols());
        return m_;
    }

  private:
    template <class X>
    void put(const X& x) {
        if constexpr (std::is_convertible_v<X, typename Matrix::Scalar>) {
            start(1, 1);
            entry(row_, column_ - 1) = static_cast<typename Matrix::Scalar>(x);
        } else {
            start(x.rows(), x.cols());
            const auto& values = x.eval();
            for (std::ptrdiff_t j = 0; j < values.cols(); ++j)
                for (std::ptrdiff_t i = 0; i < values.rows(); ++i)
                    entry(row_ + i, column_ - values.cols() + j) = values(i, j);
        }
    }
    /// Room for so many rows and columns, the last of which is before `column_`.
    void start(std::ptrdiff_t rows, std::ptrdiff_t columns) {
        if (column_ == m_.cols()) {
            row_ += height_;
            column_ = 0;
        }
        height_ = rows;
        column_ += columns;
        assert(row_ + height_ <= m_.rows() && column_ <= m_.cols());
    }

    /// A part is one without a name, as it was where it was filled.
    typename Matrix::Scalar& entry(std::ptrdiff_t i, std::ptrdiff_t j) const {
        return static_cast<Matrix&&>(m_)(i, j);
    }

    Matrix& m_;
    std::ptrdiff_t row_ = 0, column_ = 0, height_ = 1;
};

}  // namespace talus
