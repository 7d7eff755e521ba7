// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/io/hdf5_handle.hpp>

#include <cerrno>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <system_error>
#include <vector>

namespace talus::detail {

/// Numbers and texts of an HDF5 file by their names, such as "fclib_local/W/nz". Complaints are
/// input_error, one sentence that names file, dataset, value and what is accepted. Nothing is
/// allocated for a dataset before its length is found right.
class Hdf5Reader {
  public:
    /// `what` it must be, for complaints.
    explicit Hdf5Reader(const std::filesystem::path& path,
                        const std::string& what = "a problem file")
        : path_(path.string()), file_(open(path, what)) {}

    /// Throws the complaint about `name`: `what` goes on after it, "is 4, but must be 2 or 3".
    [[noreturn]] void fail(const std::string& name, const std::string& what) const {
        throw input_error(path_ + ": " + name + " " + what);
    }
    [[noreturn]] void fail(const std::string& name, std::int64_t value,
                           const std::string& accepted) const {
        fail(name, "is " + std::to_string(value) + ", but must be " + accepted);
    }

    /// Whether there is a group or a dataset of that name.
    bool has(const std::string& name) const {
        for (std::size_t end = 0; end != std::string::npos;) {
            end = name.find('/', end + 1);
            if (H5Lexists(file_.id(), name.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
        }
        return true;
    }

    /// How many numbers a dataset holds, which must be in the file.
    std::size_t length(const std::string& name) const {
        const auto set = dataset(name);
        const std::size_t found = count(name, set);
        if (found > 0 && H5Dget_storage_size(set.id()) == 0)
            fail(name, "was never written, but must be whole");
        return found;
    }

    /// The one number of a dataset, in [low, high].
    std::int64_t integer(const std::string& name, std::int64_t low,
                         std::int64_t high = std::numeric_limits<int>::max()) const {
        const auto value = integers(name, 1)[0];
        if (value < low || value > high)
            fail(name, value, "in [" + std::to_string(low) + ", " + std::to_string(high) + "]");
        return value;
    }

    std::vector<std::int64_t> integers(const std::string& name, std::size_t length) const {
        return read<std::int64_t>(name, H5T_INTEGER, H5T_NATIVE_INT64, length);
    }

    /// The numbers of a dataset, finite or not.
    std::vector<double> any_numbers(const std::string& name, std::size_t length) const {
        return read<double>(name, H5T_FLOAT, H5T_NATIVE_DOUBLE, length);
    }
    /// The finite numbers of a dataset.
    std::vector<double> numbers(const std::string& name, std::size_t length) const {
        auto values = any_numbers(name, length);
        for (std::size_t k = 0; k < length; ++k)
            if (!std::isfinite(values[k]))
                fail(name + "[" + std::to_string(k) + "]",
                     "is " + text_of(values[k]) + ", but must be finite");
        return values;
    }

    /// A text; empty if there is none of that name.
    std::string text(const std::string& name) const {
        if (!has(name)) return {};
        const auto set = dataset(name);
        const Hdf5Handle type(H5Dget_type(set.id()), &H5Tclose);
        if (!type.valid() || H5Tget_class(type.id()) != H5T_STRING || count(name, set) != 1)
            fail(name, "is no text, but must be one");
        std::string text;
        bool read = false;
        if (H5Tis_variable_str(type.id()) > 0) {
            char* characters = nullptr;
            read = H5Dread(set.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, &characters) >= 0;
            if (characters != nullptr) text = characters;
            H5free_memory(characters);
        } else {
            const std::size_t size = H5Tget_size(type.id());
            require_stored(name, set, type.id(), 1);
            text.resize(size);
            read = H5Dread(set.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) >= 0;
            text.resize(text.find_last_not_of('\0') + 1);
        }
        if (!read) fail(name, "cannot be read, but must be whole");
        return text;
    }

  private:
    static Hdf5Handle open(const std::filesystem::path& path, const std::string& what) {
        std::error_code error;
        if (!std::filesystem::is_regular_file(path, error))
            throw input_error(path.string() + ": the file cannot be read, but must be " + what);
        if (!std::ifstream(path).is_open())
            throw input_error(path.string() + ": " + std::generic_category().message(errno) +
                              ", but the file must be " + what);
        Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), &H5Fclose);
        if (!file.valid())
            throw input_error(path.string() + ": the file is no whole HDF5 file, but must be " +
                              what);
        return file;
    }

    Hdf5Handle dataset(const std::string& name) const {
        if (!has(name)) fail(name, "is missing, but must be there");
        Hdf5Handle set(H5Dopen2(file_.id(), name.c_str(), H5P_DEFAULT), &H5Dclose);
        if (!set.valid()) fail(name, "cannot be read, but must be a whole dataset");
        return set;
    }

    std::size_t count(const std::string& name, const Hdf5Handle& set) const {
        const Hdf5Handle space(H5Dget_space(set.id()), &H5Sclose);
        const int axes = space.valid() ? H5Sget_simple_extent_ndims(space.id()) : -1;
        if (axes < 0) fail(name, "cannot be read, but must be a whole dataset");
        if (axes > 1) fail(name, "has " + std::to_string(axes) + " axes, but must be a list");
        return static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.id()));
    }

    template <class Number>
    std::vector<Number> read(const std::string& name, H5T_class_t kind, hid_t memory_type,
                             std::size_t length) const {
        const auto set = dataset(name);
        const std::size_t found = count(name, set);
        if (found != length)
            fail(name, "has length " + std::to_string(found) + ", but must have length " +
                           std::to_string(length));
        const Hdf5Handle type(H5Dget_type(set.id()), &H5Tclose);
        if (!type.valid() || H5Tget_class(type.id()) != kind)
            fail(name, kind == H5T_INTEGER ? "is no list of integers, but must be one"
                                           : "is no list of real numbers, but must be one");
        require_stored(name, set, type.id(), length);
        std::vector<Number> values(length);
        if (length > 0 &&
            H5Dread(set.id(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
            fail(name, "cannot be read, but must be whole");
        return values;
    }

    /// A length is a claim; only what is in the file deserves memory. A dataset that was never
    /// written stands for zeros: some writers have no velocities to store. It may claim, as may one
    /// that is compressed, a thousand times the bytes that are there: deflate does not reach more.
    void require_stored(const std::string& name, const Hdf5Handle& set, hid_t type,
                        std::size_t length) const {
        constexpr std::size_t largest_ratio = 1100;
        const std::size_t stored = H5Dget_storage_size(set.id());
        const std::size_t size = std::filesystem::file_size(path_);
        const Hdf5Handle creation(H5Dget_create_plist(set.id()), &H5Pclose);
        const bool packed =
            H5Pget_layout(creation.id()) == H5D_CHUNKED && H5Pget_nfilters(creation.id()) > 0;
        const std::size_t width = H5Tget_size(type);
        if (width == 0) fail(name, "is of numbers without bytes, but must be whole");
        const std::size_t room = (stored > 0 ? stored : size) / width;
        const bool is_there = stored > 0 && !packed;
        if (stored > size || (is_there ? length : length / largest_ratio) > room)
            fail(name, "is cut off, but must be whole");
    }

    QuietHdf5 quiet_;
    std::string path_;
    Hdf5Handle file_;
};

}  // namespace talus::detail
