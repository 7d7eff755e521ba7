// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>

#include <cmath>
#include <concepts>
#include <type_traits>

namespace talus {

template <int Rows, int Cols, class Real>
class SmallMatrix;

}  // namespace talus

/// So that Eigen::Map and Eigen::Ref take a SmallMatrix for the Eigen matrix that it is.
template <int Rows, int Cols, class Real>
struct Eigen::internal::traits<talus::SmallMatrix<Rows, Cols, Real>>
    : Eigen::internal::traits<Eigen::Matrix<Real, Rows, Cols>> {};
template <int Rows, int Cols, class Real>
struct Eigen::internal::evaluator<talus::SmallMatrix<Rows, Cols, Real>>
    : Eigen::internal::evaluator<Eigen::Matrix<Real, Rows, Cols>> {
    using Eigen::internal::evaluator<Eigen::Matrix<Real, Rows, Cols>>::evaluator;
};

namespace talus {

namespace detail {

/// Calls f(0) ... f(N - 1). The first three calls are written out, so that the components of small
/// vectors live in registers at every level of optimisation.
template <int N, class F>
[[gnu::always_inline]] inline constexpr void for_each_index(const F& f) {
    f(0);
    if constexpr (N > 1) f(1);
    if constexpr (N > 2) f(2);
    for (int i = 3; i < N; ++i) f(i);
}

/// f(0) + ... + f(N - 1), added from the left.
template <int N, class F>
[[gnu::always_inline]] inline constexpr auto sum_over(const F& f) {
    auto sum = f(0);
    if constexpr (N > 1) sum += f(1);
    if constexpr (N > 2) sum += f(2);
    for (int i = 3; i < N; ++i) sum += f(i);
    return sum;
}

/// A factor that a matrix of T takes: a fraction of whole numbers is not one.
template <class S, class T>
concept ScalarFor = std::floating_point<T> && std::is_arithmetic_v<S>;

}  // namespace detail

#ifdef EIGEN_DEFAULT_TO_ROW_MAJOR
#error "talus needs Eigen's usual order of storage, by columns: EIGEN_DEFAULT_TO_ROW_MAJOR is set"
#endif

/// An Eigen matrix of a few components whose own arithmetic is eager: a + b is a matrix, not an
/// expression. Eigen gives every expression a type with some two hundred members; for three
/// components they save nothing, and they were most of what a compiler instantiated for a program
/// of talus. A value also outlives its operands, so `auto c = a + b;` is safe.
///
/// It remains an Eigen matrix: it takes and gives Eigen's expressions, and what is not declared
/// here (blocks, decompositions, arrays, comma initialisation) is Eigen's own, lazy as ever: a
/// block of a result refers to a value that is gone, so `auto h = (a + b).head<2>();` needs an
/// `.eval()` where Eigen's expression would not. Unlike Eigen's it is zero unless told otherwise:
/// in `Twist{v, {}}` and `Pose{x, {}}` empty braces mean what they seem to mean.
template <int Rows, int Cols, class Real = double>
class SmallMatrix : public Eigen::Matrix<Real, Rows, Cols> {
  public:
    using Base = Eigen::Matrix<Real, Rows, Cols>;
    using Transposed = SmallMatrix<Cols, Rows, Real>;
    using Base::Base;
    SmallMatrix() {
        each([&](int i) { at(i) = Real(0); });
    }
    SmallMatrix(const Base& other) : Base(other) {}
    /// Any expression of Eigen's, evaluated.
    template <class Derived>
    SmallMatrix& operator=(const Eigen::MatrixBase<Derived>& other) {
        Base::operator=(other);
        return *this;
    }

    SmallMatrix eval() const { return *this; }

    static SmallMatrix Zero() { return Constant(Real(0)); }
    static SmallMatrix Ones() { return Constant(Real(1)); }
    static SmallMatrix Constant(Real x) {
        SmallMatrix r;
        each([&](int i) { r.at(i) = x; });
        return r;
    }
    static SmallMatrix Unit(Eigen::Index k) requires(Cols == 1) {
        SmallMatrix r = Zero();
        r.data()[k] = Real(1);
        return r;
    }
    static SmallMatrix Identity() requires(Rows == Cols) {
        SmallMatrix r = Zero();
        for (int i = 0; i < Rows; ++i) r.at(i * (Rows + 1)) = Real(1);
        return r;
    }

    SmallMatrix& setZero() { return *this = Zero(); }
    SmallMatrix& setConstant(Real x) { return *this = Constant(x); }

    using Base::operator+=;
    using Base::operator-=;
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
    SmallMatrix& operator/=(Real s) {
        each([&](int i) { at(i) /= s; });
        return *this;
    }

