// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/cross.hpp>
#include <talus/core/input.hpp>
#include <talus/core/number_record.hpp>
#include <talus/geometry/aabb.hpp>
#include <talus/geometry/concepts.hpp>
#include <talus/spatial/pose.hpp>

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace talus {

/// Vertices, edges and faces of one shape are fewer than this, so that they fit a contact's code.
inline constexpr std::size_t max_feature_count = std::size_t{1} << 18;

/// An edge of a polyhedron: its ends, and the faces on its two sides seen from outside, looking
/// from tail to head (`none` for a segment).
struct CoreEdge {
    static constexpr std::uint32_t none = 0xffffffffu;
    std::uint32_t tail = 0, head = 0;
    std::uint32_t left = none, right = none;
};

/// The core of a convex shape, which is the set of points at most `radius` from it: a point (ball),
/// a segment (capsule), or a convex polygon or polyhedron. The narrow phase sees all of them thus.
/// A view: the arrays belong to the shape. In the plane the sides of a polygon are its faces and
/// `edges` is empty; a segment of the plane is a polygon of two sides, one of space has one edge
/// and no face.
template <int Dim>
requires SpaceDimension<Dim>
struct CoreView {
    std::span<const Vector<Dim>> vertices;      ///< [m]
    std::span<const Vector<Dim>> normals;       ///< of the faces, unit, outwards
    std::span<const double> offsets;            ///< face = { normal . x = offset } [m]
    std::span<const std::uint32_t> loop_begin;  ///< where the vertices of face i begin in `loops`
    std::span<const std::uint32_t> loops;       ///< vertices of the faces, counter-clockwise
    std::span<const std::uint32_t> loop_edges;  ///< edge from loops[k] to its successor (3D)
    std::span<const CoreEdge> edges;
    double radius;       ///< rounding [m]
    Vector<Dim> centre;  ///< of a ball that holds core and rounding [m]
    double bound;        ///< radius of that ball [m]
    double inner = 0.0;  ///< radius of a ball about `centre` inside the core, 0 if none is [m]
    double slack = 0.0;  ///< how far faces may be from what was meant: corners were rounded [m]

    std::size_t face_count() const { return normals.size(); }
    std::span<const std::uint32_t> face(std::size_t i) const {
        return loops.subspan(loop_begin[i], loop_begin[i + 1] - loop_begin[i]);
    }
};

/// Index of the core's vertex farthest along d; of several the first. O(vertices).
template <int Dim>
std::size_t support_index(const CoreView<Dim>& core, const Vector<Dim>& d) {
    std::size_t best = 0;
    double height = d.dot(core.vertices[0]);
    for (std::size_t i = 1; i < core.vertices.size(); ++i) {
        const double h = d.dot(core.vertices[i]);
        if (h > height) height = h, best = i;
    }
    return best;
}

/// Owner of a core with an inside or a segment; immutable, shared by the copies of a shape.
template <int Dim>
requires SpaceDimension<Dim>
class ConvexCore {
  public:
    /// The core with the given faces, each a loop of vertices counter-clockwise seen from outside;
    /// in space a pair of vertices without faces is a segment. `slack` [m] as in CoreView.
    ConvexCore(std::vector<Vector<Dim>> vertices,
               const std::vector<std::vector<std::uint32_t>>& faces, double radius,
               double slack = 0.0)
        : vertices_(std::move(vertices)), radius_(radius), slack_(slack) {
        if (vertices_.size() >= max_feature_count || 3 * faces.size() >= max_feature_count)
            detail::reject("vertex count", static_cast<double>(vertices_.size()),
                           "small enough for fewer than 2^18 vertices, edges and faces");
        loop_begin_.push_back(0);
        for (const auto& face : faces) {
            loops_.insert(loops_.end(), face.begin(), face.end());
            loop_begin_.push_back(static_cast<std::uint32_t>(loops_.size()));
            normals_.push_back(face_normal(face));
        }
        if constexpr (Dim == 3) find_edges(faces);
        measure();
    }

    CoreView<Dim> view() const {
        return {vertices_, normals_, offsets_, loop_begin_, loops_, loop_edges_,
                edges_,    radius_,  centre_,  bound_,      inner_, slack_};
    }
    /// The same core seen from the frame in which its present frame has this pose.
    ConvexCore placed(const Pose<Dim>& pose) const {
        ConvexCore result = *this;
        for (auto& v : result.vertices_) v = pose.point_world(v);
        for (auto& n : result.normals_) n = pose.rotation * n;
        result.measure();
        return result;
    }

    void write(NumberRecord& out) const {
        const auto vectors = [&](const std::vector<Vector<Dim>>& list) {
            out.integer(list.size());
            for (const Vector<Dim>& x : list) out.array(x);
        };
        const auto indices = [&](const std::vector<std::uint32_t>& list) {
            out.integer(list.size());
            for (const std::uint32_t i : list) out.integer(i);
        };
        vectors(vertices_);
        vectors(normals_);
        indices(loop_begin_);
        indices(loops_);
        indices(loop_edges_);
        out.integer(edges_.size());
        for (const CoreEdge& e : edges_)
            for (const std::uint32_t i : {e.tail, e.head, e.left, e.right}) out.integer(i);
        out.real(radius_);
        out.real(slack_);
    }
    static ConvexCore read(NumberRecordReader& in);

  private:
    ConvexCore() = default;
    void require_whole() const;

    /// Normal of a loop: exact direction of the side in 2D; in 3D the sum of the triangles'
    /// normals, which averages out the rounding of coplanar vertices.
    Vector<Dim> face_normal(const std::vector<std::uint32_t>& face) const {
        if constexpr (Dim == 2) {
            const Vector<2> side = vertices_[face[1]] - vertices_[face[0]];
            return Vector<2>(side[1], -side[0]).normalized();
        } else {
            Vector<3> sum = Vector<3>::Zero();
            const Vector<3> apex = vertices_[face[0]];
            for (std::size_t k = 1; k + 1 < face.size(); ++k)
                sum += (vertices_[face[k]] - apex).cross(vertices_[face[k + 1]] - apex);
            return sum.normalized();
        }
    }

    /// Edges in the order of their ends; every edge of a closed surface is met once each way.
    void find_edges(const std::vector<std::vector<std::uint32_t>>& faces) {
        if (faces.empty()) {
            edges_.push_back({0, 1, CoreEdge::none, CoreEdge::none});
            return;
        }
        struct Side {
            std::uint32_t low, high, tail, face, slot;
            auto operator<=>(const Side&) const = default;
        };
        std::vector<Side> sides;
        for (std::uint32_t f = 0; f < faces.size(); ++f)
            for (std::uint32_t k = 0; k < faces[f].size(); ++k) {
                const std::uint32_t tail = faces[f][k], head = faces[f][(k + 1) % faces[f].size()];
                sides.push_back(
                    {std::min(tail, head), std::max(tail, head), tail, f, loop_begin_[f] + k});
            }
        std::ranges::sort(sides);
        loop_edges_.resize(sides.size());
        for (std::size_t k = 0; k + 1 < sides.size(); k += 2) {
            loop_edges_[sides[k].slot] = loop_edges_[sides[k + 1].slot] =
                static_cast<std::uint32_t>(edges_.size());
            edges_.push_back({sides[k].low, sides[k].high, sides[k].face, sides[k + 1].face});
        }
    }

    void measure() {
        offsets_.resize(normals_.size());
        for (std::size_t f = 0; f < normals_.size(); ++f) {
            const std::span loop =
                std::span(loops_).subspan(loop_begin_[f], loop_begin_[f + 1] - loop_begin_[f]);
            double sum = 0.0;
            for (const std::uint32_t v : loop) sum += normals_[f].dot(vertices_[v]);
            offsets_[f] = sum / static_cast<double>(loop.size());
        }
        Aabb<Dim> box;
        for (const auto& v : vertices_) box.include(v);
        centre_ = 0.5 * (box.low + box.high);
        double reach2 = 0.0;
        for (const auto& v : vertices_) reach2 = std::max(reach2, (v - centre_).squaredNorm());
        bound_ = std::sqrt(reach2) + radius_;
        inner_ = normals_.empty() ? 0.0 : bound_;
        for (std::size_t f = 0; f < normals_.size(); ++f)
            inner_ = std::min(inner_, std::max(0.0, offsets_[f] - normals_[f].dot(centre_)));
    }

    std::vector<Vector<Dim>> vertices_, normals_;
    std::vector<double> offsets_;
    std::vector<std::uint32_t> loop_begin_, loops_, loop_edges_;
    std::vector<CoreEdge> edges_;
    double radius_ = 0.0, slack_ = 0.0;
    Vector<Dim> centre_ = Vector<Dim>::Zero();
    double bound_ = 0.0, inner_ = 0.0;
};

template <int Dim>
requires SpaceDimension<Dim> ConvexCore<Dim> ConvexCore<Dim>::read(NumberRecordReader& in) {
    const auto vectors = [&](std::vector<Vector<Dim>>& list) {
        list.resize(in.count(static_cast<std::size_t>(Dim), 0));
        for (Vector<Dim>& x : list) x = require_finite("number of a core", in.array<Vector<Dim>>());
    };
    const auto indices = [&](std::vector<std::uint32_t>& list) {
        list.resize(in.count(0, 1));
        for (std::uint32_t& i : list) i = in.integer<std::uint32_t>(0, CoreEdge::none);
    };
    ConvexCore core;
    vectors(core.vertices_);
    vectors(core.normals_);
    indices(core.loop_begin_);
    indices(core.loops_);
    indices(core.loop_edges_);
    core.edges_.resize(in.count(0, 4));
    for (CoreEdge& e : core.edges_)
        for (std::uint32_t* i : {&e.tail, &e.head, &e.left, &e.right})
            *i = in.integer<std::uint32_t>(0, CoreEdge::none);
    core.radius_ = require_non_negative("radius of a core", in.real());
    core.slack_ = require_non_negative("slack of a core", in.real());
    core.require_whole();
    core.measure();
    return core;
}

/// Throws input_error where an index leads out of its list.
template <int Dim>
requires SpaceDimension<Dim>
void ConvexCore<Dim>::require_whole() const {
    const auto require = [](bool whole) {
        if (!whole)
            throw input_error("vertices, edges and faces of a core do not fit together, but must");
    };
    const auto below = [](const std::vector<std::uint32_t>& list, std::size_t count) {
        return std::ranges::all_of(list, [count](std::uint32_t i) { return i < count; });
    };
    const std::size_t faces = normals_.size();
    for (const Vector<Dim>& n : normals_) require_unit("normal of a core", n.norm());
    require(!vertices_.empty() && loop_begin_.size() == faces + 1 && loop_begin_.front() == 0 &&
            loop_begin_.back() == loops_.size());
    for (std::size_t f = 0; f < faces; ++f)
        require(loop_begin_[f] <= loop_begin_[f + 1] && loop_begin_[f + 1] - loop_begin_[f] >= 2);
    require(below(loops_, vertices_.size()) && below(loop_edges_, edges_.size()));
    require(loop_edges_.size() == (Dim == 3 ? loops_.size() : 0));
    for (const CoreEdge& e : edges_) {
        require(e.tail < vertices_.size() && e.head < vertices_.size());
        require(faces == 0 || (e.left < faces && e.right < faces));
    }
}

/// A shape that is a rounded core: what the narrow phase treats by its vertices, edges and faces.
template <class S, int Dim>
concept CoreShape = requires(const S& s) {
    { s.core() } -> std::same_as<CoreView<Dim>>;  // lives as long as the shape
};

/// Exact bounds of a placed rounded core. O(vertices).
template <int Dim>
Aabb<Dim> core_aabb(const CoreView<Dim>& core, const Pose<Dim>& pose) {
    const Matrix<Dim> rotation = pose.rotation.matrix();
    Aabb<Dim> box;
    for (const auto& v : core.vertices) box.include(Vector<Dim>(rotation * v + pose.position));
    return box.expanded(core.radius);
}

/// Farthest point of a rounded core along d. O(vertices).
template <int Dim>
Vector<Dim> core_support(const CoreView<Dim>& core, const Vector<Dim>& d) {
    return core.vertices[support_index(core, d)] + core.radius * d.normalized();
}

/// Half the least width of a rounded core [m]: exact in the plane. In space it is the least along
/// the normals of the faces and the axes of the frame, which is no less than the width, and more
/// where that is between two edges. O(faces vertices), far less where the box is thin.
template <int Dim>
double core_half_thickness(const CoreView<Dim>& core) {
    if (core.face_count() == 0) return core.radius;
    const Aabb<Dim> box = core_aabb(core, Pose<Dim>{});
    double width = (box.high - box.low).minCoeff() - 2.0 * core.radius;
    for (std::size_t f = 0; f < core.face_count(); ++f) {
        double depth = 0.0;
        for (std::size_t i = 0; i < core.vertices.size() && depth < width; ++i)
            depth = std::max(depth, core.offsets[f] - core.normals[f].dot(core.vertices[i]));
        width = std::min(width, depth);
    }
    return 0.5 * width + core.radius;
}

/// Half the thickness of a shape at its thinnest part [m]: what it says by a member
/// `half_thickness()`, which must not be negative; of other rounded cores as above; of what tells
/// no more than its box half the least side of that, in the frame of the shape. Infinite for what
/// has no other side.
template <int Dim, Shape<Dim> S>
double half_thickness(const S& shape) {
    if constexpr (requires { shape.half_thickness(); }) {
        const double half = shape.half_thickness();
        if (!(half >= 0.0)) detail::reject("half thickness of the shape", half, "not negative");
        return half;
    } else if constexpr (CoreShape<S, Dim>) {
        return core_half_thickness<Dim>(shape.core());
    } else {
        const Aabb<Dim> box = shape.aabb(Pose<Dim>{});
        return 0.5 * (box.high - box.low).minCoeff();
    }
}

}  // namespace talus
