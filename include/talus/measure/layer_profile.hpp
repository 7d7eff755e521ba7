// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/number_record.hpp>
#include <talus/dynamics/bodies.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace talus {

/// Averages by layers across a direction, over bodies and over the times at which they are
/// recorded: how much mass there is, how fast it goes, and how it fluctuates (the granular
/// temperature). A body counts where its centre is.
template <int Dim>
requires SpaceDimension<Dim>
class LayerProfile {
  public:
    /// `count` layers of equal thickness from `low` to `high`, the coordinate along `axis` [m].
    /// Throws input_error unless the axis has a length, there is a layer, and high is above low.
    LayerProfile(const Vector<Dim>& axis, double low, double high, std::size_t count)
        : low_(low), high_(high) {
        require_finite("axis of the profile", axis);
        require_positive("length of the axis of the profile", axis.norm());
        axis_ = axis.normalized();
        if (!(std::isfinite(low) && std::isfinite(high) && high > low))
            detail::reject("upper end of the profile", high,
                           "finite and above the lower, " + detail::text_of(low));
        require_in("layers of the profile", static_cast<double>(count), 1.0, 1e6);
        mass_.assign(count, 0.0);
        momentum_.assign(count, Vector<Dim>::Zero());
        square_.assign(count, 0.0);
    }

    /// Adds the bodies as they are, those for which `counts(i)` holds. O(bodies).
    template <class Counts>
    void record(const Bodies<Dim>& bodies, Counts&& counts) {
        for (std::size_t i = 0; i < bodies.count(); ++i) {
            if (bodies.is_obstacle(i) || !counts(i)) continue;
            const double share = (axis_.dot(bodies.position[i]) - low_) / (high_ - low_);
            if (!(share >= 0.0) || !(share < 1.0)) continue;
            const auto layer = static_cast<std::size_t>(share * static_cast<double>(count()));
            const double m = bodies.mass(i);
            const Vector<Dim>& v = bodies.velocity[i];
            mass_[layer] += m;
            momentum_[layer] += m * v;
            square_[layer] += m * v.squaredNorm();
        }
        ++records_;
    }
    void record(const Bodies<Dim>& bodies) {
        record(bodies, [](std::size_t) { return true; });
    }

    std::size_t count() const { return mass_.size(); }
    std::size_t records() const { return records_; }
    double thickness() const { return (high_ - low_) / static_cast<double>(count()); }  ///< [m]
    /// The middle of a layer along the axis [m].
    double middle(std::size_t layer) const {
        return low_ + (static_cast<double>(layer) + 0.5) * thickness();
    }
    /// Mass per record over the thickness [kg/m]: over area and density of the grains the solid
    /// fraction.
    double mass_per_length(std::size_t layer) const {
        return records_ > 0 ? mass_[layer] / static_cast<double>(records_) / thickness() : 0.0;
    }
    /// Mean by mass [m/s]; zero where there was none.
    Vector<Dim> velocity(std::size_t layer) const {
        if (!(mass_[layer] > 0.0)) return Vector<Dim>::Zero();
        return momentum_[layer] / mass_[layer];
    }
    /// Mean square by mass of one component of the velocity about its mean in the layer [m^2/s^2].
    double temperature(std::size_t layer) const {
        if (!(mass_[layer] > 0.0)) return 0.0;
        const double all = square_[layer] / mass_[layer];
        return std::max(0.0, all - velocity(layer).squaredNorm()) / Dim;
    }

    /// What was recorded, to go on with.
    void write(NumberRecord& out) const {
        out.integer(static_cast<std::int64_t>(records_));
        out.integer(static_cast<std::int64_t>(count()));
        for (std::size_t k = 0; k < count(); ++k) {
            out.real(mass_[k]);
            for (int d = 0; d < Dim; ++d) out.real(momentum_[k][d]);
            out.real(square_[k]);
        }
    }
    /// Throws input_error, and keeps what there is, if it is of another number of layers.
    void restore(const NumberRecord& record) {
        NumberRecordReader in(record);
        LayerProfile other = *this;
        other.records_ = static_cast<std::size_t>(in.integer(0));
        const auto layers = static_cast<std::size_t>(in.integer(0));
        require_count("layers of the record", layers, "layers", count());
        for (std::size_t k = 0; k < layers; ++k) {
            other.mass_[k] = in.real();
            for (int d = 0; d < Dim; ++d) other.momentum_[k][d] = in.real();
            other.square_[k] = in.real();
        }
        in.require_end();
        *this = std::move(other);
    }

  private:
    Vector<Dim> axis_;
    double low_, high_;
    std::size_t records_ = 0;
    std::vector<double> mass_;           // [kg]
    std::vector<Vector<Dim>> momentum_;  // [kg m/s]
    std::vector<double> square_;         // of the velocity, by mass [kg m^2/s^2]
};

}  // namespace talus
