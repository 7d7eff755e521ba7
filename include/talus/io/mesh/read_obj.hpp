// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/io/line_reader.hpp>
#include <talus/io/mesh/mesh.hpp>

#include <charconv>
#include <span>
#include <sstream>
#include <string_view>

namespace talus {
namespace detail {

/// The vertex that a corner of a face names, such as 3, 3/1, 3//2 or -1 for the last one.
inline std::uint32_t obj_corner(LineReader& in, const std::string& item,
                                std::span<const std::uint32_t> numbers) {
    const std::string& word = in.word(item);
    const auto count = static_cast<long>(numbers.size());
    const auto slash = std::min(word.find('/'), word.size());
    long index = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + slash, index);
    const bool whole = error == std::errc{} && end == word.data() + slash;
    if (count == 0)
        in.fail(item, "is '" + shown(word) + "', but must come after the vertices that it names");
    if (!whole || index == 0 || index > count || index < -count)
        in.fail(item, "is '" + shown(word) + "', but must begin with a number of a vertex in [1, " +
                          std::to_string(count) + "] or [-" + std::to_string(count) + ", -1]");
    return numbers[static_cast<std::size_t>(index > 0 ? index - 1 : count + index)];
}

}  // namespace detail

/// Reads a mesh from the text of an OBJ file: the statements v and f; a face of more than three
/// corners becomes a fan of triangles; lines may go on after a backslash. Others (normals,
/// textures, groups, materials, lines) are passed over. `file` is the name that complaints begin
/// with. Throws input_error, one sentence with the line, when one of the two is not as it should
/// be, or there is no face; and one with the count when every triangle has two equal corners.
inline Mesh parse_obj(std::istream& text, const std::string& file) {
    LineReader in(text, file);
    detail::MeshBuilder mesh;
    std::vector<std::uint32_t> numbers;  // in the welded mesh
    std::size_t face_count = 0;
    while (in.next_words()) {
        const std::string key = in.word("a key");
        if (key == "v" || key == "f") in.join_continued_lines();
        if (key == "v") {
            const std::string name = "vertex " + std::to_string(numbers.size() + 1);
            Vector<3> x;
            constexpr std::array axes{" x [m]", " y [m]", " z [m]"};
            for (std::size_t k = 0; k < 3; ++k)
                x[static_cast<int>(k)] = in.number(name + axes[k], -detail::largest_coordinate,
                                                   detail::largest_coordinate);
            numbers.push_back(mesh.vertex(x));  // a weight or a colour may follow
        } else if (key == "f") {
            const std::string name = "face " + std::to_string(++face_count) + ": corner ";
            std::vector<std::uint32_t> loop;
            while (loop.size() < 3 || in.words_left() > 0)
                loop.push_back(
                    detail::obj_corner(in, name + std::to_string(loop.size() + 1), numbers));
            for (std::size_t k = 1; k + 1 < loop.size(); ++k)
                mesh.triangle({loop[0], loop[k], loop[k + 1]});
        }
    }
    if (face_count == 0) in.fail("the file", "holds no face, but must hold at least one");
    return mesh.take_from(file);
}

/// Reads an OBJ file; see parse_obj.
inline Mesh read_obj(const std::filesystem::path& path) {
    std::istringstream text(detail::file_content(path, "an OBJ file"));
    return parse_obj(text, path.string());
}

}  // namespace talus
