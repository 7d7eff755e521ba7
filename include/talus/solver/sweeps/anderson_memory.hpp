// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/column.hpp>
#include <talus/core/room.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

namespace talus {

/// The last iterates of a fixed-point map T, and their affine combination whose increment is least
/// [WalkerNi2011]. Keeps 2 depth + 4 arrays of n numbers; a step costs 3 depth products of them.
class AndersonMemory {
  public:
    /// Room for iterates of n numbers, `depth` of them.
    void make_room(std::size_t n, int depth) {
        const auto most = static_cast<std::size_t>(depth);
        for (Column<double>* one : {&images_, &increments_}) detail::make_room(*one, n * most);
        for (Column<double>* one : {&gram_, &factor_}) detail::make_room(*one, most * most);
        for (Column<double>* one : {&now_image_, &now_increment_, &last_image_, &last_increment_})
            detail::make_room(*one, n);
        detail::make_room(weights_, most);
    }
    /// For iterates of n numbers, at most `depth` > 0 of them. Forgets them if one is another.
    void prepare(std::size_t n, int depth) {
        const auto room = static_cast<std::size_t>(depth);
        if (now_image_.size() == n && depth_ == room) return;
        depth_ = room;
        images_.resize(n * room);
        increments_.resize(n * room);
        gram_.resize(room * room);
        factor_.resize(room * room);
        weights_.resize(room);
        for (Column<double>* one : {&now_image_, &now_increment_, &last_image_, &last_increment_})
            one->resize(n);
        clear();
    }
    void clear() {
        columns_ = newest_ = 0;
        has_last_ = false;
    }
    /// To be filled with T(y), and to be read after `combine`.
    std::span<double> image() { return now_image_; }
    /// To be filled with T(y) - y.
    std::span<double> increment() { return now_increment_; }

    /// Takes what image() and increment() hold for the newest iterate; image() then holds the
    /// combination. False if there is none yet, or none that is finite, which empties the memory:
    /// image() then holds nothing of use.
    bool combine() {
        if (has_last_) remember();
        has_last_ = true;
        last_image_.swap(now_image_);
        last_increment_.swap(now_increment_);
        if (columns_ == 0) return false;
        if (find_weights()) {
            double sum = 0.0;
            std::copy(last_image_.begin(), last_image_.end(), now_image_.begin());
            for (std::size_t j = 0; j < columns_; ++j) {
                const double* const image = column(images_, j);
                for (std::size_t i = 0; i < now_image_.size(); ++i)
                    now_image_[i] -= weights_[j] * image[i];
            }
            for (const double x : now_image_) sum += x;
            if (std::isfinite(sum)) return true;
        }
        clear();
        return false;
    }

  private:
    double* column(Column<double>& all, std::size_t j) {
        return all.data() + j * now_image_.size();
    }
    /// Of columns; four sums, so that additions need not wait for each other.
    double dot(const double* x, const double* y) const {
        double sum[4] = {};
        const std::size_t n = now_image_.size();
        for (std::size_t i = 0; i < n; i += 4)
            for (std::size_t k = 0; k < 4 && i + k < n; ++k) sum[k] += x[i + k] * y[i + k];
        return (sum[0] + sum[1]) + (sum[2] + sum[3]);
    }
    double& gram(std::size_t i, std::size_t j) { return gram_[i * depth_ + j]; }
    double& factor(std::size_t i, std::size_t j) { return factor_[i * depth_ + j]; }

    /// Puts the last differences in the place of the oldest ones, and their products into the Gram
    /// matrix: depth products in all, as the others are known.
    void remember() {
        const std::size_t at = columns_ < depth_ ? columns_++ : newest_;
        newest_ = (at + 1) % depth_;
        double *const image = column(images_, at), *const increment = column(increments_, at);
        for (std::size_t i = 0; i < now_image_.size(); ++i) {
            image[i] = now_image_[i] - last_image_[i];
            increment[i] = now_increment_[i] - last_increment_[i];
        }
        for (std::size_t j = 0; j < columns_; ++j)
            gram(at, j) = gram(j, at) = dot(increment, column(increments_, j));
    }

    /// Those of least increment, by Cholesky's factors: there are twenty columns at most. False if
    /// they are lost in rounding.
    bool find_weights() {
        constexpr double regular = 1e-10;  // Gram matrices carry half the digits
        double trace = 0.0;
        for (std::size_t i = 0; i < columns_; ++i) trace += gram(i, i);
        for (std::size_t i = 0; i < columns_; ++i) {
            weights_[i] = dot(column(increments_, i), last_increment_.data());
            for (std::size_t j = 0; j <= i; ++j) {
                double rest = gram(i, j) + (i == j ? regular * trace : 0.0);
                for (std::size_t k = 0; k < j; ++k) rest -= factor(i, k) * factor(j, k);
                if (i == j && !(rest > 0.0)) return false;
                factor(i, j) = i == j ? std::sqrt(rest) : rest / factor(j, j);
            }
            for (std::size_t k = 0; k < i; ++k) weights_[i] -= factor(i, k) * weights_[k];
            weights_[i] /= factor(i, i);
        }
        for (std::size_t i = columns_; i-- > 0;) {
            for (std::size_t k = i + 1; k < columns_; ++k)
                weights_[i] -= factor(k, i) * weights_[k];
            weights_[i] /= factor(i, i);
        }
        return true;
    }

    std::size_t depth_ = 0;
    std::size_t columns_ = 0, newest_ = 0;  // newest_: the place of the next difference
    bool has_last_ = false;
    Column<double> images_, increments_;  // differences of T(y) and of T(y) - y, in a ring
    Column<double> gram_, factor_, weights_;
    Column<double> now_image_, now_increment_, last_image_, last_increment_;
};

}  // namespace talus
