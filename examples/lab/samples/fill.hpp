// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/measure/cuts.hpp>
#include <talus/measure/stress.hpp>
#include <talus/stepping/simulation.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace lab {

/// What fills an upright vessel, above the height `bottom` [m]; up is the last axis.
template <int Dim>
struct Fill {
    double mass = 0.0;     ///< [kg]
    double bottom;         ///< [m]
    double top;            ///< of the highest grain; `bottom` where there is none [m]
    double density = 0.0;  ///< of the part from 0.1 to 0.8 of the height, with its voids [kg/m^Dim]

    /// `area` is that of the vessel's cross-section [m^(Dim-1)].
    Fill(const talus::System<Dim>& system, double bottom_, double area)
        : bottom(bottom_), top(bottom_) {
        const auto height = [&](std::size_t i) { return system.bodies.position[i][Dim - 1]; };
        const auto counts = [&](std::size_t i) {
            return !system.bodies.is_obstacle(i) && height(i) > bottom;
        };
        for (std::size_t i = 0; i < system.bodies.count(); ++i) {
            if (!counts(i)) continue;
            mass += system.bodies.mass(i);
            top = std::max(top, height(i) + system.bounding_radius()[i]);
        }
        const double low = 0.9 * bottom + 0.1 * top, high = 0.2 * bottom + 0.8 * top;
        for (std::size_t i = 0; i < system.bodies.count(); ++i)
            if (counts(i) && height(i) >= low && height(i) < high)
                density += system.bodies.mass(i) / (area * (high - low));
    }
};

/// The force that grains above a height put on what is below, and their mass, at `count` heights
/// from the bottom to the top of what fills a vessel, mean over the steps recorded. To be carried
/// along.
template <int Dim>
class ForceProfile {
  public:
    explicit ForceProfile(std::size_t count) : force_(count, 0.0), mass_(count, 0.0) {}

    /// The lowest is within the lowest grains: a cut through the contacts with a floor is
    /// undecided.
    double height(std::size_t k, const Fill<Dim>& fill) const {
        const double share = (static_cast<double>(k) + 0.5) / static_cast<double>(force_.size());
        return fill.bottom + share * (fill.top - fill.bottom);
    }
    /// After a step, before bodies are taken out. O(contacts) for each height.
    void record(const talus::Simulation<Dim>& sim, const Fill<Dim>& fill) {
        using V = talus::Vector<Dim>;
        const auto& data = sim.data();
        std::vector<V> forces;
        talus::contact_forces<Dim>(data.problem.jacobian, data.impulse, data.h, forces);
        for (std::size_t k = 0; k < force_.size(); ++k) {
            const talus::FlatCut<Dim> cut(V(height(k, fill) * V::Unit(Dim - 1)), V::Unit(Dim - 1));
            force_[k] -=
                talus::cut_resultant<Dim>(sim.system().bodies, data.problem.jacobian, forces, cut)
                    .force[Dim - 1];
        }
        const auto& bodies = sim.system().bodies;
        for (std::size_t i = 0; i < bodies.count(); ++i)
            for (std::size_t k = 0; k < mass_.size(); ++k)
                if (!bodies.is_obstacle(i) && bodies.position[i][Dim - 1] > height(k, fill))
                    mass_[k] += bodies.mass(i);
        records_ += 1.0;
    }
    std::size_t count() const { return force_.size(); }
    /// Downwards [N]; 0 without records.
    double force(std::size_t k) const { return records_ > 0.0 ? force_[k] / records_ : 0.0; }
    /// Of the grains whose centres are above [kg].
    double mass(std::size_t k) const { return records_ > 0.0 ? mass_[k] / records_ : 0.0; }

    void write(talus::NumberRecord& out) const {
        out.real(records_);
        for (const auto* sum : {&force_, &mass_})
            for (const double x : *sum) out.real(x);
    }
    void restore(const talus::NumberRecord& record) {
        talus::NumberRecordReader in(record);
        ForceProfile other(force_.size());
        other.records_ = in.real();
        for (auto* sum : {&other.force_, &other.mass_})
            for (double& x : *sum) x = in.real();
        in.require_end();
        *this = other;
    }

  private:
    std::vector<double> force_, mass_;  // summed over records
    double records_ = 0.0;
};

}  // namespace lab
