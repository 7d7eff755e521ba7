// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lab {

/// A column of a table: its name with the unit in brackets, and its numbers.
struct Column {
    std::string name;
    std::vector<double> values = {};
};

/// Writes columns of equal length as CSV, numbers so that they read back bit for bit. (What grows
/// with time is a talus::CsvSeries.)
void write_table(const std::filesystem::path& file, const std::vector<Column>& columns);
/// The same, row by row; the columns have names alone.
void write_rows(const std::filesystem::path& file, std::vector<Column> columns,
                const std::vector<std::vector<double>>& rows);

/// A number that an experiment has found.
struct Finding {
    std::string name;  ///< of lower-case words, without a comma
    std::string unit;  ///< "-" for a pure number
    double value;      ///< nan: not found, as of avalanches that did not come
};
/// Writes them as `findings.csv`, a line for each, for programs that compare them over seeds and
/// with what is known.
void write_findings(const std::filesystem::path& folder, const std::vector<Finding>& findings);

}  // namespace lab
