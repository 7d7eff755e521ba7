// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/measure/block_average.hpp>
#include <talus/measure/rings.hpp>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "../plot.hpp"
#include "../table.hpp"
#include "fits.hpp"

namespace lab {

/// Flows by opening with their errors, and Beverloo's law fitted to them.
template <int Dim>
class Beverloo {
  public:
    static constexpr double power = Dim - 0.5;

    /// A flow [kg/s] through an opening [diameters], which is printed.
    void add(double opening, const talus::BlockAverage& flow) {
        opening_.values.push_back(opening);
        mean_.values.push_back(flow.mean());
        error_.values.push_back(flow.error(8));
        std::printf("opening %5.2f d: %.4g +- %.2g kg/s\n", opening, mean_.values.back(),
                    error_.values.back());
        if (!(flow.mean() > 0.0)) return;  // blocked
        wide_.push_back(opening);
        found_.push_back(flow.mean());
        root_.push_back(std::pow(flow.mean(), 1.0 / power));
    }
    /// With the exponent fitted as well, for three openings or more.
    PowerFit free_fit() const { return fit_offset_power(wide_, found_, 1.0, 2.0); }
    std::size_t flowing() const { return wide_.size(); }
    /// `openings.csv`, `beverloo.svg`, and the law from three openings on; `unit` is that of its
    /// constant C, density sqrt(g) d^power [kg/s].
    void report(const std::filesystem::path& folder, double unit) const {
        write_table(folder / "openings.csv", {opening_, mean_, error_});
        Plot plot{"Flow out of a silo",
                  "opening [diameters]",
                  Dim == 2 ? "flow^(2/3) [(kg/s)^(2/3)]" : "flow^(2/5) [(kg/s)^(2/5)]",
                  {}};
        plot.curves = {{"measured", wide_, root_, true}, {"Beverloo, fitted", wide_, {}}};
        if (wide_.size() >= 3) {
            const talus::LineFit line = talus::fit_line(wide_, root_);
            const auto law = [&](double x) { return line.at_zero + line.slope * x; };
            const PowerFit free = free_fit();
            std::printf("exponent %.2f with k = %.2f (reference: %.1f +- %.1f, k from 1 to 2)\n",
                        free.exponent, free.offset, power, Dim == 2 ? 0.1 : 0.2);
            std::printf(
                "with the exponent %.1f: k = %.2f, C = %.2f (Beverloo: 1.4 and, in space, "
                "0.58), R^2 %.4f\n",
                power, -line.at_zero / line.slope, std::pow(line.slope, power) / unit,
                r_squared(wide_, root_, law));
            for (const double x : wide_) plot.curves[1].y.push_back(law(x));
        }
        write_plot(folder / "beverloo.svg", plot);
    }

  private:
    Column opening_{"opening [diameters]"}, mean_{"flow [kg/s]"}, error_{"error [kg/s]"};
    std::vector<double> wide_, found_, root_;  // root: of the flow, which grows as a line
};

}  // namespace lab
