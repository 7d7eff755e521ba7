// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/types.hpp>

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

    std::vector<Vector<3>> vertices;   ///< all different [m]
    std::vector<Triangle> triangles;   ///< three different vertices each
    std::size_t degenerate_count = 0;  ///< triangles left out since two of their corners were equal
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
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
            ++mesh_.degenerate_count;
        else
            mesh_.triangles.push_back(t);
    }
    Mesh take() { return std::move(mesh_); }

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
    std::unordered_map<Vector<3>, std::uint32_t, Hash> number_;
};

/// All bytes of a file, which must be one that can be read.
inline std::string file_content(const std::filesystem::path& path, const std::string& kind) {
    std::ifstream file(path, std::ios::binary);
    if (!file || !std::filesystem::is_regular_file(path))
        throw input_error(path.string() + ": the file cannot be read, but must be " + kind);
    return std::string(std::istreambuf_iterator<char>(file), {});
}

}  // namespace detail
}  // namespace talus
