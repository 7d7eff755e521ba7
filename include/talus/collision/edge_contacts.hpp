// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/separating_axis.hpp>

#include <array>
#include <optional>

namespace talus {

/// Contacts of two cores that touch by vertices and edges, no face being across the axis: the one
/// place where they are nearest, or, of nearly parallel edges, both ends of their overlap.
template <int Dim>
class EdgeContacts {
  public:
    /// `axis` separates the cores best and has their nearest points; contacts with a core gap up to
    /// `limit` [m] go to `sink`.
    EdgeContacts(const CorePair<Dim>& pair, const SeparatingAxis<Dim>& axis, double limit,
                 const ContactSink<Dim>& sink)
        : p_(pair), axis_(axis), limit_(limit), sink_(sink) {}

    void add() {
        const Feature a = lowest_feature(p_.a, axis_.normal, axis_.point_a);
        const Feature b =
            lowest_feature(p_.b, p_.direction_in_b(-axis_.normal), p_.in_b(axis_.point_b));
        const double reach = 4.0 * NarrowPhaseTolerance::lateral * p_.size;
        if constexpr (Dim == 3) {
            const auto edge_a = parallel_edge(p_.a, axis_.normal, axis_.point_a);
            const auto edge_b =
                parallel_edge(p_.b, p_.direction_in_b(axis_.normal), p_.in_b(axis_.point_b));
            if (edge_a && edge_b) add_ends(*edge_a, *edge_b);
            if (least_gap_ <= axis_.separation + reach) return;
        }
        add_point(axis_.point_b, axis_.normal, axis_.separation, a, b);
    }

  private:
    void add_point(const Vector<Dim>& foot_b, const Vector<Dim>& normal, double core_gap, Feature a,
                   Feature b) {
        const double gap = core_gap - p_.rounding();
        const Vector<Dim> point = foot_b + (p_.b.radius + 0.5 * gap) * normal;
        least_gap_ = std::min(least_gap_, core_gap);
        if (core_gap <= limit_ &&
            !sink_.occupied(point, 4.0 * NarrowPhaseTolerance::lateral * p_.size))
            sink_.add(point, normal, gap, a, b);
    }

    /// The edge whose ends are both lowest along d and which passes nearest to x, else the vertex.
    Feature lowest_feature(const CoreView<Dim>& core, const Vector<Dim>& d,
                           const Vector<Dim>& x) const {
        const auto lowest = support_index<Dim>(core, -d);
        Feature best{FeatureKind::vertex, static_cast<std::uint32_t>(lowest)};
        const double bottom =
            d.dot(core.vertices[lowest]) + NarrowPhaseTolerance::preference * p_.size;
        const double near = NarrowPhaseTolerance::preference * p_.size;
        for (std::uint32_t i = 0; i < core.vertices.size(); ++i)
            if ((core.vertices[i] - x).norm() <= near) return {FeatureKind::vertex, i};
        double least = std::numeric_limits<double>::infinity();
        for (std::uint32_t i = 0; i < core.edges.size(); ++i) {
            const Vector<Dim>& tail = core.vertices[core.edges[i].tail];
            const Vector<Dim>& head = core.vertices[core.edges[i].head];
            if (d.dot(tail) > bottom || d.dot(head) > bottom) continue;
            const Vector<Dim> along = (head - tail).normalized();
            const double off = ((x - tail) - along.dot(x - tail) * along).norm();
            if (off < least) best = {FeatureKind::edge, i}, least = off;
        }
        return best;
    }

