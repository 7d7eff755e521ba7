// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/geometry/box.hpp>
#include <talus/geometry/capsule.hpp>
#include <talus/stepping/system.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "upright.hpp"

namespace lab {

/// A house of cards in the plane: storeys of pairs that lean on each other, one pair fewer in each,
/// and a flat card over each storey but the last. Cards have round ends of radius r, in the middle
/// of which the length l between them begins and ends; neighbours are apart, so that their feet can
/// slip.
class CardHouse {
  public:
    /// Of a card the length, thickness [m] and lean from the upright [rad]; the gap between
    /// neighbours [m].
    CardHouse(double storeys, double length, double thickness, double lean, double gap)
        : storeys_(static_cast<int>(storeys)),
          r_(0.5 * thickness),
          l_(length - thickness),
          lean_(lean),
          gap_(gap) {}

    static constexpr double g = 9.81, density = 800.0;  ///< [m/s^2], [kg/m^2]
    double weight() const {                             ///< of a card [N]
        return g * density * (2.0 * r_ * l_ + std::numbers::pi * r_ * r_);
    }

    /// Friction that the lowest storey needs if loads go down evenly, from each foot to the pair
    /// below it. A pair that carries P stands like two ladders: moments about a foot give the
    /// thrust T = l sin a (w/2 + P/2) / (l cos a + r) that the two exchange at the top and the
    /// ground returns, and the foot presses by w + P/2. (A force sideways at the top would relieve
    /// one foot and ask more of the other.) To the thickness of a card this is what one or two
    /// storeys need; three or more can do with a little less, as their outer pairs can carry more.
    double needed_friction() const {
        // On the tops of a storey's pairs, the last storey first [N].
        std::vector<double> load{0.0};
        for (int pairs = 2; pairs <= storeys_; ++pairs) {
            const double flat = flat_weight(pairs) / (pairs - 1);  // of each span
            std::vector<double> below(static_cast<std::size_t>(pairs), 0.0);
            for (std::size_t k = 0; k < load.size(); ++k)
                for (std::size_t side = 0; side < 2; ++side)
                    below[k + side] += 0.5 * load[k] + weight() + 0.5 * flat;
            load = below;
        }
        const double most = 0.5 * *std::max_element(load.begin(), load.end()) / weight();
        return l_ * std::sin(lean_) / (l_ * std::cos(lean_) + r_) * (0.5 + most) / (1.0 + most);
    }

    /// Adds its cards, the last one of those at the top, about a middle [m] on the floor.
    void build(talus::System<2>& system, double middle, talus::MaterialIndex material) const {
        const talus::Capsule<2> shape(0.5 * l_, r_);
        double floor = 0.0;
        for (int pairs = storeys_; pairs >= 1; --pairs) {
            const double z = floor + r_ + 0.5 * l_ * std::cos(lean_);
            for (int k = 0; k < pairs; ++k)
                for (const double side : {-1.0, 1.0}) {
                    const double top = middle + (k - 0.5 * (pairs - 1)) * pitch();
                    const double x = top + side * (r_ + 0.5 * l_ * std::sin(lean_));
                    const double angle = 0.5 * std::numbers::pi + side * lean_;
                    system.add(shape, density, upright_pose<2>(x, z, angle), {}, material);
                }
            if (pairs > 1)
                system.add(talus::Box<2>({flat_half(pairs), r_}), density,
                           upright_pose<2>(middle, floor + storey() - r_), {}, material);
            floor += storey();
        }
    }

  private:
    double across() const {  // between the feet of a pair
        return 2.0 * (l_ * std::sin(lean_) + r_);
    }
    double pitch() const { return across() + gap_; }
    double storey() const { return l_ * std::cos(lean_) + 4.0 * r_; }  // with the flat card on it
    double flat_half(int pairs) const { return 0.5 * (pairs - 1) * pitch() + 20.0 * r_; }
    double flat_weight(int pairs) const { return g * density * 4.0 * r_ * flat_half(pairs); }

    int storeys_;
    double r_, l_, lean_, gap_;
};

}  // namespace lab
