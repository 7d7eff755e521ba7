// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "../numbers.hpp"
#include "../plot.hpp"
#include "../samples/fill.hpp"
#include "../samples/vessel.hpp"
#include "../table.hpp"
#include "fits.hpp"

namespace lab {

/// What is carried of the grains above each height, and Janssen's law fitted to it.
template <int Dim>
class Janssen {
  public:
    Janssen(const Fill<Dim>& fill, const ForceProfile<Dim>& profile, double gravity) : fill_(fill) {
        for (std::size_t k = 0; k < profile.count(); ++k) {
            height_.values.push_back(profile.height(k, fill) - fill.bottom);
            above_.values.push_back(profile.mass(k));
            carried_.values.push_back(profile.force(k) / gravity);
        }
        fit_ = fit_saturation(above_.values, carried_.values);
    }
    /// `mu` is the friction coefficient of the wall.
    void print(const Vessel<Dim>& vessel, double mu) const {
        std::printf("%.4g kg of grains; %.3f of them are carried below while the floor sinks\n",
                    fill_.mass, carried_.values[0] / fill_.mass);
        std::printf("m_inf %.4g +- %.2g kg, R^2 %.4f (reference: above 0.98)\n", fit_.limit,
                    fit_.error, fit_.r_squared);
        std::printf("Janssen's length %.2f widths, K = %.2f (reference: 0.4 to 1, Janssen 1895)\n",
                    length(vessel) / vessel.width, pressure_ratio(vessel, mu));
        std::printf("below 3 lengths what is carried is off m_inf by %.1f %% (reference: 10 %%)\n",
                    100.0 * off());
    }
    std::vector<Finding> findings(const Vessel<Dim>& vessel, double mu) const {
        return {{"carried by the floor", "weight", carried_.values[0] / fill_.mass},
                {"r squared of the saturation", "-", fit_.r_squared},
                {"ratio of pressures", "-", pressure_ratio(vessel, mu)},
                {"off the limit below 3 lengths", "-", off()}};
    }
    /// `profile.csv` and `janssen.svg`; `pouring` are, while grains came, in turn their mass and
    /// what the floor carried [kg].
    void write(const std::filesystem::path& folder, const Numbers& pouring) const {
        write_table(folder / "profile.csv", {height_, above_, carried_});
        Plot plot{"What is carried in a silo", "mass above [kg]", "mass carried [kg]", {}};
        plot.curves = {curve_of("Janssen, fitted", fit_, 0.0, fill_.mass),
                       {"while the floor sinks, by cuts", above_.values, carried_.values, true},
                       {"by the floor, while grains come", {}, {}, true}};
        for (std::size_t k = 0; k < pouring.values.size(); ++k)
            (k % 2 == 0 ? plot.curves[2].x : plot.curves[2].y).push_back(pouring.values[k]);
        write_plot(folder / "janssen.svg", plot);
    }

  private:
    double length(const Vessel<Dim>& vessel) const {
        return fit_.limit / (fill_.density * vessel.area());
    }
    /// Janssen's K, of the pressure on the wall to that on cuts.
    double pressure_ratio(const Vessel<Dim>& vessel, double mu) const {
        return vessel.width / (2.0 * (Dim - 1) * mu * length(vessel));
    }
    double off() const {
        double off = 0.0;
        for (std::size_t k = 0; k < carried_.values.size(); ++k)
            if (above_.values[k] > 3.0 * fit_.limit)
                off = std::max(off, std::abs(carried_.values[k] / fit_.limit - 1.0));
        return off;
    }
    Fill<Dim> fill_;
    Column height_{"height above the floor [m]"}, above_{"mass above [kg]"},
        carried_{"mass carried [kg]"};
    SaturationFit fit_;
};

}  // namespace lab
