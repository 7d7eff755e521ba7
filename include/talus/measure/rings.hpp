// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/number_record.hpp>
#include <talus/dynamics/bodies.hpp>
#include <talus/problem/contact_problem.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

namespace talus {

/// Rings of equal width about an upright axis; in the plane pairs of segments on both sides of it.
/// Up is the last axis.
template <int Dim>
requires SpaceDimension<Dim>
class Rings {
  public:
    /// Throws input_error unless there is a ring and its width [m] is positive.
    Rings(const Vector<Dim>& axis, double width, std::size_t count)
        : axis_(require_finite("axis of the rings", axis)),
          width_(require_positive("width of the rings", width)),
          count_(count) {
        require_in("number of rings", static_cast<double>(count), 1.0, 1e7);
    }

    std::size_t count() const { return count_; }
    double width() const { return width_; }
    /// Distance from the axis [m].
    double distance(const Vector<Dim>& x) const {
        Vector<Dim> way = x - axis_;
        way[Dim - 1] = 0.0;
        return way.norm();
    }
    /// Ring of a point; `count()` if it is beyond all.
    std::size_t ring(const Vector<Dim>& x) const {
        const double k = std::floor(distance(x) / width_);
        return k < static_cast<double>(count_) ? static_cast<std::size_t>(k) : count_;
    }
    double middle(std::size_t k) const { return (static_cast<double>(k) + 0.5) * width_; }  ///< [m]
    /// Length in the plane, area in space [m^(Dim-1)].
    double area(std::size_t k) const {
        const double in = static_cast<double>(k) * width_, out = in + width_;
        constexpr std::array unit{2.0, std::numbers::pi};  // of half length, of radius 1
        return unit[Dim - 2] * (std::pow(out, Dim - 1) - std::pow(in, Dim - 1));
    }

  private:
    Vector<Dim> axis_;
    double width_;
    std::size_t count_;
};

/// Mean pressure of a heap on its ground by rings, over all steps recorded: the downward force of
/// grains on ground bodies at points of contact in the ring, over the area of the ring. What
/// [Moreau] section 3.5 measures under conical piles.
template <int Dim>
requires SpaceDimension<Dim>
class GroundPressure {
  public:
    explicit GroundPressure(const Rings<Dim>& rings) : rings_(rings), force_(rings.count(), 0.0) {}

    /// Adds a step: forces on body a of each contact, world axes (contact_forces); `is_ground(i)`
    /// of bodies. Where the ground is an obstacle, levers end at the point of contact. O(contacts).
    template <class IsGround>
    void record(const ContactJacobian<Dim>& jacobian, std::span<const Vector<Dim>> forces,
                const Bodies<Dim>& bodies, IsGround&& is_ground) {
        require_count("forces", forces.size(), "contacts", jacobian.contact_count());
        jacobian.require_bodies(bodies.count());
        for (std::size_t c = 0; c < forces.size(); ++c) {
            const auto a = static_cast<std::size_t>(jacobian.a[c]);
            const auto b = static_cast<std::size_t>(jacobian.b[c]);
            const bool on_a = is_ground(a);
            if (on_a == is_ground(b)) continue;
            // By the ground's arm: the grain has moved since.
            const Vector<Dim> point = on_a ? bodies.position[a] + jacobian.arm_a[c]
                                           : bodies.position[b] + jacobian.arm_b[c];
            const std::size_t k = rings_.ring(point);
            const double down = on_a ? -forces[c][Dim - 1] : forces[c][Dim - 1];
            total_ += down;
            if (k < force_.size()) force_[k] += down;
        }
        ++records_;
    }

    const Rings<Dim>& rings() const { return rings_; }
    std::int64_t records() const { return records_; }
    /// Mean over the records; 0 without any [N/m^(Dim-1)].
    double pressure(std::size_t k) const {
        return records_ > 0 ? force_[k] / (static_cast<double>(records_) * rings_.area(k)) : 0.0;
    }
    /// Mean force on all of the ground, beyond the rings too [N].
    double force() const { return records_ > 0 ? total_ / static_cast<double>(records_) : 0.0; }

    void write(NumberRecord& out) const {
        out.integer(records_);
        out.real(total_);
        for (const double f : force_) out.real(f);
    }
    void restore(const NumberRecord& record) {
        NumberRecordReader in(record);
        GroundPressure other(rings_);
        other.records_ = in.integer(0);
        other.total_ = in.real();
        for (double& f : other.force_) f = in.real();
        in.require_end();
        *this = other;
    }

  private:
    Rings<Dim> rings_;
    std::vector<double> force_;  // summed over records
    double total_ = 0.0;
    std::int64_t records_ = 0;
};

/// Height of the surface of a heap by rings: of each ring the highest point of the balls of these
/// bodies, `radius[i]` about their centres [m]; NaN where there is none.
template <int Dim, class Counts>
std::vector<double> surface_heights(const Rings<Dim>& rings, const Bodies<Dim>& bodies,
                                    std::span<const double> radius, Counts&& counts) {
    std::vector<double> height(rings.count(), std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < bodies.count(); ++i) {
        if (!counts(i)) continue;
        const std::size_t k = rings.ring(bodies.position[i]);
        if (k == rings.count()) continue;
        const double top = bodies.position[i][Dim - 1] + radius[i];
        if (!(height[k] >= top)) height[k] = top;
    }
    return height;
}

/// A straight line y = at_zero + slope x, by least squares.
struct LineFit {
    double at_zero = 0.0, slope = 0.0;
    std::size_t points = 0;
    /// Of the fall, positive where y falls with x [rad].
    double angle() const { return std::atan(-slope); }
};

/// Through the points that are finite. Throws input_error unless there are as many y as x, and two
/// points of different x.
inline LineFit fit_line(std::span<const double> x, std::span<const double> y) {
    require_count("ordinates", y.size(), "abscissae", x.size());
    LineFit fit;
    double mean_x = 0.0, mean_y = 0.0;
    for (std::size_t k = 0; k < x.size(); ++k) {
        if (!std::isfinite(x[k]) || !std::isfinite(y[k])) continue;
        ++fit.points;
        mean_x += x[k];
        mean_y += y[k];
    }
    require_in("finite points to fit a line through", static_cast<double>(fit.points), 2.0, 1e15);
    mean_x /= static_cast<double>(fit.points);
    mean_y /= static_cast<double>(fit.points);
    double square = 0.0, product = 0.0;
    for (std::size_t k = 0; k < x.size(); ++k) {
        if (!std::isfinite(x[k]) || !std::isfinite(y[k])) continue;
        square += (x[k] - mean_x) * (x[k] - mean_x);
        product += (x[k] - mean_x) * (y[k] - mean_y);
    }
    require_positive("spread of the points to fit a line through", square);
    fit.slope = product / square;
    fit.at_zero = mean_y - fit.slope * mean_x;
    return fit;
}

}  // namespace talus
