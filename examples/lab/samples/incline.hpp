// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/feed/inlet.hpp>
#include <talus/geometry/box.hpp>
#include <talus/geometry/half_space.hpp>
#include <talus/stepping/simulation.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace lab {

/// An incline in the plane, uphill along axis 0 from the origin, rough by grains glued to it, with
/// a wall at its upper end and a plate, on which a bank can build up, at its foot.
class Incline {
  public:
    using V = talus::Vector<2>;

    /// Its length, the lean [rad], the mean diameter of grains and the length of the plate [m].
    Incline(double length, double lean, double diameter, double plate)
        : length_(length),
          d_(diameter),
          plate_(plate),
          up_hill_(std::cos(lean), std::sin(lean)),
          top_(length * up_hill_) {}

    void add_to(talus::System<2>& system, const talus::ShapeSource<2>& grain,
                std::uint64_t seed) const {
        system.add_obstacle(talus::Box<2>(V(0.5 * plate_, 0.5 * d_)),
                            {{V(-0.5 * plate_, -0.5 * d_), {}}});
        talus::Random random(seed);
        for (double along = 0.0; along < length_; along += 0.8 * d_)
            system.add_obstacle(grain(random),
                                {{V(along * up_hill_), talus::random_rotation<2>(random)}});
        system.add_obstacle(talus::HalfSpace<2>(V(-1.0, 0.0), -top_[0] - d_));
    }
    const V& top() const { return top_; }

    /// Where grains come, below the wall; a little above what has a contact that bears there.
    talus::Place<2> source(const talus::Simulation<2>& sim) const {
        return [this, &sim](talus::Random& random) {
            const double x = top_[0] - d_ * random.uniform(1.0, 5.0);
            return V(x, level(sim) + 2.5 * d_);
        };
    }
    /// What a picture shows of it.
    std::pair<V, V> window() const {
        return {V(-plate_ - 2.0 * d_, -3.0 * d_), V(top_[0], top_[1] + 10.0 * d_)};
    }

  private:
    double level(const talus::Simulation<2>& sim) const {
        double level = top_[1];
        const auto& data = sim.data();
        for (std::size_t c = 0; c < data.contact_count(); ++c)
            if (const V& x = data.contacts.point[c];
                data.impulse[c][0] > 0.0 && x[0] > top_[0] - 7.0 * d_)
                level = std::max(level, x[1]);
        return level;
    }

    double length_, d_, plate_;
    V up_hill_, top_;
};

}  // namespace lab
