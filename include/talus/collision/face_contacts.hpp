// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/core_pair.hpp>

#include <array>
#include <limits>

namespace talus {

/// Contacts of one face of A, the reference, with the side of B that looks at it: the corners of
/// their overlap as seen along the face's normal, each with its own gap. That is every vertex of B
/// over the face, every vertex of the face over B, and every crossing of their edges.
template <int Dim>
class FaceContacts {
  public:
    /// Contacts with a core gap up to `limit` [m] go to `sink`.
    FaceContacts(const CorePair<Dim>& pair, std::size_t face, double limit,
                 const ContactSink<Dim>& sink)
        : p_(pair),
          face_(static_cast<std::uint32_t>(face)),
          loop_(pair.a.face(face)),
          up_(pair.a.normals[face]),
          up_b_(pair.direction_in_b(up_)),
          tolerance_(NarrowPhaseTolerance::lateral * pair.size),
          limit_(limit),
          sink_(sink) {
        if constexpr (Dim == 3)
            for (std::size_t k = 0; k < std::min(loop_.size(), sides_.size()); ++k)
                sides_[k] = computed_side(k);
    }

    /// Adds the contacts; returns the least core gap met, infinite if nothing of B is over the
    /// face.
    double add() {
        // In either role the vertices of what the caller calls A come first, so that of two
        // vertices at one place the same one is kept.
        if (sink_.exchanged) {
            add_vertices_of_b();
            add_vertices_of_face();
        } else {
            add_vertices_of_face();
            add_vertices_of_b();
        }
        if constexpr (Dim == 3) add_crossings();
        return least_gap_;
    }

  private:
    /// A face of B looks at the reference if it is turned more than this against its normal.
    static constexpr double looking = 1e-3;

    double height(const Vector<Dim>& x) const { return up_.dot(x) - p_.a.offsets[face_]; }
    bool looks(std::size_t face_b) const { return p_.b.normals[face_b].dot(up_b_) < -looking; }

    /// `foot` lies in the reference face, B is `gap` above it.
    void add_point(const Vector<Dim>& foot, double gap, Feature a, Feature b) {
        const double reach = 4.0 * tolerance_;
        const double real_gap = gap - p_.rounding();
        const Vector<Dim> point = foot + (p_.a.radius + 0.5 * real_gap) * up_;
        least_gap_ = std::min(least_gap_, gap);
        if (gap <= limit_ && !sink_.occupied(point, reach)) sink_.add(point, -up_, real_gap, a, b);
    }

    /// Unit vector in the reference face, out of it across side k.
    Vector<3> out_of_side(std::size_t k) const requires(Dim == 3) {
        return k < sides_.size() ? sides_[k] : computed_side(k);
    }
    Vector<3> computed_side(std::size_t k) const requires(Dim == 3) {
        return (corner(k + 1) - corner(k)).cross(up_).normalized();
    }
    const Vector<Dim>& corner(std::size_t k) const {
        return p_.a.vertices[loop_[k < loop_.size() ? k : k - loop_.size()]];
    }
    bool over_face(const Vector<Dim>& x) const {
        if constexpr (Dim == 2) {
            const Vector<2> side = corner(1) - corner(0);
            const double length = side.norm(), along = (x - corner(0)).dot(side) / length;
            return along >= -tolerance_ && along <= length + tolerance_;
        } else {
            for (std::size_t k = 0; k < loop_.size(); ++k)
                if ((x - corner(k)).dot(out_of_side(k)) > tolerance_) return false;
            return true;
        }
    }

    /// Whether a vertex belongs to a face of B that looks at the reference.
    bool on_looking_side(const Vector<Dim>& vertex_b) const {
        if (p_.b.face_count() == 0) return true;
        for (std::size_t f = 0; f < p_.b.face_count(); ++f)
            if (looks(f) &&
                p_.b.offsets[f] - p_.b.normals[f].dot(vertex_b) <= tolerance_ + p_.b.slack)
                return true;
        return false;
    }
    void add_vertices_of_b() {
        const double base = up_.dot(p_.shift) - p_.a.offsets[face_];
        for (std::uint32_t i = 0; i < p_.b.vertices.size(); ++i) {
            const Vector<Dim>& v = p_.b.vertices[i];
            const double gap = up_b_.dot(v) + base;
            if (gap > limit_ && gap > least_gap_) continue;
            const Vector<Dim> x = p_.in_a(v);
            if (over_face(x) && on_looking_side(v))
                add_point(x - gap * up_, gap, {FeatureKind::face, face_}, {FeatureKind::vertex, i});
        }
    }

