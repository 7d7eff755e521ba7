// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/geometry/convex_polytope.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <vector>

/// Bodies with corners as files hold them, and what every hull must be.
namespace hull_tester {

using talus::Vector;

class Source {
  public:
    explicit Source(std::uint64_t seed) : engine_(seed) {}
    double uniform(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1.0p-53);
    }
    int integer(int low, int high) {
        return low + static_cast<int>(engine_() % static_cast<std::uint64_t>(high - low + 1));
    }
    talus::Rotation<3> rotation() {
        return talus::Rotation<3>::exp({uniform(-3, 3), uniform(-3, 3), uniform(-3, 3)});
    }

  private:
    std::mt19937_64 engine_;
};

/// Prism of n sides about the z axis: corner i of the lower end, corner n + i above it.
inline std::vector<Vector<3>> prism(int n, double radius, double height) {
    std::vector<Vector<3>> v;
    for (int s = 0; s < 2; ++s)
        for (int i = 0; i < n; ++i) {
            const double a = 2.0 * std::numbers::pi * i / n;
            v.emplace_back(radius * std::cos(a), radius * std::sin(a), (s - 0.5) * height);
        }
    return v;
}

inline std::vector<Vector<3>> turned(std::vector<Vector<3>> v, const talus::Rotation<3>& r) {
    for (auto& x : v) x = r * x;
    return v;
}

/// Coordinates rounded to multiples of `unit`, as far as that is positive.
template <int Dim>
std::vector<Vector<Dim>> rounded(std::vector<Vector<Dim>> v, double unit) {
    for (auto& x : v)
        for (double& c : x)
            if (unit > 0.0) c = std::round(c / unit) * unit;
    return v;
}

/// The surface is closed, obeys Euler's formula, and has no vertex above a face by more than the
/// tolerance, nor a corner so far below its own.
inline void check_polyhedron(const talus::ConvexPolytope<3>& shape, double tolerance) {
    const auto c = shape.core();
    std::set<std::pair<std::uint32_t, std::uint32_t>> sides;
    std::set<std::uint32_t> corners;
    for (std::size_t f = 0; f < c.face_count(); ++f) {
        const auto loop = c.face(f);
        BOOST_TEST_REQUIRE(loop.size() >= 3u);
        for (std::size_t k = 0; k < loop.size(); ++k) {
            corners.insert(loop[k]);
            BOOST_TEST_REQUIRE(sides.emplace(loop[k], loop[(k + 1) % loop.size()]).second);
            BOOST_TEST_REQUIRE(c.offsets[f] - c.normals[f].dot(c.vertices[loop[k]]) <= tolerance);
        }
        for (const auto& v : c.vertices)
            BOOST_TEST_REQUIRE(c.normals[f].dot(v) - c.offsets[f] <= tolerance);
    }
    for (const auto& [tail, head] : sides)
        BOOST_TEST_REQUIRE(sides.contains(std::pair(head, tail)));
    BOOST_TEST_REQUIRE(sides.size() == 2 * c.edges.size());
    BOOST_TEST_REQUIRE(corners.size() + c.face_count() == c.edges.size() + 2);
}

/// Faces as the sets of their corners.
inline std::set<std::set<std::uint32_t>> face_sets(const talus::ConvexPolytope<3>& shape) {
    std::set<std::set<std::uint32_t>> sets;
    for (std::size_t f = 0; f < shape.core().face_count(); ++f) {
        const auto loop = shape.core().face(f);
        sets.emplace(loop.begin(), loop.end());
    }
    return sets;
}

/// The same by brute force: planes through three points with all others below, to `flat`; and how
/// far the next point below a face's plane is from it, at least.
inline std::pair<std::set<std::set<std::uint32_t>>, double> brute_force_faces(
    const std::vector<Vector<3>>& v, double flat) {
    std::set<std::set<std::uint32_t>> sets;
    double clearance = 1e300;
    const auto n = static_cast<std::uint32_t>(v.size());
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < n; ++j)
            for (std::uint32_t k = j + 1; k < n; ++k) {
                if (i == j || i == k) continue;
                const Vector<3> normal = (v[j] - v[i]).cross(v[k] - v[i]);
                if (normal.norm() <= flat) continue;
                const Vector<3> up = (i < j ? 1.0 : -1.0) * normal.normalized();
                std::set<std::uint32_t> face;
                double highest = -1e300, next = 1e300;
                for (std::uint32_t m = 0; m < n; ++m) {
                    const double height = up.dot(v[m] - v[i]);
                    highest = std::max(highest, height);
                    if (height >= -flat)
                        face.insert(m);
                    else
                        next = std::min(next, -height);
                }
                if (highest > flat) continue;
                sets.insert(face);
                clearance = std::min(clearance, next);
            }
    return {sets, clearance};
}

}  // namespace hull_tester
