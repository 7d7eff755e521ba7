// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/types.hpp>
#include <talus/io/line_reader.hpp>

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <unordered_map>
#include <vector>

namespace talus {

/// A surface of triangles as files hold it: not necessarily closed, convex or of one piece. Files
/// do not tell the unit of length; it is taken for the metre.
struct Mesh {
    using Triangle = std::array<std::uint32_t, 3>;

    std::vector<Vector<3>> vertices;   ///< all different, each a corner of some face [m]
    std::vector<Triangle> triangles;   ///< three different vertices each
    std::size_t degenerate_count = 0;  ///< triangles left out since two of their corners were equal
    std::size_t unused_count = 0;      ///< vertices left out since no face names them
};

namespace detail {

inline constexpr double largest_coordinate = 1e12;  ///< of a mesh [m]

/// Gathers triangles, welding vertices of equal coordinates.
class MeshBuilder {
  public:
    std::uint32_t vertex(Vector<3> x) {
        for (double& c : x) c += 0.0;  // -0 is 0
        const auto [at, is_new] =
            number_.emplace(x, static_cast<std::uint32_t>(mesh_.vertices.size()));
        if (is_new) mesh_.vertices.push_back(x);
        return at->second;
    }
    void triangle(const Mesh::Triangle& t) {
        used_.resize(mesh_.vertices.size(), false);
        for (const std::uint32_t v : t) used_[v] = true;
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
            ++mesh_.degenerate_count;
        else
            mesh_.triangles.push_back(t);
    }
    /// What was gathered, without the vertices that no triangle names: points, curves and other
    /// leftovers of modellers, which would be corners of a hull.
    Mesh take() {
        used_.resize(mesh_.vertices.size(), false);
        std::vector<std::uint32_t> number(used_.size());
        std::uint32_t kept = 0;
        for (std::size_t v = 0; v < used_.size(); ++v) {
            if (!used_[v]) continue;
            mesh_.vertices[kept] = mesh_.vertices[v];
            number[v] = kept++;
        }
        mesh_.unused_count = used_.size() - kept;
        mesh_.vertices.resize(kept);
        for (Mesh::Triangle& t : mesh_.triangles)
            for (std::uint32_t& v : t) v = number[v];
        return std::move(mesh_);
    }
    /// The same of a file; throws input_error naming it if all of its triangles were left out.
    Mesh take_from(const std::string& file) {
        if (mesh_.triangles.empty())
            throw input_error(shown(file, 4096) + ": the file holds 0 triangles, as all " +
                              std::to_string(mesh_.degenerate_count) +
                              " have equal corners and were left out, but must hold at least one");
        return take();
    }

  private:
    struct Hash {
        std::size_t operator()(const Vector<3>& x) const {
            std::uint64_t h = 0;
            for (const double c : x) {
                std::uint64_t bits;
                std::memcpy(&bits, &c, sizeof bits);
                h = (h ^ (bits >> 29) ^ bits) * 0x9e3779b97f4a7c15u;
            }
            return static_cast<std::size_t>(h ^ (h >> 32));
        }
    };
    Mesh mesh_;
    std::vector<bool> used_;  // by vertex
    std::unordered_map<Vector<3>, std::uint32_t, Hash> number_;
};

/// All bytes of a file, which must be one that can be read.
inline std::string file_content(const std::filesystem::path& path, const std::string& kind) {
    std::ifstream file = open_file(path, kind);
    return std::string(std::istreambuf_iterator<char>(file), {});
}

}  // namespace detail
}  // namespace talus
