// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/measure/force_statistics.hpp>
#include <talus/measure/rings.hpp>

#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "../samples/packing.hpp"
#include "../table.hpp"

namespace lab {

/// Packings of one kind with grains of several sizes in the same box, the finest last. Walls take
/// room of the size of grains, so that the solid fraction far from them is found where the size
/// goes to zero.
class PackingStudy {
  public:
    PackingStudy(int dim, double mu)
        : dim_(dim),
          mu_(mu),
          kind_(std::to_string(dim) + (mu > 0.0 ? "d with friction: " : "d without: ")) {}

    void add(double size, const Packing& p) {
        std::printf(
            "%dD, mu %g, %g grains: solid fraction %.3f, %.2f contacts a grain; bearing "
            "contacts %g, degrees of freedom %g\n",
            dim_, mu_, p.grains, p.solid, p.coordination(), p.contacts, p.freedom);
        size_.push_back(size);
        solid_.push_back(p.solid);
        rows_.push_back({static_cast<double>(dim_), mu_, size, p.grains, p.solid, p.coordination(),
                         p.contacts, p.freedom});
        finest_ = p;
    }
    void print() const {
        const char* expected[2][2] = {{"0.84", "0.79 to 0.82"}, {"0.64", "0.59 to 0.61"}};
        const auto forces = talus::force_statistics(finest_.normal_forces);
        std::printf(
            "    far from walls the solid fraction would be %.3f (%s); %.0f %% of the normal "
            "forces "
            "are\n    below their mean, above it they fall with exp(-%.2f f / mean)\n",
            talus::fit_line(size_, solid_).at_zero, expected[dim_ - 2][mu_ > 0.0 ? 1 : 0],
            100.0 * forces.share_below_mean, forces.decay);
    }
    void append_findings(std::vector<Finding>& found) const {
        const auto forces = talus::force_statistics(finest_.normal_forces);
        found.push_back(
            {kind_ + "solid fraction far from walls", "-", talus::fit_line(size_, solid_).at_zero});
        found.push_back({kind_ + "contacts a grain", "-", finest_.coordination()});
        found.push_back(
            {kind_ + "contacts less degrees of freedom", "-", finest_.contacts - finest_.freedom});
        found.push_back({kind_ + "normal forces below the mean", "-", forces.share_below_mean});
        found.push_back({kind_ + "decay of normal forces", "-", forces.decay});
    }
    void append_rows(std::vector<std::vector<double>>& rows) const {
        rows.insert(rows.end(), rows_.begin(), rows_.end());
    }

  private:
    int dim_;
    double mu_;
    std::string kind_;
    std::vector<double> size_, solid_;
    std::vector<std::vector<double>> rows_;
    Packing finest_;
};

/// `packings.csv` and `findings.csv` of several.
inline void write_packings(const std::filesystem::path& folder,
                           const std::vector<PackingStudy>& studies) {
    std::vector<std::vector<double>> rows;
    std::vector<Finding> found;
    for (const PackingStudy& study : studies) {
        study.append_rows(rows);
        study.append_findings(found);
    }
    write_rows(folder / "packings.csv",
               {{"dimension [-]"},
                {"mu [-]"},
                {"size [-]"},
                {"grains [-]"},
                {"solid fraction [-]"},
                {"contacts a grain [-]"},
                {"bearing contacts [-]"},
                {"degrees of freedom [-]"}},
               rows);
    write_findings(folder, found);
}

}  // namespace lab
