// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/types.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace talus {

/// What elimination finds of a small matrix.
template <int N>
struct Inverted {
    Matrix<N> inverse = Matrix<N>::Zero();  ///< zero where the determinant is
    double determinant = 0.0;
};

/// Gauss-Jordan elimination with row pivots.
template <int N>
Inverted<N> inverted(Matrix<N> m) {
    Inverted<N> result{Matrix<N>::Identity(), 1.0};
    Matrix<N>& inverse = result.inverse;
    for (int k = 0; k < N; ++k) {
        int pivot = k;
        for (int i = k + 1; i < N; ++i)
            if (std::abs(m(i, k)) > std::abs(m(pivot, k))) pivot = i;
        if (!(std::abs(m(pivot, k)) > 0.0)) return {};
        if (pivot != k) {
            result.determinant = -result.determinant;
            for (int j = 0; j < N; ++j) {
                std::swap(m(k, j), m(pivot, j));
                std::swap(inverse(k, j), inverse(pivot, j));
            }
        }
        const double divisor = m(k, k);
        result.determinant *= divisor;
        for (int j = 0; j < N; ++j) {
            m(k, j) /= divisor;
            inverse(k, j) /= divisor;
        }
        for (int i = 0; i < N; ++i) {
            const double factor = m(i, k);
            if (i == k || factor == 0.0) continue;
            for (int j = 0; j < N; ++j) {
                m(i, j) -= factor * m(k, j);
                inverse(i, j) -= factor * inverse(k, j);
            }
        }
    }
    return result;
}

/// exp(m) - 1, to rounding of its own size: exactly m where m m = 0, and zero where m is.
template <int N>
Matrix<N> exponential_less_one(Matrix<N> m) {
    constexpr double largest = 0.25;
    int halvings = 0;
    for (double size = m.norm(); size > largest && halvings < 60; size *= 0.5) ++halvings;
    m = std::ldexp(1.0, -halvings) * m;
    Matrix<N> sum = m, term = m;
    for (int k = 2; k <= 16; ++k) {
        term = Matrix<N>((1.0 / k) * (term * m));
        sum += term;
    }
    for (; halvings > 0; --halvings) sum = Matrix<N>(2.0 * sum + sum * sum);  // (1 + s)^2 - 1
    return sum;
}

}  // namespace talus
