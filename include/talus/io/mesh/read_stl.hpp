// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/io/line_reader.hpp>
#include <talus/io/mesh/mesh.hpp>

#include <algorithm>
#include <bit>
#include <sstream>
#include <string_view>

namespace talus {
namespace detail {

inline constexpr std::size_t stl_header_bytes = 84, stl_triangle_bytes = 50;
inline constexpr std::array axis_names{"x", "y", "z"};

inline std::uint32_t little_endian(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;)
        value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
}

/// Whether the bytes are as many as the count in the header of a binary file asks for.
inline bool is_binary_stl(std::string_view bytes) {
    return bytes.size() >= stl_header_bytes &&
           bytes.size() ==
               stl_header_bytes + std::uint64_t{stl_triangle_bytes} * little_endian(bytes, 80);
}

inline Mesh parse_binary_stl(std::string_view bytes, const std::string& file) {
    MeshBuilder mesh;
    for (std::size_t at = stl_header_bytes, t = 1; at < bytes.size();
         at += stl_triangle_bytes, ++t) {
        Mesh::Triangle triangle{};
        for (std::size_t v = 0; v < 3; ++v) {
            Vector<3> x;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t byte = at + 12 * (v + 1) + 4 * k;  // the normal comes first
                const float value = std::bit_cast<float>(little_endian(bytes, byte));
                x[static_cast<int>(k)] =
                    require_in(shown(file, 4096) + ", byte " + std::to_string(byte) +
                                   ": triangle " + std::to_string(t) + ": vertex " +
                                   std::to_string(v + 1) + " " + axis_names[k] + " [m]",
                               static_cast<double>(value), -largest_coordinate, largest_coordinate);
            }
            triangle[v] = mesh.vertex(x);
        }
        mesh.triangle(triangle);
    }
    return mesh.take_from(file);
}

/// Words of STL files, which may be written in capitals.
class StlWords {
  public:
    explicit StlWords(LineReader& in) : in_(in) {}

    std::string word(std::string_view item) {
        std::string w = in_.word(item);
        std::ranges::transform(w, w.begin(), [](char c) {
            return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
        });
        return w;
    }
    /// The next word, on the next line if this one is used up.
    void expect(std::string_view key) {
        if (in_.words_left() == 0 && !in_.next_words())
            in_.fail("the file", "ends, but must hold '" + std::string(key) + "' here");
        const std::string found = word(key);
        if (found != key)
            in_.fail("a key", "is '" + shown(found) + "', but must be '" + std::string(key) + "'");
    }

  private:
    LineReader& in_;
};

inline Mesh parse_text_stl(std::istream& text, const std::string& file) {
    LineReader in(text, file);
    StlWords words(in);
    MeshBuilder mesh;
    std::size_t t = 0;
    bool in_solid = false;
    while (in.next_words()) {
        const std::string key = words.word("a key");
        if (!in_solid && key == "solid") {  // a name follows
            in_solid = true;
            continue;
        }
        if (in_solid && key == "endsolid") {
            in_solid = false;
            continue;
        }
        if (!in_solid || key != "facet")
            in.fail("a key", "is '" + shown(key) + "', but must be " +
                                 (in_solid ? "'facet' or 'endsolid'" : "'solid'"));
        const std::string name = "triangle " + std::to_string(++t);
        words.expect("normal");  // not read: the order of the corners tells it
        for (int k = 0; k < 3; ++k) in.word(name + ": normal");
        in.expect_end_of_line();
        words.expect("outer");
        words.expect("loop");
        in.expect_end_of_line();
        Mesh::Triangle triangle{};
        for (std::size_t v = 0; v < 3; ++v) {
            words.expect("vertex");
            Vector<3> x;
            for (std::size_t k = 0; k < 3; ++k)
                x[static_cast<int>(k)] = in.number(
                    name + ": vertex " + std::to_string(v + 1) + " " + axis_names[k] + " [m]",
                    -largest_coordinate, largest_coordinate);
            in.expect_end_of_line();
            triangle[v] = mesh.vertex(x);
        }
        words.expect("endloop");
        words.expect("endfacet");
        in.expect_end_of_line();
        mesh.triangle(triangle);
    }
    if (in_solid) in.fail("the file", "ends, but must hold 'endsolid' here");
    if (t == 0) in.fail("the file", "holds no triangle, but must hold at least one");
    return mesh.take_from(file);
}

}  // namespace detail

/// Reads a mesh from the bytes of an STL file, binary or text; `file` is the name that complaints
/// begin with. Normals, colours and names are not read. Throws input_error, one sentence with line
/// or byte, when anything is not as it should be; and one with the count when every triangle has
/// two equal corners.
inline Mesh parse_stl(const std::string& bytes, const std::string& file) {
    if (detail::is_binary_stl(bytes)) {
        if (bytes.size() == detail::stl_header_bytes)
            throw input_error(detail::shown(file, 4096) +
                              ", byte 80: the count of triangles is 0, but must be at least 1");
        return detail::parse_binary_stl(bytes, file);
    }
    // A text may begin with white space or a byte order mark. The header of a binary file may be
    // text, its count and coordinates are not.
    const std::string_view start = std::string_view(bytes).substr(0, 256);
    const bool is_text = std::ranges::all_of(start, [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte >= 0x20 || (byte >= '\t' && byte <= '\r');
    });
    if (!is_text && bytes.size() >= detail::stl_header_bytes)
        throw input_error(
            detail::shown(file, 4096) + ", byte 80: the count of triangles is " +
            std::to_string(detail::little_endian(bytes, 80)) + ", for which the file must have " +
            std::to_string(detail::stl_header_bytes + std::uint64_t{detail::stl_triangle_bytes} *
                                                          detail::little_endian(bytes, 80)) +
            " bytes, but it has " + std::to_string(bytes.size()));
    std::istringstream text(bytes);
    return detail::parse_text_stl(text, file);
}

/// Reads an STL file; see parse_stl.
inline Mesh read_stl(const std::filesystem::path& path) {
    return parse_stl(detail::file_content(path, "an STL file"), path.string());
}

}  // namespace talus
