// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/types.hpp>

#include <Eigen/Core>

#include <cmath>
#include <random>

/// Seeded source of the random vectors and matrices of the law, problem and solver tests.
class RandomBlocks {
  public:
    explicit RandomBlocks(unsigned seed) : engine_(seed) {}

    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(engine_);
    }
    int integer(int low, int high) {
        return std::uniform_int_distribution<int>(low, high)(engine_);
    }
    double log_uniform(double low, double high) {
        return std::pow(10.0, uniform(std::log10(low), std::log10(high)));
    }
    template <int Rows, int Columns = 1>
    Eigen::Matrix<double, Rows, Columns> normal() {
        std::normal_distribution<double> gauss;
        Eigen::Matrix<double, Rows, Columns> m;
        for (int i = 0; i < m.size(); ++i) m.data()[i] = gauss(engine_);
        return m;
    }
    template <int Dim>
    talus::Vector<Dim> unit() {
        return normal<Dim>().normalized();
    }
    /// Symmetric positive semidefinite of the given rank, entries of order one.
    template <int Dim>
    talus::Matrix<Dim> semidefinite(int rank) {
        talus::Matrix<Dim> g = normal<Dim, Dim>();
        for (int k = rank; k < Dim; ++k) g.col(k).setZero();
        return g * g.transpose();
    }
    /// Symmetric with eigenvalues in [0.1, 1].
    template <int Dim>
    talus::Matrix<Dim> well_conditioned() {
        const talus::Matrix<Dim> q = orthogonal<Dim>();
        talus::Vector<Dim> d;
        for (int i = 0; i < Dim; ++i) d[i] = uniform(0.1, 1.0);
        return q * d.asDiagonal() * q.transpose();
    }
    /// Orthogonal, of either determinant. By Gram and Schmidt, twice: Householder's way takes
    /// seconds to compile for each N.
    template <int N>
    Eigen::Matrix<double, N, N> orthogonal() {
        Eigen::Matrix<double, N, N> q = normal<N, N>();
        for (int k = 0; k < N; ++k) {
            for (int pass = 0; pass < 2; ++pass)
                for (int j = 0; j < k; ++j) q.col(k) -= q.col(j).dot(q.col(k)) * q.col(j);
            q.col(k).normalize();
        }
        return q;
    }
    /// Orthogonal and leaves the normal alone: a change of tangents.
    template <int Dim>
    talus::Matrix<Dim> change_of_tangents() {
        talus::Matrix<Dim> q = talus::Matrix<Dim>::Identity();
        q.template bottomRightCorner<Dim - 1, Dim - 1>() = orthogonal<Dim - 1>();
        return q;
    }

  private:
    std::mt19937_64 engine_;
};
