// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/io/hdf5_handle.hpp>
#include <talus/io/write_file.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace talus::detail {

/// An HDF5 file made in memory, from datasets by their names ("fclib_local/W/nz"; groups appear as
/// needed), and then written whole or not at all. The same content gives the same bytes. Throws
/// input_error on numbers that are not finite, std::runtime_error where HDF5 fails.
class Hdf5Writer {
  public:
    explicit Hdf5Writer(const std::filesystem::path& path) : path_(path), file_(create(path)) {}

    void integer(const std::string& name, int value) { integers(name, std::span(&value, 1)); }

    void integers(const std::string& name, std::span<const int> values) {
        put(name, H5T_STD_I32LE, H5T_NATIVE_INT, list(values.size()), values.data());
    }

    void numbers(const std::string& name, std::span<const double> values) {
        for (std::size_t k = 0; k < values.size(); ++k)
            if (!std::isfinite(values[k]))
                throw input_error(path_.string() + ": " + name + "[" + std::to_string(k) + "] is " +
                                  text_of(values[k]) + ", but must be finite");
        any_numbers(name, values);
    }

    void long_integers(const std::string& name, std::span<const std::int64_t> values) {
        put(name, H5T_STD_I64LE, H5T_NATIVE_INT64, list(values.size()), values.data());
    }
    /// Finite or not.
    void any_numbers(const std::string& name, std::span<const double> values) {
        put(name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, list(values.size()), values.data());
    }

    void text(const std::string& name, const std::string& value) {
        const Hdf5Handle type(H5Tcopy(H5T_C_S1), &H5Tclose);
        require(H5Tset_size(type.id(), value.size() + 1) >= 0);
        put(name, type.id(), type.id(), Hdf5Handle(H5Screate(H5S_SCALAR), &H5Sclose),
            value.c_str());
    }

    /// Puts the file on disk.
    void finish() {
        require(H5Fflush(file_.id(), H5F_SCOPE_GLOBAL) >= 0);
        const auto size = H5Fget_file_image(file_.id(), nullptr, 0);
        require(size > 0);
        std::string bytes(static_cast<std::size_t>(size), '\0');
        require(H5Fget_file_image(file_.id(), bytes.data(), bytes.size()) == size);
        write_file(path_, bytes);
    }

  private:
    void require(bool success) const {
        if (!success)
            throw std::runtime_error("cannot write " + path_.string() +
                                     ": HDF5 fails or is out "
                                     "of memory");
    }

    Hdf5Handle create(const std::filesystem::path& path) const {
        constexpr std::size_t growth = 1 << 20;  // bytes of memory taken at a time
        const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), &H5Pclose);
        require(H5Pset_fapl_core(access.id(), growth, /*backing_store=*/false) >= 0);
        // HDF5 wants a name, and looks for it on disk, though it writes nothing there.
        Hdf5Handle file(
            H5Fcreate((path.string() + ".part").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id()),
            &H5Fclose);
        require(file.valid());
        return file;
    }

    static Hdf5Handle list(std::size_t length) {
        const hsize_t extent = length;
        return {H5Screate_simple(1, &extent, nullptr), &H5Sclose};
    }

    void put(const std::string& name, hid_t file_type, hid_t memory_type, const Hdf5Handle& space,
             const void* values) {
        const Hdf5Handle links(H5Pcreate(H5P_LINK_CREATE), &H5Pclose);
        const Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), &H5Pclose);
        require(H5Pset_create_intermediate_group(links.id(), 1) >= 0);
        require(H5Pset_obj_track_times(creation.id(), false) >= 0);
        const Hdf5Handle set(H5Dcreate2(file_.id(), name.c_str(), file_type, space.id(), links.id(),
                                        creation.id(), H5P_DEFAULT),
                             &H5Dclose);
        require(set.valid());
        if (H5Sget_simple_extent_npoints(space.id()) > 0)
            require(H5Dwrite(set.id(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
    }

    QuietHdf5 quiet_;
    std::filesystem::path path_;
    Hdf5Handle file_;
};

}  // namespace talus::detail
