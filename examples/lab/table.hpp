// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/io/write_file.hpp>

#include <array>
#include <charconv>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace lab {

/// A column of a table: its name with the unit in brackets, and its numbers.
struct Column {
    std::string name;
    std::vector<double> values;
};

/// Writes columns of equal length as CSV, numbers so that they read back bit for bit. (What grows
/// with time is a talus::CsvSeries.)
inline void write_table(const std::filesystem::path& file, const std::vector<Column>& columns) {
    std::string text;
    for (const Column& c : columns) text += (text.empty() ? "" : ",") + c.name;
    text += "\n";
    for (std::size_t row = 0; row < columns.at(0).values.size(); ++row)
        for (std::size_t k = 0; k < columns.size(); ++k) {
            std::array<char, 32> digits{};
            const double x = columns[k].values.at(row);
            text.append(digits.data(),
                        std::to_chars(digits.data(), digits.data() + digits.size(), x).ptr);
            text += k + 1 < columns.size() ? "," : "\n";
        }
    talus::write_file(file, text);
}

}  // namespace lab
