// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/number_record.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace lab {

/// A rail: an elastic beam without mass from the first to the last of its supports, fastened to
/// each by a pad, a spring that pushes and pulls. A wheel on it loads the supports near it. The
/// beam has Hermite elements between supports, which are exact there for the load of a wheel
/// anywhere.
class Rail {
  public:
    /// Supports at ascending places [m], bending stiffness EI [N m^2] and stiffness of a pad [N/m].
    /// Throws input_error if a number is out of range.
    Rail(std::vector<double> places, double bending, double pad)
        : places_(std::move(places)), pad_(pad) {
        talus::require_positive("bending stiffness of the rail", bending);
        talus::require_positive("stiffness of a pad", pad);
        talus::require_in("supports of the rail", static_cast<double>(places_.size()), 2, 1e4);
        const auto n = static_cast<Eigen::Index>(places_.size());
        Eigen::MatrixXd k = Eigen::MatrixXd::Zero(2 * n, 2 * n);
        for (Eigen::Index e = 0; e + 1 < n; ++e) {
            const double l = talus::require_positive("distance of supports", span(e));
            const double c = bending / (l * l * l);
            Eigen::Matrix4d element;
            element << 12.0, 6.0 * l, -12.0, 6.0 * l,         //
                6.0 * l, 4.0 * l * l, -6.0 * l, 2.0 * l * l,  //
                -12.0, -6.0 * l, 12.0, -6.0 * l,              //
                6.0 * l, 2.0 * l * l, -6.0 * l, 4.0 * l * l;
            k.block<4, 4>(2 * e, 2 * e) += c * element;
        }
        for (Eigen::Index i = 0; i < n; ++i) k(2 * i, 2 * i) += pad;
        stiffness_.compute(k);
    }

    /// Lays the rail without stress on supports at these heights [m].
    void fasten(std::vector<double> heights) {
        talus::require_count("heights", heights.size(), "supports", places_.size());
        laid_ = std::move(heights);
    }
    bool fastened() const { return !laid_.empty(); }
    const std::vector<double>& laid() const { return laid_; }  ///< the heights that it was laid at

    /// Forces on the supports at these heights [m], upwards, from a wheel of the given load [N] at
    /// x [m], which must be on the rail. Their sum is -load, as is their moment about any point.
    std::vector<double> forces(double load, double x, std::span<const double> heights) const {
        talus::require_in("place of the wheel", x, places_.front(), places_.back());
        const std::size_t n = places_.size();
        std::vector<double> moved(n, 0.0);
        for (std::size_t i = 0; i < laid_.size(); ++i) moved[i] = heights[i] - laid_[i];
        Eigen::VectorXd f = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(2 * n));
        for (std::size_t i = 0; i < n; ++i) f[static_cast<Eigen::Index>(2 * i)] = pad_ * moved[i];
        const auto after = std::upper_bound(places_.begin() + 1, places_.end() - 1, x);
        const Eigen::Index e = after - places_.begin() - 1;
        const double l = span(e), s = (x - places_[static_cast<std::size_t>(e)]) / l;
        f.segment<4>(2 * e) -=
            load * Eigen::Vector4d((1 - s) * (1 - s) * (1 + 2 * s), l * s * (1 - s) * (1 - s),
                                   s * s * (3 - 2 * s), l * s * s * (s - 1));
        const Eigen::VectorXd bent = stiffness_.solve(f);
        std::vector<double> found(n);
        for (std::size_t i = 0; i < n; ++i)
            found[i] = pad_ * (bent[static_cast<Eigen::Index>(2 * i)] - moved[i]);
        return found;
    }

    /// The heights at which it was laid; what it is made of is said again by the program.
    void write(talus::NumberRecord& out) const {
        out.integer(laid_.size());
        for (const double z : laid_) out.real(z);
    }
    void restore(const talus::NumberRecord& record) {
        talus::NumberRecordReader in(record);
        std::vector<double> laid(in.count(1, 0));
        for (double& z : laid) z = in.real();
        in.require_end();
        laid_ = std::move(laid);
    }

  private:
    double span(Eigen::Index e) const {
        const auto i = static_cast<std::size_t>(e);
        return places_[i + 1] - places_[i];
    }

    std::vector<double> places_, laid_;
    double pad_;
    Eigen::LDLT<Eigen::MatrixXd> stiffness_;
};

/// Of a wheel's load, the part that the support takes which is `distance` from it [m], if the rail
/// is endless and the pads, every `spacing` [m], are spread evenly along it (Winkler 1867;
/// Zimmermann, Die Berechnung des Eisenbahnoberbaues, 1888).
inline double zimmermann_share(double distance, double spacing, double bending, double pad) {
    const double length = std::pow(4.0 * bending * spacing / pad, 0.25);
    const double u = std::abs(distance) / length;
    return spacing / (2.0 * length) * std::exp(-u) * (std::cos(u) + std::sin(u));
}

}  // namespace lab
