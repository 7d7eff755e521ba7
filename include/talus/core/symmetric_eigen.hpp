// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/small_matrix.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace talus {

/// Eigenvalues, ascending, and eigenvectors of a small symmetric matrix, of which the lower
/// triangle is read. Finite for finite input. Jacobi's method: turn by turn in the plane of two
/// axes, each turn making one off-diagonal component zero [GolubVanLoan2013, section 8.5]. A matrix
/// that is diagonal is left as it is. It converges quadratically: two or three rounds for N = 3,
/// one turn for N = 2.
template <int N>
struct SymmetricEigen {
    SmallMatrix<N, 1> values;
    SmallMatrix<N, N> vectors = SmallMatrix<N, N>::Identity();  ///< in columns, of length 1

    explicit SymmetricEigen(const SmallMatrix<N, N>& m) {
        // Scaled, so that no square or quotient below overflows.
        double scale = 0.0;
        for (int i = 0; i < N; ++i)
            for (int j = 0; j <= i; ++j) scale = std::max(scale, std::abs(m(i, j)));
        if (!(scale > 0.0)) scale = 1.0;
        SmallMatrix<N, N> a = m / scale;
        constexpr int enough = 30;  // five are more than any matrix was seen to need
        for (int round = 0; round < enough; ++round) {
            bool turned = false;
            for (int i = 1; i < N; ++i)
                for (int j = 0; j < i; ++j) turned = turn(a, j, i) || turned;
            if (!turned) break;
        }
        for (int i = 0; i < N; ++i) values[i] = a(i, i) * scale;
        sort();
    }

  private:
    /// Makes a(j, i) zero, i > j. False if that changes nothing.
    bool turn(SmallMatrix<N, N>& a, int j, int i) {
        const double off = a(i, j);
        if (std::abs(off) < 1e-300) return false;
        // The smaller root of t^2 + 2 t (a_ii - a_jj) / (2 off) - 1 = 0: a turn by at most 45
        // degrees.
        const double theta = 0.5 * (a(i, i) - a(j, j)) / off;
        const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::hypot(1.0, theta));
        if (a(j, j) - t * off == a(j, j) && a(i, i) + t * off == a(i, i) && std::abs(t) < 1e-16)
            return false;
        const double cosine = 1.0 / std::sqrt(1.0 + t * t), sine = t * cosine;
        a(j, j) -= t * off;
        a(i, i) += t * off;
        a(i, j) = 0.0;
        for (int k = 0; k < N; ++k) {
            if constexpr (N > 2)
                if (k != i && k != j)
                    mix(a(std::max(k, j), std::min(k, j)), a(std::max(k, i), std::min(k, i)),
                        cosine, sine);
            mix(vectors(k, j), vectors(k, i), cosine, sine);
        }
        return true;
    }
    static void mix(double& x, double& y, double cosine, double sine) {
        const double turned = cosine * x - sine * y;
        y = sine * x + cosine * y;
        x = turned;
    }
    void sort() {
        for (int i = 1; i < N; ++i)
            for (int j = i; j > 0 && values[j] < values[j - 1]; --j) {
                std::swap(values[j], values[j - 1]);
                for (int k = 0; k < N; ++k) std::swap(vectors(k, j), vectors(k, j - 1));
            }
    }
};

}  // namespace talus
