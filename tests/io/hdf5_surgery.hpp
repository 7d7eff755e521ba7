// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/io/hdf5_handle.hpp>

#include <boost/test/unit_test.hpp>

#include <filesystem>
#include <string>
#include <type_traits>
#include <vector>

/// Changes single datasets of an HDF5 file.
class Hdf5Surgery {
  public:
    explicit Hdf5Surgery(const std::filesystem::path& path)
        : file_(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), &H5Fclose) {
        BOOST_REQUIRE(file_.valid());
    }

    void remove(const std::string& name) {
        BOOST_REQUIRE(H5Ldelete(file_.id(), name.c_str(), H5P_DEFAULT) >= 0);
        flush();
    }
    template <class Number>
    void replace(const std::string& name, const std::vector<Number>& values) {
        make(name, values.size(), type<Number>());
        write(name, values);
    }
    template <class Number>
    void replace_one(const std::string& name, std::size_t k, Number value) {
        auto values = read<Number>(name);
        BOOST_REQUIRE(k < values.size());
        values[k] = value;
        write(name, values);
    }
    /// A dataset of that length to which nothing was ever written.
    void replace_by_claim(const std::string& name, std::size_t length) {
        make(name, length, H5T_NATIVE_DOUBLE);
        flush();
    }
    /// A dataset of that length, in pieces of `chunk`, of which only the first is written.
    void replace_by_first_chunk(const std::string& name, std::size_t length, std::size_t chunk,
                                bool deflated) {
        const Handle creation(H5Pcreate(H5P_DATASET_CREATE), &H5Pclose);
        const hsize_t piece = chunk;
        H5Pset_chunk(creation.id(), 1, &piece);
        if (deflated) H5Pset_deflate(creation.id(), 9);
        make(name, length, H5T_NATIVE_DOUBLE, creation.id());
        const Handle set(H5Dopen2(file_.id(), name.c_str(), H5P_DEFAULT), &H5Dclose);
        const Handle file_space(H5Dget_space(set.id()), &H5Sclose);
        const hsize_t begin = 0, one = 1;
        H5Sselect_hyperslab(file_space.id(), H5S_SELECT_SET, &begin, nullptr, &one, nullptr);
        const Handle memory(H5Screate_simple(1, &one, nullptr), &H5Sclose);
        const double value = 0.5;
        BOOST_REQUIRE(H5Dwrite(set.id(), H5T_NATIVE_DOUBLE, memory.id(), file_space.id(),
                               H5P_DEFAULT, &value) >= 0);
        flush();
    }
    void replace_by_variable_text(const std::string& name, const char* value) {
        const Handle type(H5Tcopy(H5T_C_S1), &H5Tclose);
        H5Tset_size(type.id(), H5T_VARIABLE);
        make(name, 1, type.id());
        const Handle set(H5Dopen2(file_.id(), name.c_str(), H5P_DEFAULT), &H5Dclose);
        BOOST_REQUIRE(H5Dwrite(set.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, &value) >= 0);
        flush();
    }
    std::vector<int> integers(const std::string& name) const { return read<int>(name); }
    std::vector<double> numbers(const std::string& name) const { return read<double>(name); }

  private:
    using Handle = talus::detail::Hdf5Handle;

    template <class Number>
    static hid_t type() {
        return std::is_same_v<Number, int> ? H5T_NATIVE_INT : H5T_NATIVE_DOUBLE;
    }
    void flush() { H5Fflush(file_.id(), H5F_SCOPE_GLOBAL); }

    void make(const std::string& name, std::size_t length, hid_t type,
              hid_t creation = H5P_DEFAULT) {
        const talus::detail::QuietHdf5 quiet;
        H5Ldelete(file_.id(), name.c_str(), H5P_DEFAULT);
        const hsize_t extent = length;
        const Handle space(H5Screate_simple(1, &extent, nullptr), &H5Sclose);
        const Handle links(H5Pcreate(H5P_LINK_CREATE), &H5Pclose);
        H5Pset_create_intermediate_group(links.id(), 1);
        const Handle set(H5Dcreate2(file_.id(), name.c_str(), type, space.id(), links.id(),
                                    creation, H5P_DEFAULT),
                         &H5Dclose);
        BOOST_REQUIRE(set.valid());
    }
    template <class Number>
    void write(const std::string& name, const std::vector<Number>& values) {
        const Handle set(H5Dopen2(file_.id(), name.c_str(), H5P_DEFAULT), &H5Dclose);
        BOOST_REQUIRE(
            H5Dwrite(set.id(), type<Number>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0);
        flush();
    }
    template <class Number>
    std::vector<Number> read(const std::string& name) const {
        const Handle set(H5Dopen2(file_.id(), name.c_str(), H5P_DEFAULT), &H5Dclose);
        const Handle space(H5Dget_space(set.id()), &H5Sclose);
        std::vector<Number> values(
            static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.id())));
        BOOST_REQUIRE(
            H5Dread(set.id(), type<Number>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0);
        return values;
    }

    Handle file_;
};
