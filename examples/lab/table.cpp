// SPDX-License-Identifier: BSL-1.0
#include "table.hpp"

#include <talus/io/write_file.hpp>

#include <array>
#include <charconv>

namespace lab {

void write_table(const std::filesystem::path& file,
                 const std::vector<std::pair<std::string, std::string>>& columns,
                 const std::vector<std::vector<double>>& rows) {
    std::string text;
    for (const auto& [name, unit] : columns)
        text += (text.empty() ? "" : ",") + name + " [" + unit + "]";
    text += '\n';
    for (const auto& row : rows) {
        for (std::size_t k = 0; k < row.size(); ++k) {
            std::array<char, 32> digits{};
            const auto end =
                std::to_chars(digits.data(), digits.data() + digits.size(), row[k]).ptr;
            if (k > 0) text += ',';
            text.append(digits.data(), end);
        }
        text += '\n';
    }
    talus::write_file(file, text);
}

}  // namespace lab
