// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/matrix/arithmetic.hpp>
#include <talus/core/matrix/eigen_operand.hpp>
#include <talus/core/matrix/parts_of_matrix.hpp>

#include <cassert>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <initializer_list>

namespace talus {

template <class Matrix>
class RowFiller;

/// A matrix of a few components, by columns, whose arithmetic is eager: a + b is a matrix, not an
/// expression, so `auto c = a + b;` is safe. Zero unless told otherwise: in `Twist{v, {}}` and
/// `Pose{x, {}}` empty braces mean what they seem to mean.
///
/// To programs that include Eigen it is one of Eigen's matrices in all but name: it is made of
/// Eigen's expressions, is an operand of them and of assignments to Eigen's matrices, and has the
/// members of those that are of use for a few components. `eigen()` gives the rest, on the same
/// numbers. Members that need Eigen name a template of Eigen's that is not complete without it. It
/// is not derived of one of Eigen's, since each of those has some two hundred members, and so has
/// every expression: they were most of what a compiler instantiated for a program of talus.
template <int Rows, int Cols, class Real = double>
class SmallMatrix : public Eigen::MatrixBase<SmallMatrix<Rows, Cols, Real>>,
                    public PartsOfMatrix<Rows, Cols, Real> {
  public:
    using Index = std::ptrdiff_t;
    using Transposed = SmallMatrix<Cols, Rows, Real>;
    using OfEigen = detail::EigenMatrix<Rows, Cols, Real>;
    static constexpr std::size_t alignment = detail::matrix_alignment<Rows, Cols, Real>;
    static constexpr int Size = Rows * Cols;
    static constexpr bool is_vector = Rows == 1 || Cols == 1;

    SmallMatrix() noexcept {
        each([&](int i) { at(i) = Real(0); });
    }
    explicit SmallMatrix(Real x) requires(Size == 1) : data_{x} {}
    SmallMatrix(Real x, Real y) requires(is_vector&& Size == 2) : data_{x, y} {}
    SmallMatrix(Real x, Real y, Real z) requires(is_vector&& Size == 3) : data_{x, y, z} {}
    SmallMatrix(Real x, Real y, Real z, Real w) requires(is_vector&& Size == 4)
        : data_{x, y, z, w} {}
    template <class... S>
    requires(is_vector&& Size > 4 && sizeof...(S) == Size - 1) SmallMatrix(Real x, S... more)
        : data_{x, static_cast<Real>(more)...} {}
    /// Row by row, or the one row or column that a vector is.
    SmallMatrix(std::initializer_list<std::initializer_list<Real>> rows) {
        each([&](int i) { at(i) = Real(0); });
        Index i = 0;
        for (const auto& row : rows) {
            Index j = 0;
            for (const Real& x : row) is_vector ? (*this)(i + j++) = x : (*this)(i, j++) = x;
            ++i;
        }
    }
    template <std::same_as<Real> T>
    explicit SmallMatrix(const T* numbers) {
        each([&](int i) { at(i) = numbers[i]; });
    }
    /// A row of a column, and a column of a row.
    template <int R, int C>
    requires(is_vector&& R == Cols && C == Rows && R != C)
        SmallMatrix(const SmallMatrix<R, C, Real>& x) {
        each([&](int i) { at(i) = x.data()[i]; });
    }
    /// Any expression of Eigen's, evaluated.
    template <class D>
    requires detail::FitsInto<D, Rows, Cols> SmallMatrix(const Eigen::EigenBase<D>& other) {
        eigen() = other.derived();
    }

    static SmallMatrix Zero() { return Constant(Real(0)); }
    static SmallMatrix Ones() { return Constant(Real(1)); }
    static SmallMatrix Constant(Real x) {
        SmallMatrix r;
        each([&](int i) { r.at(i) = x; });
        return r;
    }
    /// As Eigen's functions ask for it.
    static auto Constant(Index rows, Index cols, Real x) {
        return OfEigen::Constant(rows, cols, x);
    }
    static SmallMatrix Unit(Index k) requires(is_vector) {
        SmallMatrix r = Zero();
        r.data_[k] = Real(1);
        return r;
    }
    static SmallMatrix UnitX() { return Unit(0); }
    static SmallMatrix UnitY() { return Unit(1); }
    static SmallMatrix UnitZ() { return Unit(2); }
    static SmallMatrix Identity() {
        SmallMatrix r = Zero();
        for (int i = 0; i < Rows && i < Cols; ++i) r.at(i * (Rows + 1)) = Real(1);
        return r;
    }
    static SmallMatrix Random() { return SmallMatrix(OfEigen::Random()); }

    Real* data() { return data_; }
    const Real* data() const { return data_; }
    Real* begin() requires(is_vector) { return data_; }
    const Real* begin() const requires(is_vector) { return data_; }
    Real* end() requires(is_vector) { return data_ + Size; }
    const Real* end() const requires(is_vector) { return data_ + Size; }
    [[gnu::always_inline]] Real& operator[](Index i) requires(is_vector) { return (*this)(i); }
    [[gnu::always_inline]] const Real& operator[](Index i) const requires(is_vector) {
        return (*this)(i);
    }
    [[gnu::always_inline]] Real& operator()(Index i) {
        assert(i >= 0 && i < Size);
        return data_[i];
    }
    [[gnu::always_inline]] const Real& operator()(Index i) const {
        assert(i >= 0 && i < Size);
        return data_[i];
    }
    [[gnu::always_inline]] Real& operator()(Index i, Index j) {
        assert(i >= 0 && i < Rows && j >= 0 && j < Cols);
        return data_[i + j * Rows];
    }
    [[gnu::always_inline]] const Real& operator()(Index i, Index j) const {
        assert(i >= 0 && i < Rows && j >= 0 && j < Cols);
        return data_[i + j * Rows];
    }
    Real& x() { return (*this)(0); }
    Real& y() { return (*this)(1); }
    Real& z() { return (*this)(2); }
    Real& w() { return (*this)(3); }
    const Real& x() const { return (*this)(0); }
    const Real& y() const { return (*this)(1); }
    const Real& z() const { return (*this)(2); }
    const Real& w() const { return (*this)(3); }
    // The same by names that Eigen's functions use.
    Real& coeffRef(Index i) { return data_[i]; }
    Real& coeffRef(Index i, Index j) { return data_[i + j * Rows]; }
    const Real& coeff(Index i) const { return data_[i]; }
    const Real& coeff(Index i, Index j) const { return data_[i + j * Rows]; }

    SmallMatrix eval() const { return *this; }
    SmallMatrix& noalias() { return *this; }
    template <class T>
    SmallMatrix<Rows, Cols, T> cast() const {
        SmallMatrix<Rows, Cols, T> r;
        each([&](int i) { r.data()[i] = static_cast<T>(at(i)); });
        return r;
    }
    SmallMatrix& setZero() { return *this = Zero(); }
    SmallMatrix& setOnes() { return *this = Ones(); }
    SmallMatrix& setConstant(Real x) { return *this = Constant(x); }
    SmallMatrix& setIdentity() { return *this = Identity(); }
    void fill(Real x) { setConstant(x); }
    void swap(SmallMatrix& o) {
        const SmallMatrix kept = *this;
        *this = o;
        o = kept;
    }
    /// m << a, b, c, d; row by row, of numbers and matrices.
    template <class X>
    RowFiller<SmallMatrix> operator<<(const X& x) {
        return RowFiller<SmallMatrix>(*this, x);
    }

    SmallMatrix& operator+=(const SmallMatrix& o) {
        each([&](int i) { at(i) += o.at(i); });
        return *this;
    }
    SmallMatrix& operator-=(const SmallMatrix& o) {
        each([&](int i) { at(i) -= o.at(i); });
        return *this;
    }
    SmallMatrix& operator*=(Real s) {
        each([&](int i) { at(i) *= s; });
        return *this;
    }
    SmallMatrix& operator*=(const SmallMatrix<Cols, Cols, Real>& o) { return *this = *this * o; }
    SmallMatrix& operator/=(Real s) {
        each([&](int i) { at(i) /= s; });
        return *this;
    }

    Real dot(const SmallMatrix& o) const requires(is_vector) {
        return detail::sum_over<Size>([&](int i) { return at(i) * o.at(i); });
    }
    Real squaredNorm() const {
        return detail::sum_over<Size>([&](int i) { return at(i) * at(i); });
    }
    Real norm() const { return std::sqrt(squaredNorm()); }
    Real sum() const {
        return detail::sum_over<Size>([&](int i) { return at(i); });
    }
    Real mean() const { return sum() / Real(Size); }
    Real prod() const {
        Real product = at(0);
        for (int i = 1; i < Size; ++i) product *= at(i);
        return product;
    }
    Real trace() const requires(Rows == Cols) {
        return detail::sum_over<Rows>([&](int i) { return at(i * (Rows + 1)); });
    }
    Real determinant() const requires(Rows == Cols) {
        const SmallMatrix& m = *this;
        const auto minor = [&](int a, int b, int c) {
            return m(0, a) * (m(1, b) * m(2, c) - m(1, c) * m(2, b));
        };
        if constexpr (Rows == 1)
            return at(0);
        else if constexpr (Rows == 2)
            return m(0, 0) * m(1, 1) - m(1, 0) * m(0, 1);
        else if constexpr (Rows == 3)
            return minor(0, 1, 2) - minor(1, 0, 2) + minor(2, 0, 1);
        else
            return eigen().determinant();
    }
    /// Of length 1, or itself if it is zero; for components between 1e-150 and 1e150, whose squares
    /// are numbers.
    SmallMatrix normalized() const {
        const Real square = squaredNorm();
        return square > Real(0) ? *this / std::sqrt(square) : *this;
    }
    void normalize() { *this = normalized(); }
    SmallMatrix cross(const SmallMatrix& o) const requires(is_vector&& Size == 3) {
        return {at(1) * o.at(2) - at(2) * o.at(1), at(2) * o.at(0) - at(0) * o.at(2),
                at(0) * o.at(1) - at(1) * o.at(0)};
    }
    // Const, so that m.transpose() = x, which would be lost, does not compile.
    // NOLINTNEXTLINE(readability-const-return-type)
    const Transposed transpose() const {
        Transposed r;
        for (int i = 0; i < Rows; ++i)
            for (int j = 0; j < Cols; ++j) r.data()[j + i * Cols] = at(i + j * Rows);
        return r;
    }
    // NOLINTNEXTLINE(readability-const-return-type)
    const Transposed adjoint() const { return transpose(); }

    /// Column k, by value.
    SmallMatrix<Rows, 1, Real> column(Index k) const {
        SmallMatrix<Rows, 1, Real> r;
        for (int i = 0; i < Rows; ++i) r.data()[i] = data_[i + k * Rows];
        return r;
    }
    void set_column(Index k, const SmallMatrix<Rows, 1, Real>& x) {
        for (int i = 0; i < Rows; ++i) data_[i + k * Rows] = x.data()[i];
    }

    SmallMatrix cwiseProduct(const SmallMatrix& o) const {
        SmallMatrix r;
        each([&](int i) { r.at(i) = at(i) * o.at(i); });
        return r;
    }
    SmallMatrix cwiseQuotient(const SmallMatrix& o) const {
        SmallMatrix r;
        each([&](int i) { r.at(i) = at(i) / o.at(i); });
        return r;
    }
    SmallMatrix cwiseMin(const SmallMatrix& o) const {
        SmallMatrix r;
        each([&](int i) { r.at(i) = o.at(i) < at(i) ? o.at(i) : at(i); });
        return r;
    }
    SmallMatrix cwiseMax(const SmallMatrix& o) const {
        SmallMatrix r;
        each([&](int i) { r.at(i) = at(i) < o.at(i) ? o.at(i) : at(i); });
        return r;
    }
    SmallMatrix cwiseMin(Real x) const { return cwiseMin(Constant(x)); }
    SmallMatrix cwiseMax(Real x) const { return cwiseMax(Constant(x)); }
    SmallMatrix cwiseAbs() const {
        SmallMatrix r;
        each([&](int i) { r.at(i) = std::abs(at(i)); });
        return r;
    }
    SmallMatrix cwiseAbs2() const { return cwiseProduct(*this); }
    SmallMatrix cwiseSqrt() const {
        SmallMatrix r;
        each([&](int i) { r.at(i) = std::sqrt(at(i)); });
        return r;
    }
    SmallMatrix cwiseInverse() const {
        SmallMatrix r;
        each([&](int i) { r.at(i) = Real(1) / at(i); });
        return r;
    }

    Real minCoeff() const {
        Real least = at(0);
        for (int i = 1; i < Rows * Cols; ++i) least = at(i) < least ? at(i) : least;
        return least;
    }
    Real maxCoeff() const {
        Real most = at(0);
        for (int i = 1; i < Rows * Cols; ++i) most = most < at(i) ? at(i) : most;
        return most;
    }
    /// The same, with where: at the first of several.
    template <std::integral I>
    Real minCoeff(I* where) const requires(is_vector) {
        *where = 0;
        for (int i = 1; i < Size; ++i)
            if (at(i) < (*this)(*where)) *where = i;
        return (*this)(*where);
    }
    template <std::integral I>
    Real maxCoeff(I* where) const requires(is_vector) {
        *where = 0;
        for (int i = 1; i < Size; ++i)
            if ((*this)(*where) < at(i)) *where = i;
        return (*this)(*where);
    }
    /// Whether all components are numbers, and finite.
    bool allFinite() const {
        bool finite = true;
        each([&](int i) { finite = finite && std::isfinite(at(i)); });
        return finite;
    }
    bool hasNaN() const {
        bool found = false;
        each([&](int i) { found = found || std::isnan(at(i)); });
        return found;
    }
    /// Whether all components are zero exactly.
    bool is_zero() const {
        bool zero = true;
        each([&](int i) { zero = zero && at(i) == Real(0); });
        return zero;
    }
    bool isZero(Real most = Real(1e-12)) const {
        bool zero = true;
        each([&](int i) { zero = zero && std::abs(at(i)) <= most; });
        return zero;
    }
    /// Whether they differ by less than `part` of the smaller.
    bool isApprox(const SmallMatrix& o, Real part = Real(1e-12)) const {
        const Real a = squaredNorm(), b = o.squaredNorm();
        return (*this - o).squaredNorm() <= part * part * (b < a ? b : a);
    }
    /// Some vector of length 1 at a right angle.
    SmallMatrix unitOrthogonal() const requires(is_vector && (Size == 2 || Size == 3)) {
        if constexpr (Size == 2) {
            return SmallMatrix(-at(1), at(0)).normalized();
        } else {
            // (-y, x, 0), unless x and y are nothing beside z.
            const Real nothing = Real(1e-12) * std::abs(at(2));
            if (std::abs(at(0)) > nothing || std::abs(at(1)) > nothing) {
                const Real f = Real(1) / std::sqrt(at(0) * at(0) + at(1) * at(1));
                return {-at(1) * f, at(0) * f, Real(0)};
            }
            const Real f = Real(1) / std::sqrt(at(1) * at(1) + at(2) * at(2));
            return {Real(0), -at(2) * f, at(1) * f};
        }
    }

    /// The same numbers as a matrix of Eigen's: for what follows, which is Eigen's own, and more.
    auto eigen() { return detail::EigenMap<OfEigen, alignment>(data_); }
    auto eigen() const { return detail::EigenMap<const OfEigen, alignment>(data_); }

  private:
    template <int, int, class>
    friend class SmallMatrix;

    template <class F>
    static constexpr void each(const F& f) {
        detail::for_each_index<Size>(f);
    }
    Real& at(int i) { return data_[i]; }
    const Real& at(int i) const { return data_[i]; }

    alignas(alignment) Real data_[Size];
};

}  // namespace talus

#include <talus/core/matrix/part.hpp>
