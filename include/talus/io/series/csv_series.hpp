// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/printable.hpp>
#include <talus/io/series/growing_file.hpp>
#include <talus/io/write_file.hpp>

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace talus {

/// A table of measures over time that grows while a run goes on: comma separated, the time first,
/// names with units in the first line, numbers so that they read back bit for bit. Every row is
/// handed to the system as it is added, so that a run that is killed leaves all rows but, at worst,
/// a part of the last.
///
///     CsvSeries table("energy.csv", {{"kinetic energy", "J"}});
///     table.add(0.5, {1.25});
///     // In a run that goes on from 0.5 s: after the rows up to then.
///     auto more = CsvSeries::resumed("energy.csv", {{"kinetic energy", "J"}}, 0.5);
class CsvSeries {
  public:
    struct Column {
        std::string name, unit;
    };

    /// Begins a table, in place of any that stands there; a device or pipe is written as it is.
    /// Throws std::runtime_error naming the path if it cannot be written, and input_error for names
    /// or units with a comma, a quote or a line break.
    CsvSeries(std::filesystem::path path, const std::vector<Column>& columns)
        : CsvSeries(std::move(path), columns.size(), header_of(columns)) {}

    /// Goes on with a table: rows later than `time` [s], which the run will make again, and what a
    /// killed run left of a last row are taken out, the others stay as they are. Begins it if there
    /// is none. Throws input_error, and leaves the file as it was, if it has other columns or
    /// rows without a time.
    static CsvSeries resumed(const std::filesystem::path& path, const std::vector<Column>& columns,
                             double time) {
        if (!std::filesystem::exists(path)) return CsvSeries(path, columns);
        std::ifstream in(path, std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(in), {}};
        if (in.bad()) detail::fail_to_write(path, EIO);
        const std::string header = header_of(columns);
        // Killed before it had written its first line.
        if (header.starts_with(text)) return CsvSeries(path, columns);
        if (text.substr(0, header.size()) != header)
            throw input_error("first line of " + detail::printable(path.string()) + " is '" +
                              detail::printable(text.substr(0, text.find('\n')), 80) +
                              "', but must be '" + header.substr(0, header.size() - 1) +
                              "' to go on with it");
        const std::size_t end = end_of_rows(text, header.size(), time, path);
        if (end < text.size()) write_file(path, std::string_view(text).substr(0, end));
        return CsvSeries(detail::GrowingFile::continued(path), columns.size());
    }

    /// Adds a row. Throws input_error unless there is one value per column and the time is finite
    /// (values may be what they are), and std::runtime_error if it cannot be written.
    void add(double time, std::span<const double> values) {
        require_count("values of a row", values.size(), "columns", columns_);
        if (!std::isfinite(time)) detail::reject("time of a row", time, "finite");
        std::string row = exact(time);
        for (const double x : values) row.append(1, ',').append(exact(x));
        file_.write(row + "\n");
    }
    void add(double time, std::initializer_list<double> values) {
        add(time, std::span(values.begin(), values.size()));
    }

    const std::filesystem::path& path() const { return file_.path(); }

  private:
    CsvSeries(detail::GrowingFile file, std::size_t columns)
        : columns_(columns), file_(std::move(file)) {}
    CsvSeries(std::filesystem::path path, std::size_t columns, const std::string& header)
        : CsvSeries(detail::GrowingFile::begun(std::move(path)), columns) {
        file_.write(header);
    }

    static std::string header_of(const std::vector<Column>& columns) {
        std::string text = "time [s]";
        for (const Column& c : columns) {
            const std::string words = c.name + " [" + c.unit + "]";
            if (words.find_first_of(",\"\n\r") != std::string::npos)
                throw input_error("column is '" + detail::printable(words) +
                                  "', but must be without commas, quotes and line breaks");
            text += "," + words;
        }
        return text + "\n";
    }
    /// Where the rows up to `time` end.
    static std::size_t end_of_rows(const std::string& text, std::size_t at, double time,
                                   const std::filesystem::path& path) {
        const double latest = time + 1e-9 * std::abs(time);
        for (std::size_t line = 2;; ++line) {
            const std::size_t end = text.find('\n', at);
            if (end == std::string::npos) return at;
            double when = 0.0;
            const auto [read, error] = std::from_chars(&text[at], &text[end], when);
            if (error != std::errc{} || !std::isfinite(when) || (*read != ',' && *read != '\n'))
                throw input_error(
                    detail::numbered("line", line, " of ") + detail::printable(path.string()) +
                    " begins with '" +
                    detail::printable(std::string_view(text).substr(at, end - at), 40) +
                    "', but must with a time");
            if (when > latest) return at;
            at = end + 1;
        }
    }
    static std::string exact(double x) {
        std::array<char, 32> digits{};
        const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), x).ptr;
        return std::string(digits.data(), end);
    }

    std::size_t columns_;
    detail::GrowingFile file_;
};

}  // namespace talus
