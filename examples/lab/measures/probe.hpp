// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/symmetric_eigen.hpp>
#include <talus/measure/cuts.hpp>
#include <talus/measure/stress.hpp>
#include <talus/stepping/simulation.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "../picture.hpp"
#include "../plot.hpp"
#include "../table.hpp"

namespace lab {

/// A ball of a granulate, probed after a step as in section 3.4 of Moreau's paper: the mean stress
/// of its grains, and against it the forces across plane cuts through its centre.
template <int Dim>
class Probe {
  public:
    using V = talus::Vector<Dim>;

    Probe(const talus::Simulation<Dim>& sim, const V& centre, double radius)
        : sim_(sim), centre_(centre), radius_(radius) {
        const auto& data = sim.data();
        const auto& bodies = sim.system().bodies;
        talus::contact_forces<Dim>(data.problem.jacobian, data.impulse, data.h, forces_);
        std::vector<talus::Matrix<Dim>> moments;
        talus::internal_moments<Dim>(data.problem.jacobian, forces_, bodies.count(), moments);
        constexpr double unit = Dim == 2 ? std::numbers::pi : 4.0 / 3.0 * std::numbers::pi;
        const double volume = unit * std::pow(radius, Dim);
        for (std::size_t i = 0; i < bodies.count(); ++i)
            if (!bodies.is_obstacle(i) && (bodies.position[i] - centre).norm() < radius)
                stress_ += moments[i] / volume;
        stress_ = 0.5 * (stress_ + talus::Matrix<Dim>(stress_.transpose()));
    }

    /// Sum of the internal moments of the grains whose centres are inside, over its volume,
    /// symmetric; compression negative [N/m^(Dim-1)].
    const talus::Matrix<Dim>& stress() const { return stress_; }
    double pressure() const { return -stress_.trace() / Dim; }  ///< [N/m^(Dim-1)]
    /// Force across the cut through the centre with that normal, over its area.
    V traction(const V& normal) const {
        const talus::FlatCut<Dim> cut(centre_, normal, radius_);
        const auto& data = sim_.data();
        const auto across =
            talus::cut_resultant<Dim>(sim_.system().bodies, data.problem.jacobian,
                                      std::span<const V>(forces_.data(), forces_.size()), cut);
        return across.force / cut.area();
    }

  private:
    const talus::Simulation<Dim>& sim_;
    V centre_;
    double radius_;
    std::vector<V> forces_;
    talus::Matrix<Dim> stress_ = talus::Matrix<Dim>::Zero();
};

/// Normals of `count` cuts, evenly spread: over half a turn, or over half a sphere along a spiral
/// of equal areas.
template <int Dim>
std::vector<talus::Vector<Dim>> even_normals(int count) {
    std::vector<talus::Vector<Dim>> normals;
    for (int k = 0; k < count; ++k) {
        talus::Vector<Dim> n = talus::Vector<Dim>::Zero();
        const double share = (k + 0.5) / count;
        // The last axis is the height in space, the second of two in the plane.
        const double height = Dim == 2 ? std::sin(std::numbers::pi * share) : share;
        const double turn = Dim == 2 ? 0.0 : k * std::numbers::pi * (3.0 - std::sqrt(5.0));
        const double across =
            Dim == 2 ? std::cos(std::numbers::pi * share) : std::sqrt(1.0 - height * height);
        n[0] = across * std::cos(turn);
        n[1] = across * std::sin(turn);
        n[Dim - 1] = height;
        normals.push_back(n);
    }
    return normals;
}

/// The stress vectors across evenly spread cuts through a probe, measured and of its mean stress
/// (Moreau's Figure 3).
template <int Dim>
class CutStudy {
  public:
    CutStudy(const Probe<Dim>& probe, int count) : pressure_(probe.pressure()) {
        using V = talus::Vector<Dim>;
        for (const V& n : even_normals<Dim>(count)) {
            const V theory = probe.stress() * n, cut = probe.traction(n);
            const V t = V(V::Unit(0) - n[0] * n).normalized();  // towards the first axis
            const double angle = std::acos(n[0]) * 180.0 / std::numbers::pi;
            deviation_ += (cut - theory).squaredNorm() / count;
            mean_ += cut.dot(n) / count;
            rows_.push_back({angle, theory.dot(n), cut.dot(n), theory.dot(t), cut.dot(t)});
        }
        std::ranges::sort(rows_);
    }
    /// Root of the mean square of the differences, over the mean pressure.
    double deviation() const { return std::sqrt(deviation_) / pressure_; }
    /// Mean normal stress across the cuts, over that of the tensor.
    double mean() const { return -mean_ / pressure_; }

    /// `cuts.csv`, and `cuts.svg` in units of a pressure.
    void write(const std::filesystem::path& folder, double unit) const {
        const std::string unit_text = Dim == 2 ? " [N/m]" : " [Pa]";
        write_rows(folder / "cuts.csv",
                   {{"angle [degrees]"},
                    {"normal stress" + unit_text},
                    {"normal across cut" + unit_text},
                    {"tangential stress" + unit_text},
                    {"tangential across cut" + unit_text}},
                   rows_);
        Plot plot{"Stress vector across cuts",
                  "angle of the normal to the first axis [degrees]",
                  "over the pressure of the lids [-]",
                  {}};
        for (const char* name :
             {"tensor, normal", "cuts, normal", "tensor, tangential", "cuts, tangential"})
            plot.curves.push_back({name, {}, {}, name[0] == 'c'});
        for (const auto& row : rows_)
            for (std::size_t k = 0; k < plot.curves.size(); ++k) {
                plot.curves[k].x.push_back(row[0]);
                plot.curves[k].y.push_back(row[k + 1] / unit);
            }
        write_plot(folder / "cuts.svg", plot);
    }

  private:
    double pressure_, deviation_ = 0.0, mean_ = 0.0;
    std::vector<std::vector<double>> rows_;
};

/// A circle and the cross of the principal stresses, the largest as long as its radius.
inline std::vector<talus::DrawnLine> drawn_probe(const Point& centre, double radius,
                                                 const talus::Matrix<2>& stress) {
    std::vector<Point> circle;
    for (int k = 0; k <= 72; ++k) {
        const double angle = std::numbers::pi * k / 36.0;
        circle.push_back(centre + radius * Point(std::cos(angle), std::sin(angle)));
    }
    std::vector<talus::DrawnLine> lines{{circle}};
    const auto principal = talus::SymmetricEigen<2>(stress);
    const double largest = std::max(std::abs(principal.values[0]), std::abs(principal.values[1]));
    for (int k = 0; k < 2 && largest > 0.0; ++k) {
        const Point arm = radius * std::abs(principal.values[k]) / largest *
                          Point(principal.vectors(0, k), principal.vectors(1, k));
        lines.push_back({{centre - arm, centre + arm}});
    }
    return lines;
}

}  // namespace lab
