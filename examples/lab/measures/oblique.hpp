// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/measure/axial_fabric.hpp>
#include <talus/measure/fabric.hpp>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "../plot.hpp"
#include "../table.hpp"

namespace lab {

/// What becomes of the contact normals of some samples: how often each direction is, against the
/// vertical one. The density of a sector has the standard error of its count.
template <int Dim>
class ObliqueStudy;

/// In the plane: 24 sectors, a fit up to order 4, left and right (Moreau's Figure 2).
template <>
class ObliqueStudy<2> {
  public:
    void begin(const std::string& name) {
        names_.push_back(name);
        histograms_.emplace_back(24);
    }
    void add(const talus::Vector<2>& normal) { histograms_.back().add_normal(normal); }

    /// Of the last one.
    void print() const {
        const talus::DirectionHistogram& h = histograms_.back();
        const double counted = 0.5 * h.total();
        if (counted < 1.0) return;
        std::printf("%s: %.0f points of contact; most frequent at", names_.back().c_str(), counted);
        for (const double peak : talus::fit_fabric(h).peaks())
            std::printf(" %.0f", peak * 180.0 / std::numbers::pi);
        const Counts c(h);
        std::printf(" degrees;\n    upright over oblique %.2f +- %.2f; right - left %.1f s.e.\n",
                    c.upright / c.oblique,
                    c.upright / c.oblique * std::sqrt(1.0 / c.upright + 1.0 / c.oblique),
                    c.asymmetry());
    }
    /// Of all.
    std::vector<Finding> findings() const {
        std::vector<Finding> found;
        for (std::size_t i = 0; i < names_.size(); ++i) {
            const Counts c(histograms_[i]);
            const std::string of = " of sample " + std::to_string(i);
            found.push_back({"oblique less upright" + of, "s.e.", c.preference()});
            found.push_back({"right less left" + of, "s.e.", c.asymmetry()});
        }
        return found;
    }
    void write(const std::filesystem::path& out) const {
        std::vector<Rose> roses;
        std::vector<Column> columns{{"angle [rad]"}};
        std::vector<std::vector<double>> rows(24);
        for (std::size_t k = 0; k < 24; ++k) rows[k] = {histograms_.at(0).middle(k)};
        for (std::size_t i = 0; i < names_.size(); ++i) {
            if (!(histograms_[i].total() > 0.0)) continue;
            roses.push_back({names_[i], histograms_[i], talus::fit_fabric(histograms_[i])});
            columns.push_back({"density of sample " + std::to_string(i) + " [1/rad]"});
            for (std::size_t k = 0; k < 24; ++k) rows[k].push_back(histograms_[i].density(k));
        }
        write_rows(out / "directions.csv", columns, rows);
        write_roses(out / "directions.svg", roses);
    }

  private:
    /// Of contacts in the two sectors that meet at the vertical, in the fullest pair of others that
    /// are as far to the left as to the right, and to both sides.
    struct Counts {
        double upright, oblique = 0.0, left = 0.0, right = 0.0;
        // Sectors 5 and 6 meet at the vertical.
        explicit Counts(const talus::DirectionHistogram& h) : upright(h.count(5) + h.count(6)) {
            for (std::size_t k = 0; k < 6; ++k) {
                right += h.count(k);
                left += h.count(11 - k);
                if (k < 5) oblique = std::max(oblique, h.count(k) + h.count(11 - k));
            }
        }
        double preference() const { return (oblique - upright) / std::sqrt(oblique + upright); }
        double asymmetry() const { return (right - left) / std::sqrt(right + left); }
    };
    std::vector<std::string> names_;
    std::vector<talus::DirectionHistogram> histograms_;
};

/// In space: bands of the angle to the vertical, by solid angle.
template <>
class ObliqueStudy<3> {
  public:
    void begin(const std::string& name) {
        names_.push_back(name);
        histograms_.emplace_back(talus::Vector<3>::UnitZ(), 9);
    }
    void add(const talus::Vector<3>& normal) { histograms_.back().add(normal); }

    void print() const {
        const talus::AxialHistogram& h = histograms_.back();
        if (h.total() < 1.0) return;
        const std::size_t most = densest(h);
        const double ratio = h.density(0) / h.density(most);
        std::printf(
            "%s: %.0f points of contact; most frequent at %.0f degrees from the vertical "
            "(fit %.0f);\n    upright over oblique %.2f +- %.2f\n",
            names_.back().c_str(), h.total(), h.middle(most) * 180.0 / std::numbers::pi,
            h.peak() * 180.0 / std::numbers::pi, ratio,
            ratio * std::sqrt(1.0 / std::max(h.count(0), 1.0) + 1.0 / h.count(most)));
    }
    std::vector<Finding> findings() const {
        std::vector<Finding> found;
        for (std::size_t i = 0; i < names_.size(); ++i) {
            const talus::AxialHistogram& h = histograms_[i];
            const std::size_t most = densest(h);
            const double error = std::sqrt(h.density(0) * h.density(0) / std::max(h.count(0), 1.0) +
                                           h.density(most) * h.density(most) / h.count(most));
            found.push_back({"oblique less upright of sample " + std::to_string(i), "s.e.",
                             (h.density(most) - h.density(0)) / error});
        }
        return found;
    }
    void write(const std::filesystem::path& out) const {
        Plot plot{"Density of contact normals by their angle to the vertical",
                  "angle [degrees]",
                  "over that of even directions [-]",
                  {}};
        std::vector<Column> columns{{"angle [rad]"}};
        std::vector<std::vector<double>> rows(histograms_.at(0).bands());
        for (std::size_t k = 0; k < rows.size(); ++k) rows[k] = {histograms_[0].middle(k)};
        for (std::size_t i = 0; i < names_.size(); ++i) {
            Curve curve{names_[i], {}, {}};
            for (std::size_t k = 0; k < rows.size(); ++k) {
                const double density = histograms_[i].density(k);
                rows[k].push_back(density);
                curve.x.push_back(histograms_[i].middle(k) * 180.0 / std::numbers::pi);
                curve.y.push_back(2.0 * std::numbers::pi * density);
            }
            columns.push_back({"density of sample " + std::to_string(i) + " [1/sr]"});
            plot.curves.push_back(curve);
        }
        write_rows(out / "directions.csv", columns, rows);
        write_plot(out / "directions.svg", plot);
    }

  private:
    static std::size_t densest(const talus::AxialHistogram& h) {
        std::size_t most = 0;
        for (std::size_t k = 0; k < h.bands(); ++k)
            if (h.density(k) > h.density(most)) most = k;
        return most;
    }
    std::vector<std::string> names_;
    std::vector<talus::AxialHistogram> histograms_;
};

}  // namespace lab
