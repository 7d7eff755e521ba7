// SPDX-License-Identifier: BSL-1.0
#include "table.hpp"

#include <talus/io/write_file.hpp>

#include <array>
#include <charconv>
#include <cstddef>

namespace lab {

namespace {

void append(std::string& text, double x) {
    std::array<char, 32> digits{};
    text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), x).ptr);
}

}  // namespace

void write_table(const std::filesystem::path& file, const std::vector<Column>& columns) {
    std::string text;
    for (const Column& c : columns) text.append(text.empty() ? "" : ",").append(c.name);
    text += '\n';
    for (std::size_t row = 0; row < columns.at(0).values.size(); ++row)
        for (std::size_t k = 0; k < columns.size(); ++k) {
            append(text, columns[k].values.at(row));
            text += k + 1 < columns.size() ? ',' : '\n';
        }
    talus::write_file(file, text);
}

void write_rows(const std::filesystem::path& file, std::vector<Column> columns,
                const std::vector<std::vector<double>>& rows) {
    for (const auto& row : rows)
        for (std::size_t k = 0; k < columns.size(); ++k) columns[k].values.push_back(row.at(k));
    write_table(file, columns);
}

void write_findings(const std::filesystem::path& folder, const std::vector<Finding>& findings) {
    std::string text = "finding,unit,value\n";
    for (const Finding& f : findings) {
        text.append(f.name).append(1, ',').append(f.unit).append(1, ',');
        append(text, f.value);
        text += '\n';
    }
    talus::write_file(folder / "findings.csv", text);
}

}  // namespace lab
