// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/io/pile_drawing.hpp>
#include <talus/stepping/simulation.hpp>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace lab {

using Point = talus::Vector<2>;

/// What a picture shows of a simulation.
struct PictureParams {
    std::string title;
    std::vector<std::string> captions;
    std::pair<Point, Point> window{Point::Zero(), Point::Ones()};  ///< of the plane [m]
    double unit = 1.0;                                             ///< of forces [N]
    std::string unit_name = "N";
    std::vector<talus::DrawnLine> lines = {};  ///< over it; of the plane alone
    double strongest_width = 0.0;  ///< of a force, over the mean grain diameter; 0: as usual [-]
};

/// Forces in weights of grains of a mass [kg]; a window of the plane, in space of what is seen from
/// above [m].
inline PictureParams in_weights(const std::string& title, double mass, const Point& low,
                                const Point& high) {
    return {title, {}, {low, high}, 9.81 * mass, "mean weights"};
}

/// Mean force over the last step on each body, half the sum of the normal forces on it [N].
template <int Dim>
std::vector<double> loads(const talus::Simulation<Dim>& sim);

/// Writes the picture of the last step as SVG. In space: cut open, seen from one side; the window
/// is then of the two horizontal axes.
template <int Dim>
void write_picture(const std::filesystem::path& file, const talus::Simulation<Dim>& sim,
                   const PictureParams& params);

}  // namespace lab