    /// The edge through x that is most nearly across n, if it is nearly enough.
    std::optional<std::uint32_t> parallel_edge(const CoreView<3>& core, const Vector<3>& n,
                                               const Vector<3>& x) const {
        double steepest = p_.rounding() > 0.0 ? NarrowPhaseTolerance::parallel_rounded
                                              : NarrowPhaseTolerance::preference;
        std::optional<std::uint32_t> best;
        for (std::uint32_t i = 0; i < core.edges.size(); ++i) {
            const Vector<3> tail = core.vertices[core.edges[i].tail];
            const Vector<3> along = (core.vertices[core.edges[i].head] - tail).normalized();
            const double off = (x - tail).cross(along).norm(), slope = std::abs(along.dot(n));
            if (off <= NarrowPhaseTolerance::preference * p_.size && slope <= steepest)
                best = i, steepest = slope;
        }
        return best;
    }

    /// An edge in the frame of A, running up along a common direction.
    struct Run {
        std::array<Vector<3>, 2> ends;
        std::array<std::uint32_t, 2> vertices;
        std::uint32_t edge;

        Vector<3> nearest(const Vector<3>& x) const {
            const Vector<3> along = ends[1] - ends[0];
            const double t = along.dot(x - ends[0]) / along.squaredNorm();
            return ends[0] + std::clamp(t, 0.0, 1.0) * along;
        }
        Feature vertex(std::size_t k) const { return {FeatureKind::vertex, vertices[k]}; }
        Feature whole() const { return {FeatureKind::edge, edge}; }
    };

    /// The two ends of the overlap of edges i of A and j of B, if they are parallel enough: each is
    /// an end of one of them, in doubt of A's, with the place on the other edge nearest to it.
    void add_ends(std::uint32_t i, std::uint32_t j) requires(Dim == 3) {
        const CoreEdge &ea = p_.a.edges[i], &eb = p_.b.edges[j];
        const Run a{{p_.a.vertices[ea.tail], p_.a.vertices[ea.head]}, {ea.tail, ea.head}, i};
        Run b{{p_.in_a(p_.b.vertices[eb.tail]), p_.in_a(p_.b.vertices[eb.head])},
              {eb.tail, eb.head},
              j};
        const Vector<3> u = (a.ends[1] - a.ends[0]).normalized();
        Vector<3> v = (b.ends[1] - b.ends[0]).normalized();
        const double most = p_.rounding() > 0.0 ? NarrowPhaseTolerance::parallel_rounded
                                                : NarrowPhaseTolerance::preference;
        if (u.cross(v).norm() > most) return;
        if (u.dot(v) < 0.0) {
            v = -v;
            std::swap(b.ends[0], b.ends[1]);
            std::swap(b.vertices[0], b.vertices[1]);
        }
        const Vector<3> up = u + v - (u + v).dot(axis_.normal) * axis_.normal;
        const double doubt = NarrowPhaseTolerance::preference * p_.size * up.norm();
        if (up.dot(a.ends[1] - b.ends[0]) < -doubt || up.dot(b.ends[1] - a.ends[0]) < -doubt)
            return;
        for (std::size_t k = 0; k < 2; ++k) {
            const double beyond = (k == 0 ? 1.0 : -1.0) * up.dot(b.ends[k] - a.ends[k]);
            if (beyond <= doubt)
                add_end(a.ends[k], b.nearest(a.ends[k]), a.vertex(k), b.whole());
            else
                add_end(a.nearest(b.ends[k]), b.ends[k], a.whole(), b.vertex(k));
        }
    }
    void add_end(const Vector<3>& on_a, const Vector<3>& on_b, Feature a, Feature b) {
        const Vector<3> apart = on_a - on_b;
        const double distance = apart.norm();
        // Crossing edges do not tell a side: the ends then are no better than the axis.
        if (p_.rounding() > 0.0 && distance > 1e-8 * p_.size && apart.dot(axis_.normal) > 0.0)
            add_point(on_b, apart / distance, distance, a, b);
        else
            add_point(on_b, axis_.normal, apart.dot(axis_.normal), a, b);
    }

    const CorePair<Dim>& p_;
    const SeparatingAxis<Dim>& axis_;
    double limit_;
    const ContactSink<Dim>& sink_;
    double least_gap_ = std::numeric_limits<double>::infinity();
};

}  // namespace talus
