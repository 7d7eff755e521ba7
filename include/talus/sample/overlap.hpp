// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/gjk.hpp>
#include <talus/sample/scene.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace talus {
namespace detail {

/// Farthest point of a grain along d, without the rounding of a ball; corners are drawn in by
/// `shrink`.
template <int Dim>
Vector<Dim> grain_support(const Grain<Dim>& grain, const Vector<Dim>& d, double shrink) {
    Vector<Dim> best = Vector<Dim>::Zero();
    bool first = true;
    for (const auto& v : grain.vertices)
        if (first || v.dot(d) > best.dot(d)) {
            best = v;
            first = false;
        }
    return grain.position + shrink * best;
}

}  // namespace detail

/// Whether two grains overlap by more than `tolerance` times their size: exact for balls; for
/// polygons and polyhedra by the distance between the shapes drawn in by the tolerance.
template <int Dim>
bool overlap(const Grain<Dim>& a, const Grain<Dim>& b, double tolerance = 1e-6) {
    const double size = a.radius + b.radius;
    const double shrink = 1.0 - tolerance;
    const Vector<Dim> apart = a.position - b.position;
    if (apart.squaredNorm() >= shrink * shrink * size * size) return false;
    if (a.is_ball() && b.is_ball()) return true;
    const double rounding = (a.is_ball() ? a.radius : 0.0) + (b.is_ball() ? b.radius : 0.0);
    const auto support = [&](const Vector<Dim>& d) {
        return DifferencePoint<Dim>{detail::grain_support<Dim>(a, d, shrink),
                                    detail::grain_support<Dim>(b, Vector<Dim>(-d), shrink)};
    };
    const double distance = nearest_points<Dim>(support, apart, size).distance;
    return distance <= std::max(shrink * rounding, 1e-12 * size);
}

/// The first pair (a < b, in the order of b and then a) of overlapping grains. Grains are sorted
/// into cells of the largest diameter: O(n log n) for radii of comparable size.
template <int Dim>
std::optional<std::pair<std::size_t, std::size_t>> first_overlap(
    const std::vector<Grain<Dim>>& grains, double tolerance = 1e-6) {
    using Cell = std::array<std::int64_t, Dim>;
    double cell_size = 0.0;
    for (const auto& g : grains) cell_size = std::max(cell_size, 2.0 * g.radius);
    std::vector<std::pair<Cell, std::size_t>> sorted(grains.size());
    for (std::size_t m = 0; m < grains.size(); ++m) {
        for (std::size_t i = 0; i < Dim; ++i)
            sorted[m].first[i] = static_cast<std::int64_t>(
                std::floor(grains[m].position[static_cast<int>(i)] / cell_size));
        sorted[m].second = m;
    }
    std::sort(sorted.begin(), sorted.end());
    int rows = 1;  // neighbouring rows of cells along the last axis, 3^(Dim - 1)
    for (int i = 1; i < Dim; ++i) rows *= 3;
    std::optional<std::pair<std::size_t, std::size_t>> first;
    for (const auto& [cell, a] : sorted)
        for (int row = 0; row < rows; ++row) {
            Cell low = cell;
            for (int i = 0, code = row; i + 1 < Dim; ++i, code /= 3)
                low[static_cast<std::size_t>(i)] += code % 3 - 1;
            Cell high = low;
            --low[Dim - 1];
            ++high[Dim - 1];
            auto other =
                std::lower_bound(sorted.begin(), sorted.end(), std::pair(low, std::size_t{0}));
            for (; other != sorted.end() && other->first <= high; ++other) {
                const std::size_t b = other->second;
                if (b <= a || (first && std::pair(first->second, first->first) < std::pair(b, a)))
                    continue;
                if (overlap(grains[a], grains[b], tolerance)) first = {a, b};
            }
        }
    return first;
}

}  // namespace talus
