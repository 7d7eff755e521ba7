// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/dynamics/bodies.hpp>
#include <talus/dynamics/periodic_cell.hpp>
#include <talus/law/concepts.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>

namespace talus {

/// Share of body i in the gaps that a gap-anticipating step of size h [s] looks at: how far its
/// surface may travel in one step under its present velocity and twice `gained`, what loads add to
/// that in the step [m/s]; zero for an obstacle at rest [m]. Bodies that impulses make faster than
/// that meet new contacts as in the midpoint scheme.
template <int Dim>
[[gnu::noinline]] double anticipation_reach(const Bodies<Dim>& bodies, std::size_t i,
                                            double bounding_radius, double gained, double h) {
    const double spin = bodies.spin[i].norm();
    const double turning =
        spin > 0.0 && std::isfinite(bounding_radius) ? spin * bounding_radius : 0.0;
    return h * (bodies.velocity[i].norm() + turning + 2.0 * gained);
}

/// Whether there are bodies without bounds.
inline bool has_walls(std::span<const double> bounding_radius) {
    for (const double radius : bounding_radius)
        if (!std::isfinite(radius)) return true;
    return false;
}

/// The same where there may be a periodic cell, of which bodies and images follow the mean motion:
/// the body's own motion against that, and what deforms between its centre and another within that
/// reach. Walls, which have no images, are met by the velocity of the image at home, from which the
/// body is away by `from_home` [m].
template <int Dim>
[[gnu::noinline]] double anticipation_reach(const Bodies<Dim>& bodies, std::size_t i,
                                            double bounding_radius, double gained, double h,
                                            const std::optional<PeriodicCell<Dim>>& cell,
                                            bool walls, const Vector<Dim>& from_home) {
    const double plain = anticipation_reach(bodies, i, bounding_radius, gained, h);
    if (!cell || !std::isfinite(bounding_radius)) return plain;
    const auto at_speed_against = [&](const Vector<Dim>& velocity) {
        return plain + h * ((bodies.velocity[i] - velocity).norm() - bodies.velocity[i].norm());
    };
    const double strain = h * cell->velocity_gradient().norm();
    const double way =
        (at_speed_against(cell->velocity_at(bodies.position[i])) + strain * bounding_radius) /
        (1.0 - strain);
    return walls ? std::max(way, at_speed_against(cell->velocity_at(from_home))) : way;
}

/// What a gap adds to the normal velocity that the law sees: consecutive midpoints differ by h
/// u_end, so `g/h + u_n >= 0` keeps the next midpoint free of overlap to first order [m/s]. An
/// overlap adds nothing: it is not pushed out, so that no energy is made.
/// Of the planes that separate two bodies the motion tells which one to keep, the one that it
/// leaves last (collision/passage.hpp): the normal of the nearest points would stop a body also at
/// sides that it slides past, as at the edge of the next tile of a flush floor.
inline double anticipated_velocity(double gap, double h) { return std::max(gap, 0.0) / h; }

/// Whether a law bounces: its contacts are not anticipated, since stopping a body short of the
/// surface would take the velocity that restitution has to return.
template <int Dim, class Law>
bool bounces(const Law& law) {
    constexpr int rows = law_rows<Law, Dim>;
    if constexpr (RestitutionLaw<Law, rows>) {
        Vector<rows> approach = Vector<rows>::Zero();
        approach[0] = -1.0;
        return law.restitution_shift(approach)[0] != 0.0;
    } else {
        return false;
    }
}

namespace detail {

/// Pull of a law upon bodies that part at v, without any impulse yet, at an effective mass of 1
/// [N s].
template <int Dim, class Law>
double pull(const Law& law, double v) {
    constexpr int rows = law_rows<Law, Dim>;
    Vector<rows> parting = Vector<rows>::Zero();
    parting[0] = v;
    return -law.natural_map(parting, Vector<rows>::Zero(), 1.0)[0];
}

}  // namespace detail

/// Whether a law pulls bodies together that part: its contacts are not anticipated, since it would
/// reach across the gap.
template <int Dim, class Law>
bool attracts(const Law& law) {
    if constexpr (pushes_only<Law>) return false;
    return detail::pull<Dim>(law, 1.0) > 0.0;
}

/// Whether it does with any impulse that it takes, as a pin does.
template <int Dim, class Law>
bool holds_any_pull(const Law& law) {
    if constexpr (pushes_only<Law>) return false;
    constexpr double fast = 1e100;  // beyond any cohesion; its square is finite
    return detail::pull<Dim>(law, fast) >= 0.5 * fast;
}

}  // namespace talus
