// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/problem/concepts.hpp>
#include <talus/problem/delassus_sparse.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "setting.hpp"

namespace validation {

/// u = W r + free_velocity with W given as it stands, of whatever system it comes: (Dim n) x
/// (Dim n), contact by contact in local axes, normal first.
template <int Dim>
struct DenseProblem {
    Eigen::MatrixXd w;                  ///< [1/kg]
    std::vector<V<Dim>> free_velocity;  ///< [m/s]
    std::vector<Law<Dim>> laws;

    std::size_t contact_count() const { return free_velocity.size(); }
    /// W block by block.
    std::vector<talus::DelassusBlock<Dim>> blocks() const {
        std::vector<talus::DelassusBlock<Dim>> all;
        for (std::size_t i = 0; i < contact_count(); ++i)
            for (std::size_t j = 0; j < contact_count(); ++j)
                all.push_back({i, j,
                               w.block<Dim, Dim>(Dim * static_cast<Eigen::Index>(i),
                                                 Dim * static_cast<Eigen::Index>(j))});
        return all;
    }
};

/// Such a W as the solver wants it: a Delassus operator.
template <int Dim>
class DenseDelassus {
  public:
    explicit DenseDelassus(const Eigen::MatrixXd& w)
        : w_(w), velocity_(Eigen::VectorXd::Zero(w.rows())) {}

    std::size_t contact_count() const { return static_cast<std::size_t>(w_.rows()) / Dim; }
    talus::Matrix<Dim> diagonal_block(std::size_t i) const {
        return w_.block<Dim, Dim>(at(i), at(i));
    }
    void multiply(std::span<const V<Dim>> r, std::span<V<Dim>> u) const {
        const Eigen::VectorXd all = product(r);
        for (std::size_t i = 0; i < u.size(); ++i) u[i] = all.segment<Dim>(at(i));
    }
    void start(std::span<const V<Dim>> r) { velocity_ = product(r); }
    V<Dim> velocity(std::size_t i) const { return velocity_.segment<Dim>(at(i)); }
    void add(std::size_t i, const V<Dim>& dr) { velocity_ += w_.middleCols<Dim>(at(i)) * dr; }

  private:
    static Eigen::Index at(std::size_t i) { return Dim * static_cast<Eigen::Index>(i); }
    Eigen::VectorXd product(std::span<const V<Dim>> r) const {
        Eigen::VectorXd all = Eigen::VectorXd::Zero(w_.rows());
        for (std::size_t i = 0; i < r.size(); ++i) all += w_.middleCols<Dim>(at(i)) * r[i];
        return all;
    }

    const Eigen::MatrixXd& w_;
    Eigen::VectorXd velocity_;
};
static_assert(talus::SweepableDelassus<DenseDelassus<2>, 2> &&
              talus::SweepableDelassus<DenseDelassus<3>, 3>);

}  // namespace validation
