// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/sample/scene.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace talus {
namespace detail {

/// At most Dim + 1 points, and the nearest point of their hull to the origin.
template <int Dim>
struct Simplex {
    std::array<Vector<Dim>, Dim + 1> points;
    std::size_t count = 0;

    /// Nearest point to the origin of the hull of the points in the bit set `subset`, if it lies
    /// inside that face and not on its border.
    std::optional<Vector<Dim>> inside(unsigned subset) const {
        std::array<Vector<Dim>, Dim + 1> p;
        int m = 0;
        for (std::size_t i = 0; i < count; ++i)
            if (subset >> i & 1u) p[static_cast<std::size_t>(m++)] = points[i];
        using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, Dim, Dim>;
        using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, Dim, 1>;
        Small edges(Dim, m - 1);
        for (int i = 1; i < m; ++i) edges.col(i - 1) = p[static_cast<std::size_t>(i)] - p[0];
        if (m == 1) return p[0];
        const Small gram = edges.transpose() * edges;
        const Eigen::FullPivLU<Small> lu(gram);
        if (!lu.isInvertible()) return std::nullopt;
        const Column weight = lu.solve(Column(-edges.transpose() * p[0]));
        if ((weight.array() < 0.0).any() || weight.sum() > 1.0) return std::nullopt;
        return Vector<Dim>(p[0] + edges * weight);
    }

    /// Nearest point to the origin of the hull, and drops the points it does not need. All faces
    /// are tried: there are at most fifteen, and none can be missed.
    Vector<Dim> reduce() {
        unsigned best = 1;
        Vector<Dim> nearest = points[0];
        for (unsigned subset = 2; subset < 1u << count; ++subset)
            if (const auto v = inside(subset); v && v->squaredNorm() < nearest.squaredNorm()) {
                nearest = *v;
                best = subset;
            }
        std::size_t kept = 0;
        for (std::size_t i = 0; i < count; ++i)
            if (best >> i & 1u) points[kept++] = points[i];
        count = kept;
        return nearest;
    }
};

/// Farthest point of a grain along d, without the rounding of a ball; corners are drawn in by
/// `shrink`.
template <int Dim>
Vector<Dim> core_support(const Grain<Dim>& grain, const Vector<Dim>& d, double shrink) {
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
/// polygons and polyhedra the distance of [GilbertJohnsonKeerthi1988], every face of the simplex
/// tried, between the shapes drawn in by the tolerance.
template <int Dim>
bool overlap(const Grain<Dim>& a, const Grain<Dim>& b, double tolerance = 1e-6) {
    const double size = a.radius + b.radius;
    const double shrink = 1.0 - tolerance;
    if ((a.position - b.position).squaredNorm() >= shrink * shrink * size * size) return false;
    const double rounding = (a.is_ball() ? a.radius : 0.0) + (b.is_ball() ? b.radius : 0.0);
    const auto farthest = [&](const Vector<Dim>& d) -> Vector<Dim> {
        return detail::core_support<Dim>(a, d, shrink) -
               detail::core_support<Dim>(b, Vector<Dim>(-d), shrink);
    };
    detail::Simplex<Dim> simplex;
    simplex.points[0] = farthest(b.position - a.position);
    simplex.count = 1;
    // Corners are finite in number and the distance falls at each step; the bound is for rounding.
    for (int step = 0; step < 200; ++step) {
        const Vector<Dim> nearest = simplex.reduce();
        const double distance = nearest.norm();
        if (distance <= std::max(shrink * rounding, 1e-12 * size)) return true;
        if (simplex.count == Dim + 1) return true;
        const Vector<Dim> w = farthest(-nearest);
        const double plane = nearest.dot(w) / distance;  // no point of the difference lies nearer
        if (plane >= shrink * rounding && plane > 0.0) return false;
        if (distance - plane <= 1e-12 * size) return false;
        simplex.points[simplex.count++] = w;
    }
    return false;
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
