// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace talus::detail {

/// Length of the character of UTF-8 that begins at `at`, if it is a whole one that terminals print
/// and do not obey; 0 otherwise.
[[gnu::cold]] inline std::size_t printable_length(std::string_view text, std::size_t at) {
    const auto byte = [&](std::size_t k) {
        return k < text.size() ? static_cast<unsigned char>(text[k]) : 0u;
    };
    const unsigned first = byte(at);
    if (first < 0x80) return first >= 0x20 && first != 0x7f ? 1 : 0;
    if (first < 0xc2 || first > 0xf4) return 0;
    const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    unsigned code = first & (0xffu >> (length + 1));
    for (std::size_t k = 1; k < length; ++k) {
        if ((byte(at + k) & 0xc0) != 0x80) return 0;
        code = code << 6 | (byte(at + k) & 0x3f);
    }
    // U+0080 to U+009F are control characters again; the lowest of each length keeps overlong forms
    // out. Marks of direction, joiners and the like change how the rest is shown.
    const unsigned lowest = length == 4 ? 0x10000 : length == 3 ? 0x800 : 0xa0;
    const bool formats = (code >= 0x200b && code <= 0x200f) || (code >= 0x2028 && code <= 0x202e) ||
                         (code >= 0x2060 && code <= 0x206f) || code == 0xfeff;
    const bool surrogate = code >= 0xd800 && code <= 0xdfff;
    return code < lowest || code > 0x10ffff || formats || surrogate ? 0 : length;
}

/// Text as it may be shown on a terminal, on one line: control characters and bytes that are no
/// UTF-8 as \n, \t or \x1b. All else, accents too, stays. Of more than `longest` bytes the
/// beginning.
[[gnu::cold]] inline std::string printable(std::string_view text,
                                           std::size_t longest = std::string_view::npos) {
    constexpr const char* digits = "0123456789abcdef";
    std::string shown;
    for (std::size_t at = 0; at < text.size();) {
        if (shown.size() >= longest) return shown + "...";
        const std::size_t length = printable_length(text, at);
        if (length > 0) {
            shown += text.substr(at, length);
            at += length;
            continue;
        }
        const auto byte = static_cast<unsigned char>(text[at++]);
        if (byte == '\n')
            shown += "\\n";
        else if (byte == '\t')
            shown += "\\t";
        else
            shown += {'\\', 'x', digits[byte >> 4], digits[byte & 15]};
    }
    return shown;
}

}  // namespace talus::detail
