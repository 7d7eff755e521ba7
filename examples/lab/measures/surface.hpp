// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/measure/cuts.hpp>
#include <talus/measure/rings.hpp>
#include <talus/measure/stress.hpp>
#include <talus/stepping/simulation.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "../picture.hpp"

namespace lab {

/// The free surface of grains of the plane between two abscissae: the topmost centre in each of
/// `columns` columns, and the line through these. Bodies `first` and later count.
class SurfaceLine {
  public:
    SurfaceLine(const talus::Bodies<2>& bodies, std::size_t first, double from, double to,
                std::size_t columns)
        : x_(columns, std::numeric_limits<double>::quiet_NaN()), y_(x_) {
        for (std::size_t i = first; i < bodies.count(); ++i) {
            const talus::Vector<2>& p = bodies.position[i];
            const double column =
                std::floor((p[0] - from) / (to - from) * static_cast<double>(columns));
            if (!(column >= 0.0) || !(column < static_cast<double>(columns))) continue;
            const auto k = static_cast<std::size_t>(column);
            if (y_[k] >= p[1]) continue;
            x_[k] = p[0];
            y_[k] = p[1];
        }
        std::size_t found = 0;
        for (const double y : y_) found += std::isfinite(y) ? 1 : 0;
        if (found >= columns / 2 && found >= 2) line_ = talus::fit_line(x_, y_);
    }

    /// Whether at least half of the columns have grains.
    bool whole() const { return line_.points > 0; }
    /// Of the rise with x [rad]; NaN unless whole.
    double angle() const {
        return whole() ? std::atan(line_.slope) : std::numeric_limits<double>::quiet_NaN();
    }
    double height(double x) const { return line_.at_zero + line_.slope * x; }  ///< [m]

  private:
    std::vector<double> x_, y_;
    talus::LineFit line_;
};

/// The resultant over ten cuts below a surface between two abscissae [N]: along it, in a depth [m],
/// each half as long as the whole, on what lies below; or upright, twice as long as the depth, on
/// what lies before them along the first axis.
inline talus::Vector<2> force_across(const talus::Simulation<2>& sim, const SurfaceLine& surface,
                                     double from, double to, double depth, bool upright) {
    using V = talus::Vector<2>;
    std::vector<V> forces;
    const auto& data = sim.data();
    talus::contact_forces<2>(data.problem.jacobian, data.impulse, data.h, forces);
    V sum = V::Zero();
    const double lean = surface.angle();
    for (int k = 0; k < 10; ++k) {
        const double x = from + (to - from) * (k + 0.5) / 10.0;
        const V centre(x, surface.height(x) - depth);
        const V normal = upright ? V(1.0, 0.0) : V(-std::sin(lean), std::cos(lean));
        const double half = upright ? depth : 0.25 * (to - from);
        sum += talus::cut_resultant<2>(sim.system().bodies, data.problem.jacobian,
                                       std::span<const V>(forces),
                                       talus::FlatCut<2>(centre, normal, half))
                   .force;
    }
    return sum;
}

/// For a picture: a surface between two abscissae, and in its middle the cuts that meet in a depth
/// [m], one upright and one along the surface.
inline std::vector<talus::DrawnLine> drawn_cuts(const SurfaceLine& surface, double from, double to,
                                                double depth) {
    const auto below = [&](double x, double down) { return Point(x, surface.height(x) - down); };
    const double middle = 0.5 * (from + to), quarter = 0.25 * (to - from);
    return {{{below(from, 0.0), below(to, 0.0)}},
            {{below(middle, 0.0), below(middle, 2.0 * depth)}},
            {{below(middle - quarter, depth), below(middle + quarter, depth)}}};
}

}  // namespace lab
