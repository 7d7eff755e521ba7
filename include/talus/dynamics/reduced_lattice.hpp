// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/types.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace talus {

/// The same lattice by its shortest vectors: however far a cell was sheared, the images near a body
/// are then those of few steps. Pairwise reduction, then by sums of the others, until nothing gets
/// shorter ([Semaev2001]; in the plane Gauss's). A function of the lattice alone.
template <int Dim>
requires SpaceDimension<Dim>
struct ReducedLattice {
    using Directions = std::array<bool, static_cast<std::size_t>(Dim)>;
    using Steps = std::array<std::int64_t, static_cast<std::size_t>(Dim)>;

    Matrix<Dim> vectors;                                  ///< columns [m]
    std::array<Steps, static_cast<std::size_t>(Dim)> of;  ///< vector k in those of the lattice
    Directions periodic;

    /// Vectors that are not periodic stay.
    ReducedLattice(const Matrix<Dim>& lattice, const Directions& periodic_);

    /// Length of the shortest vector of the lattice; infinite if none is periodic [m].
    double shortest() const {
        double least = std::numeric_limits<double>::infinity();
        for (int k = 0; k < Dim; ++k)
            if (is_periodic(k)) least = std::min(least, vector(k).norm());
        return least;
    }
    /// In steps of the lattice that was given.
    Steps in_lattice(const Steps& steps) const {
        Steps sum{};
        for (std::size_t k = 0; k < sum.size(); ++k)
            for (std::size_t j = 0; j < sum.size(); ++j) sum[j] += of[k][j] * steps[k];
        return sum;
    }

  private:
    bool is_periodic(int k) const { return periodic[static_cast<std::size_t>(k)]; }
    Vector<Dim> vector(int k) const { return vectors.col(k); }
    /// Adds `times` vector j to vector i if that is shorter.
    bool shorten(int i, const Steps& times);
    bool shorten_by_one();
    bool shorten_by_sums();
};

template <int Dim>
requires SpaceDimension<Dim> ReducedLattice<Dim>::ReducedLattice(const Matrix<Dim>& lattice,
                                                                 const Directions& periodic_)
    : vectors(lattice), of{}, periodic(periodic_) {
    for (std::size_t k = 0; k < of.size(); ++k) of[k][k] = 1;
    constexpr int most = 1000;  // each round shortens by a factor
    for (int round = 0; round < most && (shorten_by_one() || shorten_by_sums()); ++round) {
    }
    // By the integers, so that vectors have the same bits however they were found.
    for (int k = 0; k < Dim; ++k) {
        Vector<Dim> sum = Vector<Dim>::Zero();
        for (int j = 0; j < Dim; ++j)
            sum +=
                static_cast<double>(of[static_cast<std::size_t>(k)][static_cast<std::size_t>(j)]) *
                Vector<Dim>(lattice.col(j));
        vectors.col(k) = sum;
    }
}

template <int Dim>
requires SpaceDimension<Dim>
bool ReducedLattice<Dim>::shorten(int i, const Steps& times) {
    constexpr double rounding = 1e-12;
    Vector<Dim> sum = vector(i);
    for (int j = 0; j < Dim; ++j)
        sum += static_cast<double>(times[static_cast<std::size_t>(j)]) * vector(j);
    if (!(sum.squaredNorm() < (1.0 - rounding) * vector(i).squaredNorm())) return false;
    vectors.col(i) = sum;
    Steps& own = of[static_cast<std::size_t>(i)];
    for (std::size_t j = 0; j < times.size(); ++j)
        for (std::size_t d = 0; d < own.size(); ++d) own[d] += times[j] * of[j][d];
    return true;
}

template <int Dim>
requires SpaceDimension<Dim>
bool ReducedLattice<Dim>::shorten_by_one() {
    bool any = false;
    for (int i = 0; i < Dim; ++i)
        for (int j = 0; j < Dim; ++j) {
            if (i == j || !is_periodic(i) || !is_periodic(j)) continue;
            const double times = -std::round(vector(i).dot(vector(j)) / vector(j).squaredNorm());
            constexpr double most = 1e15;  // what integers of a double hold
            if (times == 0.0 || !(std::abs(times) <= most)) continue;
            Steps steps{};
            steps[static_cast<std::size_t>(j)] = static_cast<std::int64_t>(times);
            any |= shorten(i, steps);
        }
    return any;
}

template <int Dim>
requires SpaceDimension<Dim>
bool ReducedLattice<Dim>::shorten_by_sums() {
    for (int i = 0; i < Dim; ++i) {
        if (!is_periodic(i)) continue;
        Steps times{};
        // All of -1, 0, 1 for the others, counted in threes.
        const auto next = [&] {
            for (int j = 0; j < Dim; ++j) {
                if (j == i || !is_periodic(j)) continue;
                auto& t = times[static_cast<std::size_t>(j)];
                t = t == 1 ? -1 : t + 1;
                if (t != 0) return true;
            }
            return false;
        };
        while (next())
            if (shorten(i, times)) return true;
    }
    return false;
}

}  // namespace talus
