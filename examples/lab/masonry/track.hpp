// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/geometry/box.hpp>
#include <talus/stepping/simulation.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include "../run.hpp"
#include "rail.hpp"

namespace lab {

// A railway track in the plane, along axis 0, on grains between obstacles; up is axis 1.

/// How high the grains are that come nearer to x than `half` [m]; 0 where there is none.
inline double highest_grain(const talus::System<2>& system, double x, double half) {
    double top = 0.0;
    for (std::size_t i = 0; i < system.bodies.count(); ++i) {
        const auto& at = system.bodies.position[i];
        const double reach = system.bounding_radius()[i];
        if (!system.bodies.is_obstacle(i) && std::abs(at[0] - x) < half + reach)
            top = std::max(top, at[1] + reach);
    }
    return top;
}

/// Sleepers of concrete at these places, each `above` [m] the highest grain under it. They are the
/// last bodies. They go up and down alone: the rail, far stiffer than the bed, holds them level and
/// at their distance.
inline void lay_sleepers(talus::System<2>& system, const std::vector<double>& places,
                         double above) {
    const talus::Vector<2> half(0.15, 0.1);
    std::vector<double> tops;
    for (const double x : places) tops.push_back(highest_grain(system, x, half[0]));
    for (std::size_t k = 0; k < places.size(); ++k) {
        const auto sleeper =
            system.add(talus::Box<2>(half), 2400.0, {{places[k], tops[k] + half[1] + above}, {}});
        system.bodies.lock(sleeper, talus::LockedAxes<2>::all_but_translation(1));
    }
}

/// A plate of that half width [m], the last body, that goes up and down alone, on the bed under it.
inline void lay_plate(talus::System<2>& system, double half_width) {
    const talus::Vector<2> half(half_width, 0.05);
    const double top = highest_grain(system, 0.0, half_width);
    const auto plate = system.add(talus::Box<2>(half), 2400.0, {{0.0, top + half[1]}, {}});
    system.bodies.lock(plate, talus::LockedAxes<2>::all_but_translation(1));
}

/// A wheel on a rail about the origin: at its first end the load grows, from `begin` on; then it
/// runs to the other end, and back to the middle.
struct Wheel {
    double weight, speed;  ///< [N], [m/s]
    double half;           ///< of the rail's length [m]
    double begin;          ///< [s]
    double grown() const { return begin + 0.1; }
    double crossed() const { return grown() + 2.0 * half / speed; }  ///< at the other end
    double stops() const { return grown() + 3.0 * half / speed; }
    double load(double t) const {
        const double part = std::clamp((t - begin) / (grown() - begin), 0.0, 1.0);
        return weight * part * part * (3.0 - 2.0 * part);
    }
    double place(double t) const {
        const double way = std::clamp(speed * (t - grown()), 0.0, 3.0 * half);
        return half - std::abs(way - 2.0 * half);
    }
};

/// What a track is made of, and under what: a sixth of a real one, whose sleepers are 2.6 m long.
/// Rigid grains do not yield, so all of its elasticity stands in the pads.
struct TrackParams {
    double sleepers = 5, spacing = 0.6;  ///< how many, and how far apart [m]
    double bending = 1e6, pad = 5e6;     ///< of the rail and under it [N m^2], [N/m]
    double load = 8e3, speed = 6.0;      ///< of the wheel [N], [m/s]
    double pressure = 5e4, rest = 0.3;   ///< on the bed [N/m]; between two stages [s]
};

/// A track that is made in stages: a plate makes the bed level, sleepers take its place and are
/// pressed in, a rail is fastened to them, a wheel passes. Each stage is begun once, also by a run
/// that goes on from a checkpoint.
class Track {
  public:
    explicit Track(const TrackParams& params)
        : p_(params), places_(places_of(params)), rail_(places_, params.bending, params.pad) {}

    /// Begins a stage; when it will be over [s].
    double level(talus::System<2>& system) {
        if (begins(levelled_, system)) lay_plate(system, 0.499 * p_.sleepers * p_.spacing);
        return levelled_.time + p_.rest;
    }
    double lay(talus::System<2>& system, double above) {
        if (begins(laid_, system)) {
            system.remove(system.bodies.id.back());
            lay_sleepers(system, places_, above);
        }
        return laid_.time + p_.rest;
    }
    Wheel fasten(talus::System<2>& system) {
        if (begins(fastened_, system)) rail_.fasten(heights(system.bodies));
        return wheel();
    }
    /// Adds what presses at time t [s] on the plate, on the sleepers or on the rail.
    void press(double t, const talus::Bodies<2>& bodies,
               std::span<talus::Wrench<2>> wrenches) const {
        if (levelled_.time < t && t < laid_.time) {
            const double grown = std::min(1.0, 2.0 * (t - levelled_.time) / p_.rest);
            wrenches.back().force[1] -= grown * p_.pressure * p_.sleepers * p_.spacing;
        }
        if (!(laid_.time < t)) return;
        const auto sleepers = wrenches.last(count());
        if (!rail_.fastened()) {
            // As trains before did: sleepers are pressed in by what they will bear.
            const double part = std::clamp((t - laid_.time) / (0.7 * p_.rest), 0.0, 1.0);
            const double press = std::sin(std::numbers::pi * part);
            for (auto& wrench : sleepers) wrench.force[1] -= press * press * p_.load;
            return;
        }
        const auto force = rail_.forces(wheel().load(t), wheel().place(t), heights(bodies));
        for (std::size_t k = 0; k < count(); ++k) sleepers[k].force[1] += force[k];
    }

    std::size_t count() const { return places_.size(); }
    const std::vector<double>& places() const { return places_; }  ///< of sleepers, about 0 [m]
    const Rail& rail() const { return rail_; }
    /// Of the sleepers, which are the last bodies [m].
    std::vector<double> heights(const talus::Bodies<2>& bodies) const {
        std::vector<double> z;
        for (std::size_t i = bodies.count() - count(); i < bodies.count(); ++i)
            z.push_back(bodies.position[i][1]);
        return z;
    }
    /// Of the wheel's load, what a sleeper takes at a distance from it [m], after Zimmermann.
    double zimmermann(double distance) const {
        return zimmermann_share(distance, p_.spacing, p_.bending, p_.pad);
    }
    void carry(Run<2>& run) {
        run.carry("rail", rail_);
        run.carry("levelled", levelled_);
        run.carry("laid", laid_);
        run.carry("fastened", fastened_);
    }

  private:
    static std::vector<double> places_of(const TrackParams& p) {
        std::vector<double> places;
        for (double k = 0.0; k < p.sleepers; ++k)
            places.push_back((k - 0.5 * (p.sleepers - 1.0)) * p.spacing);
        return places;
    }
    static bool begins(Mark& stage, const talus::System<2>& system) {
        if (stage.time <= system.time()) return false;
        stage.time = system.time();
        return true;
    }
    Wheel wheel() const {
        return {p_.load, p_.speed, 0.5 * (p_.sleepers - 1.0) * p_.spacing, fastened_.time};
    }

    TrackParams p_;
    std::vector<double> places_;
    Rail rail_;
    Mark levelled_, laid_, fastened_;
};

}  // namespace lab
