// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/matrix/eigen_operand.hpp>

#include <concepts>
#include <type_traits>

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

// With an expression of Eigen's on the right these are Eigen's, lazy as ever; with one on the left
// Eigen's own members do.

template <int R, int C, class T, class D>
requires detail::EigenExpression<D>
auto operator+(const SmallMatrix<R, C, T>& a, const Eigen::MatrixBase<D>& b) {
    return a.eigen() + b.derived();
}
template <int R, int C, class T, class D>
requires detail::EigenExpression<D>
auto operator-(const SmallMatrix<R, C, T>& a, const Eigen::MatrixBase<D>& b) {
    return a.eigen() - b.derived();
}
template <int R, int C, class T, class D>
requires detail::EigenExpression<D>
auto operator*(const SmallMatrix<R, C, T>& a, const Eigen::MatrixBase<D>& b) {
    return a.eigen() * b.derived();
}
template <int R, int C, class T, class D>
auto operator*(const SmallMatrix<R, C, T>& a, const Eigen::DiagonalBase<D>& b) {
    return a.eigen() * b.derived();
}
template <int R, int C, class T, class D>
requires detail::EigenExpression<D>
bool operator==(const SmallMatrix<R, C, T>& a, const Eigen::MatrixBase<D>& b) {
    return a.eigen() == b.derived();
}

}  // namespace talus