    using Base::dot;
    Real dot(const SmallMatrix& o) const requires(Cols == 1) {
        return detail::sum_over<Rows * Cols>([&](int i) { return at(i) * o.at(i); });
    }
    Real squaredNorm() const {
        return detail::sum_over<Rows * Cols>([&](int i) { return at(i) * at(i); });
    }
    Real norm() const { return std::sqrt(squaredNorm()); }
    Real sum() const {
        return detail::sum_over<Rows * Cols>([&](int i) { return at(i); });
    }
    Real trace() const requires(Rows == Cols) {
        return detail::sum_over<Rows>([&](int i) { return at(i * (Rows + 1)); });
    }
    /// Of length 1, or itself if it is zero; for components between 1e-150 and 1e150, whose squares
    /// are numbers.
    SmallMatrix normalized() const {
        const Real square = squaredNorm();
        return square > Real(0) ? *this / std::sqrt(square) : *this;
    }
    void normalize() { *this = normalized(); }
    using Base::cross;
    SmallMatrix cross(const SmallMatrix& o) const requires(Rows == 3 && Cols == 1) {
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

    /// Column k, by value.
    SmallMatrix<Rows, 1, Real> column(Eigen::Index k) const {
        SmallMatrix<Rows, 1, Real> r;
        for (int i = 0; i < Rows; ++i) r.data()[i] = this->data()[i + k * Rows];
        return r;
    }
    void set_column(Eigen::Index k, const SmallMatrix<Rows, 1, Real>& x) {
        for (int i = 0; i < Rows; ++i) this->data()[i + k * Rows] = x.data()[i];
    }

    using Base::cwiseMax;
    using Base::cwiseMin;
    using Base::cwiseProduct;
    using Base::cwiseQuotient;
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
    SmallMatrix cwiseAbs() const {
        SmallMatrix r;
        each([&](int i) { r.at(i) = std::abs(at(i)); });
        return r;
    }
    SmallMatrix cwiseInverse() const {
        SmallMatrix r;
        each([&](int i) { r.at(i) = Real(1) / at(i); });
        return r;
    }

    using Base::maxCoeff;
    using Base::minCoeff;
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
    using Base::isZero;
    /// Whether all components are zero exactly.
    bool is_zero() const {
        bool zero = true;
        each([&](int i) { zero = zero && at(i) == Real(0); });
        return zero;
    }

  private:
    template <int, int, class>
    friend class SmallMatrix;

    template <class F>
    static constexpr void each(const F& f) {
        detail::for_each_index<Rows * Cols>(f);
    }
    Real& at(int i) { return this->data()[i]; }
    const Real& at(int i) const { return this->data()[i]; }
};

template <int R, int C, class T>
SmallMatrix<R, C, T> operator+(const SmallMatrix<R, C, T>& a, const SmallMatrix<R, C, T>& b) {
    SmallMatrix<R, C, T> r;
    detail::for_each_index<R * C>([&](int i) { r.data()[i] = a.data()[i] + b.data()[i]; });
    return r;
}
template <int R, int C, class T>
SmallMatrix<R, C, T> operator-(const SmallMatrix<R, C, T>& a, const SmallMatrix<R, C, T>& b) {
    SmallMatrix<R, C, T> r;
    detail::for_each_index<R * C>([&](int i) { r.data()[i] = a.data()[i] - b.data()[i]; });
    return r;
}
template <int R, int C, class T>
SmallMatrix<R, C, T> operator-(const SmallMatrix<R, C, T>& a) {
    SmallMatrix<R, C, T> r;
    detail::for_each_index<R * C>([&](int i) { r.data()[i] = -a.data()[i]; });
    return r;
}
template <class S, int R, int C, class T>
requires detail::ScalarFor<S, T> SmallMatrix<R, C, T>
operator*(S s, const SmallMatrix<R, C, T>& a) {
    SmallMatrix<R, C, T> r;
    detail::for_each_index<R * C>([&](int i) { r.data()[i] = static_cast<T>(s) * a.data()[i]; });
    return r;
}
template <class S, int R, int C, class T>
requires detail::ScalarFor<S, T> SmallMatrix<R, C, T>
operator*(const SmallMatrix<R, C, T>& a, S s) { return s * a; }
template <class S, int R, int C, class T>
requires detail::ScalarFor<S, T> SmallMatrix<R, C, T>
operator/(const SmallMatrix<R, C, T>& a, S s) {
    SmallMatrix<R, C, T> r;
    detail::for_each_index<R * C>([&](int i) { r.data()[i] = a.data()[i] / static_cast<T>(s); });
    return r;
}
/// Column by column, each a sum of columns of a: the compiler then packs neighbours in memory.
template <int R, int K, int C, class T>
SmallMatrix<R, C, T> operator*(const SmallMatrix<R, K, T>& a, const SmallMatrix<K, C, T>& b) {
    SmallMatrix<R, C, T> r;
    for (int j = 0; j < C; ++j) {
        T* column = r.data() + j * R;
        const T* factors = b.data() + j * K;
        detail::for_each_index<R>([&](int i) { column[i] = a.data()[i] * factors[0]; });
        for (int k = 1; k < K; ++k)
            detail::for_each_index<R>(
                [&](int i) { column[i] += a.data()[i + k * R] * factors[k]; });
    }
    return r;
}
template <int R, int C, class T>
bool operator==(const SmallMatrix<R, C, T>& a, const SmallMatrix<R, C, T>& b) {
    bool equal = true;
    detail::for_each_index<R * C>([&](int i) { equal = equal && a.data()[i] == b.data()[i]; });
    return equal;
}

}  // namespace talus
