// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/measure/rings.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "../table.hpp"

namespace lab {

/// The pressure of a heap on the ground and its surface, ring by ring as far as it reaches.
template <int Dim>
class RingProfile {
  public:
    /// Heights of the surface are those of surface_heights [m]. The slope is that of the third ring
    /// and those outside of it, if there are two of them.
    RingProfile(const talus::GroundPressure<Dim>& pressure, const std::vector<double>& heights) {
        std::vector<double> flank;
        std::size_t count = pressure.rings().count(), known = 0;
        while (count > 1 && !(pressure.pressure(count - 1) > 0.0)) --count;
        for (std::size_t k = 0; k < count; ++k) {
            at_.push_back(pressure.rings().middle(k));
            pressure_.push_back(pressure.pressure(k));
            height_.push_back(heights[k]);
            flank.push_back(k >= 2 ? heights[k] : std::nan(""));
        }
        for (const double h : flank) known += std::isfinite(h) ? 1 : 0;
        if (known >= 2) slope_ = talus::fit_line(at_, flank);
    }

    bool sloped() const { return slope_.points > 0; }
    double radius() const { return at_.back(); }            ///< of the heap [m]
    const talus::LineFit& slope() const { return slope_; }  ///< height over distance [m]
    /// Pressure in the innermost ring over the largest: below 1 where there is a dip.
    double under_summit() const {
        return pressure_.front() / *std::max_element(pressure_.begin(), pressure_.end());
    }
    void print() const {
        std::printf("ring at [mm]   pressure [%s]   height [mm]\n", Dim == 2 ? "N/m" : "Pa");
        for (std::size_t k = 0; k < at_.size(); ++k)
            std::printf("%12.1f   %13.4g   %11.1f\n", 1e3 * at_[k], pressure_[k], 1e3 * height_[k]);
    }
    /// `rings.csv`.
    void write(const std::filesystem::path& folder) const {
        write_table(folder / "rings.csv",
                    {{"ring at [m]", at_},
                     {Dim == 2 ? "pressure [N/m]" : "pressure [Pa]", pressure_},
                     {"height [m]", height_}});
    }

  private:
    std::vector<double> at_, pressure_, height_;
    talus::LineFit slope_;
};

}  // namespace lab
