// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace lab {

/// Writes a table at once, comma separated: names and units of its columns, then rows, as exact
/// decimal numbers. (A table that grows with time is a talus::CsvSeries.)
void write_table(const std::filesystem::path& file,
                 const std::vector<std::pair<std::string, std::string>>& columns,
                 const std::vector<std::vector<double>>& rows);

}  // namespace lab
