// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/geometry/box.hpp>
#include <talus/stepping/system.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace lab {

/// A tower of planks on the floor, laid in layers crosswise: those of even layers along axis 0. Its
/// planks are bodies one after another, from the lowest layer on.
class PlankTower {
  public:
    using V = talus::Vector<3>;

    /// `size` of a plank: its length, width and height [m].
    PlankTower(double layers, double planks, const V& size)
        : layers_(static_cast<int>(layers)), planks_(static_cast<int>(planks)), size_(size) {}

    void build(talus::System<3>& system, double density) {
        first_ = system.bodies.count();
        const talus::Box<3> plank(V(0.5 * size_));
        const double apart = (size_[0] - size_[1]) / (planks_ - 1.0);
        for (int layer = 0; layer < layers_; ++layer)
            for (int k = 0; k < planks_; ++k) {
                const bool crosswise = layer % 2 == 1;
                V at = V::Zero();
                at[crosswise ? 0 : 1] = (k - 0.5 * (planks_ - 1.0)) * apart;
                at[2] = (layer + 0.5) * size_[2];
                const V turn = crosswise ? V(0.0, 0.0, 0.5 * std::numbers::pi) : V(V::Zero());
                system.add(plank, density, {at, talus::Rotation<3>::exp(turn)});
                built_.push_back(at);
            }
    }
    /// The plank in the middle of a layer, counted from 1, or the one after.
    std::size_t middle_of(double layer) const {
        return first_ + static_cast<std::size_t>((layer - 1.0) * planks_ + planks_ / 2);
    }
    /// How far a plank is from where it was laid [m].
    V way(const talus::Bodies<3>& bodies, std::size_t plank) const {
        return bodies.position[plank] - built_[plank - first_];
    }
    /// The deepest that a plank has sunk, other than one [m].
    double sunk(const talus::Bodies<3>& bodies, std::size_t other) const {
        double most = 0.0;
        for (std::size_t i = first_; i < first_ + built_.size(); ++i)
            if (i != other) most = std::max(most, -way(bodies, i)[2]);
        return most;
    }

  private:
    int layers_, planks_;
    V size_;
    std::size_t first_ = 0;
    std::vector<V> built_;  // where [m]
};

}  // namespace lab
