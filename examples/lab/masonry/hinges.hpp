// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/number_record.hpp>
#include <talus/stepping/system.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "../run.hpp"
#include "upright.hpp"

namespace lab {

/// When an arch fell, and by how much its joints were open then [rad], from the springing on the
/// right. To be carried along.
struct Fall {
    double time = Mark{}.time;  ///< [s]
    std::vector<double> joints;
    void write(talus::NumberRecord& out) const {
        out.real(time);
        out.integer(joints.size());
        for (const double angle : joints) out.real(angle);
    }
    static Fall read(talus::NumberRecordReader& in) {
        Fall fall{in.real(), std::vector<double>(in.count(1, 0))};
        for (double& angle : fall.joints) angle = in.real();
        return fall;
    }
};

/// Of all joints of a semicircular arch of n voussoirs, the bodies from `first` on, by how much
/// they are open [rad]: how the stones above and below have turned apart.
template <int Dim>
std::vector<double> open_joints(const talus::Bodies<Dim>& bodies, std::size_t first,
                                std::size_t n) {
    std::vector<double> open;
    double below = 0.0;
    for (std::size_t k = 0; k <= n; ++k) {
        const double built =
            std::numbers::pi * (static_cast<double>(k) + 0.5) / static_cast<double>(n);
        const double now =
            k < n ? upright_angle<Dim>(bodies.pose(first + k).rotation) - built : 0.0;
        open.push_back(now - below);
        below = now;
    }
    return open;
}

/// Where the hinges are: joints open by a fifth of the widest, in degrees from the right, with the
/// side at which they are shut.
inline std::string hinges(const std::vector<double>& open) {
    double widest = 0.0;
    for (const double angle : open) widest = std::max(widest, std::abs(angle));
    std::string text;
    for (std::size_t k = 0; k < open.size(); ++k) {
        if (std::abs(open[k]) < 0.2 * widest) continue;
        const double at = 180.0 * static_cast<double>(k) / static_cast<double>(open.size() - 1);
        text += talus::detail::text_of(at) + (open[k] > 0.0 ? " in, " : " out, ");
    }
    return text.substr(0, text.size() - 2);
}

}  // namespace lab