    /// Which face of B is met going up from x (frame of B), and at what height.
    struct Hit {
        std::uint32_t face = 0;
        double gap = std::numeric_limits<double>::infinity();
    };
    /// In the plane side by side: a segment has two sides but no ends.
    Hit hit(const Vector<2>& x) const requires(Dim == 2) {
        for (std::size_t f = 0; f < p_.b.face_count(); ++f) {
            if (!looks(f)) continue;
            const auto side = p_.b.face(f);
            const Vector<2> tail = p_.b.vertices[side[0]] - x, head = p_.b.vertices[side[1]] - x;
            const Vector<2> across(up_b_[1], -up_b_[0]);
            const double from = across.dot(tail), to = across.dot(head);
            if (std::min(from, to) > tolerance_ || std::max(from, to) < -tolerance_) continue;
            const double t = std::clamp(from / (from - to), 0.0, 1.0);
            return {static_cast<std::uint32_t>(f), up_b_.dot(tail + t * (head - tail))};
        }
        return {};
    }
    /// In space the line is clipped by all planes of B, pushed out by the tolerance.
    Hit hit(const Vector<3>& x) const requires(Dim == 3) {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        double enter = -infinity, leave = infinity;
        Hit best{0, -infinity};
        for (std::size_t f = 0; f < p_.b.face_count(); ++f) {
            const double slope = p_.b.normals[f].dot(up_b_);
            const double below = p_.b.offsets[f] - p_.b.normals[f].dot(x);
            if (std::abs(slope) < 1e-9) {
                if (below < -tolerance_) return {};
            } else if (slope > 0.0) {
                leave = std::min(leave, (below + tolerance_) / slope);
            } else {
                enter = std::max(enter, (below + tolerance_) / slope);
                if (below / slope > best.gap) best = {static_cast<std::uint32_t>(f), below / slope};
            }
        }
        return enter <= leave && best.gap > -infinity ? best : Hit{};
    }
    void add_vertices_of_face() {
        if (p_.b.face_count() == 0) return;
        for (const std::uint32_t i : loop_) {
            const Hit h = hit(p_.in_b(p_.a.vertices[i]));
            if (h.gap < std::numeric_limits<double>::infinity())
                add_point(p_.a.vertices[i], h.gap, {FeatureKind::vertex, i},
                          {FeatureKind::face, h.face});
        }
    }

    void add_crossings() requires(Dim == 3) {
        for (std::uint32_t j = 0; j < p_.b.edges.size(); ++j) {
            const CoreEdge& e = p_.b.edges[j];
            if (e.left != CoreEdge::none && !looks(e.left) && !looks(e.right)) continue;
            const Vector<3> tail = p_.in_a(p_.b.vertices[e.tail]);
            const Vector<3> head = p_.in_a(p_.b.vertices[e.head]);
            if (std::min(height(tail), height(head)) > limit_) continue;
            for (std::size_t k = 0; k < loop_.size(); ++k) add_crossing(k, j, tail, head);
        }
    }
    /// Side k of the face with edge j of B. Edges within the tolerance of each other do not cross:
    /// their ends are contacts already.
    void add_crossing(std::size_t k, std::uint32_t j, const Vector<3>& tail,
                      const Vector<3>& head) requires(Dim == 3) {
        const Vector<3> out = out_of_side(k);
        const double from = out.dot(tail - corner(k)), to = out.dot(head - corner(k));
        if (from * to >= 0.0 || std::max(std::abs(from), std::abs(to)) <= 4.0 * tolerance_) return;
        const Vector<3> x = tail + from / (from - to) * (head - tail);
        const Vector<3> side = corner(k + 1) - corner(k);
        const double length = side.norm(), along = (x - corner(k)).dot(side) / length;
        if (along < -tolerance_ || along > length + tolerance_) return;
        const double gap = height(x);
        add_point(x - gap * up_, gap,
                  {FeatureKind::edge, p_.a.loop_edges[p_.a.loop_begin[face_] + k]},
                  {FeatureKind::edge, j});
    }

    const CorePair<Dim>& p_;
    std::uint32_t face_;
    std::span<const std::uint32_t> loop_;
    Vector<Dim> up_, up_b_;  ///< normal of the reference face, in the frames of A and B
    std::array<Vector<Dim>, Dim == 3 ? 8 : 0> sides_;  ///< the first few, asked for often
    double tolerance_, limit_;
    const ContactSink<Dim>& sink_;
    double least_gap_ = std::numeric_limits<double>::infinity();
};

}  // namespace talus
