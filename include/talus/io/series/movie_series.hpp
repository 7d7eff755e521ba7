// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/printable.hpp>
#include <talus/dynamics/bodies.hpp>
#include <talus/geometry/shape_view.hpp>
#include <talus/io/series/growing_file.hpp>
#include <talus/io/series/movie_shapes.hpp>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <istream>
#include <limits>
#include <ranges>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <unordered_set>
#include <utility>
#include <vector>

namespace talus {

/// What a movie says of itself in its first line.
struct MovieWords {
    std::string title = {};
    std::string scalar = {};  ///< what the number of each body measures, such as "load"; none: ""
    std::string unit = {};    ///< of that, such as "mean grain weights"
};

namespace detail {

/// The file of a movie, where the dimension is a number: what was told of which body, up to when.
class MovieFile {
  public:
    MovieFile(std::filesystem::path path, int dimension, const MovieWords& words)
        : file_(GrowingFile::begun(std::move(path))) {
        file_.write(header_of(dimension, words));
    }
    static MovieFile resumed(const std::filesystem::path& path, int dimension,
                             const MovieWords& words, double time) {
        std::ifstream in(path, std::ios::binary);
        if (!in) {
            if (std::filesystem::exists(path)) fail_to_write(path, errno);
            return MovieFile(path, dimension, words);
        }
        const std::string header = header_of(dimension, words);
        std::string line;
        std::getline(in, line);
        // Killed before it had written its first line.
        if (in.eof() && header.starts_with(line)) return MovieFile(path, dimension, words);
        require_same(path, line, header);
        Kept kept{header.size()};
        kept.read(in, path, time + 1e-9 * std::abs(time));
        if (in.bad()) fail_to_write(path, EIO);
        in.close();
        std::error_code error;
        std::filesystem::resize_file(path, kept.end, error);
        if (error) fail_to_write(path, error.value());
        return MovieFile(path, std::move(kept));
    }

    /// Throws input_error unless it is finite and later than the frame before.
    void require_next(double time) const {
        if (!std::isfinite(time) || !(time > last_))
            reject("time of a frame", time, "finite and later than the one before");
    }
    bool told(BodyId body) const { return told_.contains(body.serial); }
    /// Adds the lines of a frame, those of bodies that it tells of first among them.
    void write(double time, std::string_view lines, std::span<const BodyId> told) {
        file_.write(lines);
        for (const BodyId body : told) told_.insert(body.serial);
        last_ = time;
    }
    const std::filesystem::path& path() const { return file_.path(); }

  private:
    static constexpr double never = -std::numeric_limits<double>::infinity();
    static constexpr std::string_view before_body = "{\"body\":", before_time = "{\"time\":";

    /// What stays of a movie.
    struct Kept {
        std::uintmax_t end;   ///< of the last frame's line, in bytes
        double last = never;  ///< its time [s]
        std::unordered_set<std::int64_t> told = {};

        void read(std::istream& in, const std::filesystem::path& path, double latest) {
            std::uintmax_t at = end;
            std::unordered_set<std::int64_t> since;  // told for a frame that may not stay
            std::string line;
            for (std::size_t number = 2; std::getline(in, line) && !in.eof(); ++number) {
                at += line.size() + 1;
                double time = 0.0;
                std::int64_t body = -1;
                if (begins(line, before_body, body)) {
                    since.insert(body);
                } else if (begins(line, before_time, time) && time > last) {
                    if (time > latest) return;
                    end = at, last = time;
                    told.merge(since);
                } else {
                    throw input_error(numbered("line", number, " of ") + printable(path.string()) +
                                      " begins with '" + printable(line, 40) +
                                      "', but must with a body, or with a time later than the one "
                                      "before");
                }
            }
        }
        template <class Number>
        static bool begins(const std::string& line, std::string_view before, Number& x) {
            if (!line.starts_with(before)) return false;
            const char* const last = line.data() + line.size();
            const auto [end, error] = std::from_chars(line.data() + before.size(), last, x);
            return error == std::errc{} && end != last && *end == ',';
        }
    };

    MovieFile(const std::filesystem::path& path, Kept&& kept)
        : file_(GrowingFile::continued(path)), told_(std::move(kept.told)), last_(kept.last) {}

    static std::string header_of(int dimension, const MovieWords& words) {
        return R"({"format":"talus movie","version":1,"dimension":)" + std::to_string(dimension) +
               R"(,"title":)" + json_string(words.title) + R"(,"scalar":)" +
               json_string(words.scalar) + R"(,"unit":)" + json_string(words.unit) + "}\n";
    }
    /// What stands in a header at a name; empty if that is not there.
    static std::string_view value_of(std::string_view line, std::string_view name) {
        const std::string before = std::string(1, '"').append(name).append("\":");
        const std::size_t found = line.find(before);
        if (found == std::string_view::npos) return {};
        const std::size_t begin = found + before.size();
        std::size_t end = begin;
        for (bool within = false; end < line.size(); ++end) {
            if (line[end] == '"') within = !within;
            if (within && line[end] == '\\') ++end;
            if (!within && (line[end] == ',' || line[end] == '}')) break;
        }
        return line.substr(begin, std::min(end, line.size()) - begin);
    }
    /// Throws input_error naming what differs between a first line and the one that it must be.
    static void require_same(const std::filesystem::path& path, std::string_view line,
                             std::string_view header) {
        if (line == header.substr(0, header.size() - 1)) return;
        for (const char* name : {"format", "version", "dimension", "title", "scalar", "unit"}) {
            const std::string_view is = value_of(line, name), must = value_of(header, name);
            if (is == must) continue;
            throw input_error(std::string(name) + " of the movie " + printable(path.string()) +
                              " is " + (is.empty() ? "missing" : printable(is, 80)) +
                              ", but must be " + std::string(must) + " to go on with it");
        }
        throw input_error("first line of the movie " + printable(path.string()) + " is '" +
                          printable(line, 80) + "', but must be '" +
                          std::string(header.substr(0, header.size() - 1)) + "' to go on with it");
    }

