// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/number_record.hpp>
#include <talus/core/printable.hpp>
#include <talus/io/hdf5_reader.hpp>
#include <talus/io/hdf5_writer.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace talus::detail {

/// Lists of numbers by their names, such as "bodies/position": what a checkpoint is a file of.
class NamedArrays {
  public:
    std::map<std::string, std::vector<double>> reals;
    std::map<std::string, std::vector<std::int64_t>> integers;
    std::map<std::string, std::string> texts;

    /// Throws input_error unless there is a list of that name, of `length` numbers.
    const std::vector<double>& real_list(const std::string& name, std::size_t length) const {
        return list(reals, name, length);
    }
    const std::vector<std::int64_t>& integer_list(const std::string& name,
                                                  std::size_t length) const {
        return list(integers, name, length);
    }
    /// Of any length.
    const std::vector<std::int64_t>& integer_list(const std::string& name) const {
        return any_list(integers, name);
    }
    double real(const std::string& name) const { return real_list(name, 1)[0]; }
    std::int64_t integer(const std::string& name) const { return integer_list(name, 1)[0]; }

    void put(const std::string& name, const NumberRecord& record) {
        reals[name + "/reals"] = record.reals;
        integers[name + "/integers"] = record.integers;
    }
    NumberRecord record(const std::string& name) const {
        return {any_list(reals, name + "/reals"), any_list(integers, name + "/integers")};
    }

    /// Of names and bits: that of a damaged file is another one.
    std::int64_t checksum() const {
        std::uint64_t sum = 0xcbf29ce484222325u;  // FNV-1a
        const auto add = [&](std::uint64_t word) {
            for (int byte = 0; byte < 8; ++byte, word >>= 8)
                sum = (sum ^ (word & 0xff)) * 0x100000001b3u;
        };
        const auto add_text = [&](std::string_view words) {
            add(words.size());
            for (const char c : words) add(static_cast<unsigned char>(c));
        };
        for (const auto& [name, list] : reals) {
            add_text(name);
            for (const double x : list) add(std::bit_cast<std::uint64_t>(x));
        }
        for (const auto& [name, list] : integers) {
            add_text(name);
            for (const std::int64_t k : list) add(static_cast<std::uint64_t>(k));
        }
        for (const auto& [name, words] : texts) {
            add_text(name);
            add_text(words);
        }
        return static_cast<std::int64_t>(sum);
    }

  private:
    template <class List>
    static const List& any_list(const std::map<std::string, List>& lists, const std::string& name) {
        const auto found = lists.find(name);
        if (found == lists.end()) throw input_error(name + " is missing, but must be there");
        return found->second;
    }
    template <class List>
    static const List& list(const std::map<std::string, List>& lists, const std::string& name,
                            std::size_t length) {
        const List& found = any_list(lists, name);
        require_count("numbers in " + name, found.size(), "the bodies or contacts that it is of",
                      length);
        return found;
    }
};

/// Writes them to an HDF5 file, whole or not at all; datasets by their names, and beside them
/// `format`, `version`, `checksum`.
inline void write_arrays(const std::filesystem::path& path, const std::string& format, int version,
                         const NamedArrays& arrays) {
    Hdf5Writer file(path);
    file.text("format", format);
    file.integer("version", version);
    const std::int64_t sum = arrays.checksum();
    file.long_integers("checksum", std::span(&sum, 1));
    std::string names;  // of the lists, as a reader of HDF5 finds only what it knows the name of
    for (const auto& [name, list] : arrays.reals) names += "r " + name + "\n";
    for (const auto& [name, list] : arrays.integers) names += "i " + name + "\n";
    for (const auto& [name, words] : arrays.texts) names += "t " + name + "\n";
    file.text("names", names);
    for (const auto& [name, list] : arrays.reals) file.any_numbers(name, list);
    for (const auto& [name, list] : arrays.integers) file.long_integers(name, list);
    for (const auto& [name, words] : arrays.texts) file.text(name, words);
    file.finish();
}

/// Reads them back. Throws input_error, one sentence that names the file, if it is none, of another
/// format or of no version from `version` to the last, or not as it was written.
inline NamedArrays read_arrays(const std::filesystem::path& path, const std::string& format,
                               int version, int last_version) {
    const Hdf5Reader file(path, "a " + format);
    const std::string found = file.text("format");
    if (found != format)
        file.fail("format", "is '" + printable(found, 40) + "', but must be '" + format + "'");
    file.integer("version", version, last_version);
    NamedArrays arrays;
    const std::string names = file.text("names");
    for (std::size_t at = 0, end = 0; at < names.size(); at = end + 1) {
        end = std::min(names.find('\n', at), names.size());
        const std::string line = names.substr(at, end - at);
        const std::string name = line.substr(std::min<std::size_t>(line.size(), 2));
        if (line.starts_with("r "))
            arrays.reals[name] = file.any_numbers(name, file.length(name));
        else if (line.starts_with("i "))
            arrays.integers[name] = file.integers(name, file.length(name));
        else if (line.starts_with("t "))
            arrays.texts[name] = file.text(name);
        else
            file.fail("names", "has a line '" + printable(line, 40) +
                                   "', but must have a kind and a name in each");
    }
    if (arrays.checksum() != file.integers("checksum", 1)[0])
        file.fail("checksum", "is not that of what is there, but must be: the file is damaged");
    return arrays;
}

}  // namespace talus::detail
