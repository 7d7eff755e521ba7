// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/measure/cuts.hpp>
#include <talus/measure/rings.hpp>
#include <talus/measure/stress.hpp>
#include <talus/stepping/simulation.hpp>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "../table.hpp"

namespace lab {

/// Forces in a heap about the upright axis through the origin, after section 3.5 of Moreau's paper:
/// across a cylinder about the axis they go along the surface, so that the flank carries a part of
/// the core; across cuts along the surface, within the flank, they are vertical.
template <int Dim>
class HeapCuts {
  public:
    using V = talus::Vector<Dim>;

    /// `surface` is the height over the distance from the axis [m]; cuts along it lie at `distance`
    /// from the axis and `depth` below it, with half size `size` [m]. What is below `ground` [m],
    /// the floor's own contacts, does not count.
    HeapCuts(const talus::Simulation<Dim>& sim, const talus::LineFit& surface, double distance,
             double depth, double size, double ground)
        : sim_(sim), lean_(surface.angle()) {
        const auto& data = sim.data();
        talus::contact_forces<Dim>(data.problem.jacobian, data.impulse, data.h, forces_);
        const double height = surface.at_zero + surface.slope * distance;
        for (const V& out : directions()) {
            const V normal = std::sin(lean_) * out + std::cos(lean_) * up();
            const V centre = distance * out + (height - depth) * up();
            add(on_flank_, talus::FlatCut<Dim>(centre, normal, size), out);
        }
        if constexpr (Dim == 2) {
            const double half = 0.5 * surface.at_zero;
            for (const V& out : directions())
                add(on_core_, talus::FlatCut<2>(distance * out + (ground + half) * up(), out, half),
                    out);
        } else {
            const auto across =
                cut(talus::CylinderCut(V::Zero(), up(), distance, ground, surface.at_zero));
            on_core_ = {across.along_normals, across.force[2]};
        }
    }

    /// Of the force that the flank exerts on the core, to the horizontal, positive if it carries
    /// [rad]; NaN where there is none, as below.
    double angle_on_core() const { return angle(on_core_[1], -on_core_[0]); }
    /// Of it the part that is upwards [N].
    double carried() const { return on_core_[1]; }
    /// Of the force across cuts along the surface, from the vertical, positive outwards [rad].
    double angle_on_flank() const { return angle(on_flank_[0], -on_flank_[1]); }

    /// With the weight of the heap [N].
    void print(double weight) const {
        std::printf(
            "across a cylinder half as wide as the heap the force leans by %.0f degrees "
            "(along the surface: %.0f)\n    and carries %.3f of the weight; across cuts along "
            "the surface it is %.0f degrees from the vertical (0)\n",
            angle_on_core() * degree, lean_ * degree, carried() / weight,
            angle_on_flank() * degree);
    }
    std::vector<Finding> findings() const {
        return {
            {"slope", "degrees", lean_ * degree},
            {"force across a cylinder less slope", "degrees", (angle_on_core() - lean_) * degree},
            {"force across cuts along the surface from the vertical", "degrees",
             angle_on_flank() * degree}};
    }

  private:
    static constexpr double degree = 180.0 / std::numbers::pi;
    static double angle(double side, double along) {
        return side != 0.0 || along != 0.0 ? std::atan2(side, along)
                                           : std::numeric_limits<double>::quiet_NaN();
    }
    static V up() { return V::Unit(Dim - 1); }
    /// Away from the axis: in the plane to both sides, in space in twelve directions.
    static std::vector<V> directions() {
        std::vector<V> found;
        const int count = Dim == 2 ? 2 : 12;
        for (int k = 0; k < count; ++k) {
            const double turn = 2.0 * std::numbers::pi * k / count;
            V out = V::Zero();
            out[0] = std::cos(turn);
            if (Dim == 3) out[1] = std::sin(turn);
            found.push_back(out);
        }
        return found;
    }
    template <class Surface>
    talus::CutResultant<Dim> cut(const Surface& surface) const {
        return talus::cut_resultant<Dim>(sim_.system().bodies, sim_.data().problem.jacobian,
                                         std::span<const V>(forces_), surface);
    }
    /// Adds the force across a cut, outwards and upwards.
    template <class Surface>
    void add(talus::Vector<2>& sum, const Surface& surface, const V& out) const {
        const V force = cut(surface).force;
        sum += talus::Vector<2>(force.dot(out), force[Dim - 1]);
    }

    const talus::Simulation<Dim>& sim_;
    double lean_;  // [rad]
    std::vector<V> forces_;
    talus::Vector<2> on_core_ = talus::Vector<2>::Zero(), on_flank_ = talus::Vector<2>::Zero();
};

}  // namespace lab
