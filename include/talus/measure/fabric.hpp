// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/types.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

namespace talus {

/// Counts of directions in the plane over equal sectors of the full turn, the first one beginning
/// at the first axis ([Moreau] section 3.3 has 24).
class DirectionHistogram {
  public:
    /// Throws input_error unless there are 3 to 100000 sectors.
    explicit DirectionHistogram(std::size_t sectors) {
        require_in("sectors of the histogram", static_cast<double>(sectors), 3.0, 1e5);
        counts_.assign(sectors, 0.0);
    }

    /// Counts a direction of any length but zero. A contact normal has no sense: add both.
    void add(const Vector<2>& direction, double weight = 1.0) {
        const double turn = std::atan2(direction[1], direction[0]) / (2.0 * std::numbers::pi);
        const double from_axis = turn < 0.0 ? turn + 1.0 : turn;
        const auto n = counts_.size();
        counts_[static_cast<std::size_t>(from_axis * static_cast<double>(n)) % n] += weight;
        total_ += weight;
    }
    /// The direction and its opposite.
    void add_normal(const Vector<2>& normal, double weight = 1.0) {
        add(normal, weight);
        add(-normal, weight);
    }

    std::size_t sectors() const { return counts_.size(); }
    double count(std::size_t sector) const { return counts_.at(sector); }
    double total() const { return total_; }
    /// Angle of the middle of a sector [rad].
    double middle(std::size_t sector) const {
        return 2.0 * std::numbers::pi * (static_cast<double>(sector) + 0.5) /
               static_cast<double>(sectors());
    }
    /// Relative frequency per radian [1/rad]; 1 / (2 pi) everywhere if no direction is preferred.
    double density(std::size_t sector) const {
        return total_ > 0.0 ? counts_.at(sector) * static_cast<double>(sectors()) /
                                  (2.0 * std::numbers::pi * total_)
                            : 0.0;
    }

  private:
    std::vector<double> counts_;
    double total_ = 0.0;
};

/// One term of a density (1 + sum_n a_n cos n (theta - theta_n)) / (2 pi).
struct FabricHarmonic {
    int order = 2;           ///< n
    double amplitude = 0.0;  ///< a_n [-], not negative
    double direction = 0.0;  ///< theta_n in [0, 2 pi / n) [rad]
};

/// Least-squares fit of a density's harmonic of order n to a histogram. The sums over equal sectors
/// are orthogonal, so that each order stands alone; a sector of width d averages cos n theta, which
/// multiplies its amplitude by sin(n d / 2) / (n d / 2), taken back here. Throws input_error unless
/// 1 <= n < sectors / 2 and something was counted.
inline FabricHarmonic fit_harmonic(const DirectionHistogram& histogram, int order) {
    const auto n = static_cast<double>(histogram.sectors());
    require_in("order of the harmonic", order, 1.0, std::ceil(n / 2.0) - 1.0);
    require_positive("total of the histogram", histogram.total());
    double cosine = 0.0, sine = 0.0;
    for (std::size_t k = 0; k < histogram.sectors(); ++k) {
        const double share = 2.0 * histogram.count(k) / histogram.total();
        cosine += share * std::cos(order * histogram.middle(k));
        sine += share * std::sin(order * histogram.middle(k));
    }
    const double half_width = order * std::numbers::pi / n;
    const double averaged = std::sin(half_width) / half_width;
    double phase = std::atan2(sine, cosine) / order;
    if (phase < 0.0) phase += 2.0 * std::numbers::pi / order;
    return {order, std::hypot(cosine, sine) / averaged, phase};
}

/// A density of directions that have no sense, (1 + sum over its terms) / (2 pi).
struct FabricFit {
    std::vector<FabricHarmonic> terms;

    /// At an angle [rad], per radian.
    double density(double angle) const {
        double sum = 1.0;
        for (const FabricHarmonic& t : terms)
            sum += t.amplitude * std::cos(t.order * (angle - t.direction));
        return sum / (2.0 * std::numbers::pi);
    }
    /// Angles in [0, pi) at which the density is largest among its neighbours, ascending [rad].
    std::vector<double> peaks() const;
};

/// Multiples of 2 theta up to `highest`, of which each stands alone (fit_harmonic): the fit of
/// [Moreau] section 3.3. Throws input_error for an odd one, and as fit_harmonic does.
inline FabricFit fit_fabric(const DirectionHistogram& histogram, int highest = 4) {
    if (highest < 2 || highest % 2 != 0)
        detail::reject("highest order of the fit", highest, "even and at least 2");
    FabricFit fit;
    for (int order = 2; order <= highest; order += 2)
        fit.terms.push_back(fit_harmonic(histogram, order));
    return fit;
}

inline std::vector<double> FabricFit::peaks() const {
    constexpr int steps = 7200;
    constexpr double width = std::numbers::pi / steps;
    std::vector<double> found;
    double before = density(-width), here = density(0.0);
    for (int k = 0; k < steps; ++k) {
        const double after = density((k + 1) * width);
        if (here > before && here >= after) {
            // The vertex of the parabola through the three.
            const double bend = before - 2.0 * here + after;
            double angle = k * width + (bend < 0.0 ? 0.5 * (before - after) / bend * width : 0.0);
            if (angle < 0.0) angle += std::numbers::pi;
            found.push_back(angle);
        }
        before = here;
        here = after;
    }
    std::sort(found.begin(), found.end());
    return found;
}

/// Mean of n n^T over directions that have no sense, weighted: the fabric tensor. Its trace is 1.
template <int Dim>
requires SpaceDimension<Dim>
class FabricTensor {
  public:
    /// Counts a unit direction.
    void add(const Vector<Dim>& normal, double weight = 1.0) {
        sum_ += weight * (normal * normal.transpose());
        total_ += weight;
    }
    double total() const { return total_; }
    /// Throws input_error if nothing was counted.
    Matrix<Dim> tensor() const {
        require_positive("total of the fabric tensor", total_);
        return sum_ / total_;
    }
    /// The traceless a of the density (1 + n . a n) / (2 pi), in space / (4 pi), that has this
    /// fabric tensor ([Kanatani1984]: the fabric tensor of the third kind): (Dim + 2) Dim / 2 times
    /// its deviator. In the plane its larger principal value is the amplitude of order 2.
    Matrix<Dim> anisotropy() const {
        constexpr double factor = 0.5 * Dim * (Dim + 2);
        return factor * (tensor() - Matrix<Dim>::Identity() / double{Dim});
    }

  private:
    Matrix<Dim> sum_ = Matrix<Dim>::Zero();
    double total_ = 0.0;
};

}  // namespace talus
