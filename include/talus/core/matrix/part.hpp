// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/small_matrix.hpp>

#include <cassert>
#include <cmath>
#include <cstddef>
#include <type_traits>

namespace talus {

/// Part of a SmallMatrix that may change: the value that it had when it was asked for, and
/// assignments that reach the matrix. Component (i, j) is Inner i + Outer j places from the first.
/// What would change the value alone does not compile: parts of a part are constant.
template <int Rows, int Cols, class Real, int Inner, int Outer>
class MatrixPart : public SmallMatrix<Rows, Cols, Real> {
  public:
    using Value = SmallMatrix<Rows, Cols, Real>;
    using Index = std::ptrdiff_t;

    explicit MatrixPart(Real* first) : first_(first) {
        for (int j = 0; j < Cols; ++j)
            for (int i = 0; i < Rows; ++i)
                Value::data()[i + j * Rows] = first[Inner * i + Outer * j];
    }
    MatrixPart(const MatrixPart&) = default;
    ~MatrixPart() = default;

    // Of constant parts, since those that a matrix gives are: values, on which no more is to
    // change.
    const MatrixPart& operator=(const Value& x) const {
        for (int j = 0; j < Cols; ++j)
            for (int i = 0; i < Rows; ++i) first_[Inner * i + Outer * j] = x.data()[i + j * Rows];
        return *this;
    }
    // NOLINTNEXTLINE(misc-unconventional-assign-operator)
    const MatrixPart& operator=(const MatrixPart& x) const { return *this = x.now(); }
    const MatrixPart& operator+=(const Value& x) const { return *this = now() + x; }
    const MatrixPart& operator-=(const Value& x) const { return *this = now() - x; }
    const MatrixPart& operator*=(Real s) const { return *this = now() * s; }
    const MatrixPart& operator/=(Real s) const { return *this = now() / s; }
    const MatrixPart& setZero() const { return *this = Value::Zero(); }
    const MatrixPart& setOnes() const { return *this = Value::Ones(); }
    const MatrixPart& setConstant(Real x) const { return *this = Value::Constant(x); }
    const MatrixPart& setIdentity() const { return *this = Value::Identity(); }
    void fill(Real x) const { setConstant(x); }
    void normalize() const { *this = now().normalized(); }
    const MatrixPart& noalias() const { return *this; }
    template <int I, int O>
    void swap(const MatrixPart<Rows, Cols, Real, I, O>& o) const {
        const Value kept = now();
        *this = o.now();
        o = kept;
    }
    template <class X>
    RowFiller<const MatrixPart> operator<<(const X& x) const {
        return RowFiller<const MatrixPart>(*this, x);
    }

    Real& operator[](Index i) const requires(Value::is_vector) { return (*this)(i); }
    Real& operator()(Index i) const requires(Value::is_vector) {
        return Cols == 1 ? (*this)(i, 0) : (*this)(0, i);
    }
    Real& operator()(Index i, Index j) const {
        assert(i >= 0 && i < Rows && j >= 0 && j < Cols);
        return first_[Inner * i + Outer * j];
    }
    /// The value that it has now.
    Value now() const { return MatrixPart(first_); }

    const Real* data() const { return Value::data(); }
    template <int R, int C>
    auto block(Index i, Index j) const {
        return Value::template block<R, C>(i, j);
    }
    template <int N>
    auto segment(Index k) const {
        return Value::template segment<N>(k);
    }
    template <int N>
    auto head() const {
        return Value::template head<N>();
    }
    template <int N>
    auto tail() const {
        return Value::template tail<N>();
    }
    auto row(Index i) const { return Value::row(i); }
    auto col(Index j) const { return Value::col(j); }
    auto diagonal() const { return Value::diagonal(); }
    /// The components in the matrix, for Eigen: these may change.
    auto eigen() const {
        constexpr bool is_row = Rows == 1 && Cols != 1;
        using Strides = Eigen::Stride<is_row ? Cols * Outer : Outer, is_row ? Outer : Inner>;
        return Eigen::Map<typename Value::OfEigen, 0, Strides>(first_);
    }
    auto array() const { return eigen().array(); }

  private:
    Real* first_;
};

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
            m_(row_, column_ - 1) = static_cast<typename Matrix::Scalar>(x);
        } else {
            start(x.rows(), x.cols());
            const auto& values = x.eval();
            for (std::ptrdiff_t j = 0; j < values.cols(); ++j)
                for (std::ptrdiff_t i = 0; i < values.rows(); ++i)
                    m_(row_ + i, column_ - values.cols() + j) = values(i, j);
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

    Matrix& m_;
    std::ptrdiff_t row_ = 0, column_ = 0, height_ = 1;
};

}  // namespace talus