    GrowingFile file_;
    std::unordered_set<std::int64_t> told_;
    double last_ = never;
};

}  // namespace detail

/// The animation of a run, recorded while it goes on, for examples/player: lines of JSON. The first
/// says what it is; the shape of a body is told once, before the first frame that it is in; a frame
/// has the pose of every body that there is, and one number for each, by which it is shaded. Every
/// frame is handed to the system as it is added, so that a run that is killed leaves all but, at
/// worst, a part of the last line.
///
///     const MovieWords words{.title = "Pile", .scalar = "load", .unit = "N"};
///     MovieSeries<3> movie("run.movie", words);
///     const std::vector<double> load(sim.system().bodies.count(), 0.0);
///     movie.add(sim.time(), sim.system().bodies, sim.system().shapes(), load);
///     // In a run that goes on from 0.5 s: after the frames up to then.
///     auto more = MovieSeries<3>::resumed("run.movie", words, 0.5);
template <int Dim>
requires SpaceDimension<Dim>
class MovieSeries {
  public:
    /// Begins a movie, in place of any that stands there; a device or pipe is written as it is.
    /// Throws std::runtime_error naming the path if it cannot be written.
    explicit MovieSeries(std::filesystem::path path, const MovieWords& words = {})
        : MovieSeries(detail::MovieFile(std::move(path), Dim, words), words) {}

    /// Goes on with a movie: frames later than `time` [s], which the run will make again, and what
    /// a killed run left of a last line are taken out, the others stay as they are. Begins it if
    /// there is none. Throws input_error, and leaves the file as it was, if it is no movie or its
    /// first line says something else.
    static MovieSeries resumed(const std::filesystem::path& path, const MovieWords& words,
                               double time) {
        return MovieSeries(detail::MovieFile::resumed(path, Dim, words, time), words);
    }

    /// Adds a frame at `time` [s]: poses with six significant digits, and `scalars`, one for each
    /// body (what is no finite number is shown as unknown), none in a movie without. `shapes` are
    /// any, in a list in the order of the bodies. A shape is told once by the name of its body, so
    /// it must not change. Throws input_error unless times ascend, numbers of entries agree and
    /// poses are finite, and std::runtime_error if it cannot be written.
    template <std::ranges::contiguous_range Shapes>
    requires Shape<std::ranges::range_value_t<Shapes>, Dim>
    void add(double time, const Bodies<Dim>& bodies, const Shapes& shapes,
             std::span<const double> scalars = {}) {
        const std::size_t n = bodies.count();
        require_count("shapes of a frame", std::ranges::size(shapes), "bodies", n);
        require_count("scalars of a frame", scalars.size(),
                      has_scalar_ ? "bodies" : "a movie that names no scalar", has_scalar_ ? n : 0);
        file_.require_next(time);
        lines_.clear();
        told_.clear();
        for (std::size_t i = 0; i < n; ++i)
            if (!file_.told(bodies.id[i]))
                tell(bodies.id[i], bodies.is_obstacle(i),
                     view_of<Dim>(std::ranges::data(shapes)[i]));
        add_frame(time, bodies, scalars);
        file_.write(time, lines_, told_);
    }

    const std::filesystem::path& path() const { return file_.path(); }

  private:
    MovieSeries(detail::MovieFile file, const MovieWords& words)
        : file_(std::move(file)), has_scalar_(!words.scalar.empty()) {}

    void tell(BodyId body, bool obstacle, const ShapeView<Dim>& shape) {
        lines_ += "{\"body\":" + std::to_string(body.serial) +
                  (obstacle ? ",\"obstacle\":true" : ",\"obstacle\":false") + ",\"shape\":";
        detail::add_shape(lines_, shape);
        lines_ += "}\n";
        told_.push_back(body);
    }
    void add_frame(double time, const Bodies<Dim>& bodies, std::span<const double> scalars) {
        lines_ += "{\"time\":";
        detail::add_number(lines_, time, 0);
        lines_ += ",\"bodies\":[";
        for (const BodyId body : bodies.id) {
            if (lines_.back() != '[') lines_ += ',';
            lines_ += std::to_string(body.serial);
        }
        lines_ += "],\"positions\":[";
        for (std::size_t i = 0; i < bodies.count(); ++i) {
            if (!bodies.position[i].allFinite())
                require_finite(detail::numbered("position of body", i), bodies.position[i]);
            detail::add_numbers<Dim>(lines_, bodies.position[i]);
        }
        lines_ += "],\"rotations\":[";
        for (std::size_t i = 0; i < bodies.count(); ++i) {
            const auto& rotation = bodies.rotation[i];
            if (!std::isfinite(rotation.distance({})))
                require_finite(detail::numbered("rotation of body", i), rotation.matrix());
            detail::add_rotation(lines_, rotation);
        }
        if (has_scalar_) {
            lines_ += "],\"scalars\":[";
            detail::add_numbers(lines_, scalars);
        }
        lines_ += "]}\n";
    }

    detail::MovieFile file_;
    bool has_scalar_;
    std::string lines_;         // of the frame that is added
    std::vector<BodyId> told_;  // in them
};

}  // namespace talus
