// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/io/line_reader.hpp>
#include <talus/sample/granulometry.hpp>

#include <filesystem>
#include <istream>
#include <string>
#include <vector>

namespace talus {

/// Reads a sieve curve: in each line a radius [m] and the share of the mass of grains up to it
/// [0, 1], ascending; what follows a # is a comment. `file` is the name that complaints begin with.
/// Throws input_error, one sentence with the line or the point, when it is none.
template <int Dim>
SieveCurve<Dim> parse_sieve_curve(std::istream& text, const std::string& file) {
    LineReader in(text, file);
    std::vector<typename SieveCurve<Dim>::Point> points;
    while (in.next_words()) {
        in.drop_comment();
        if (in.words_left() == 0) continue;
        const double radius = in.number("radius [m]", 1e-300, 1e6);
        points.push_back({radius, in.number("share of the mass", 0.0, 1.0)});
        in.expect_end_of_line();
    }
    try {
        return SieveCurve<Dim>(points);
    } catch (const input_error& error) {
        throw input_error(detail::shown(file, 4096) + ": " + error.what());
    }
}

/// Reads a file; see parse_sieve_curve.
template <int Dim>
SieveCurve<Dim> read_sieve_curve(const std::filesystem::path& path) {
    std::ifstream text = detail::open_file(path, "a sieve curve");
    return parse_sieve_curve<Dim>(text, path.string());
}

}  // namespace talus
