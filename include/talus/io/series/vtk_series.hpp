// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/printable.hpp>
#include <talus/io/vtk.hpp>
#include <talus/io/write_file.hpp>

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace talus {

/// Data sets over time for ParaView: a file for each, `name-000000.vtp`..., and beside them the
/// list of all with their times, `name.pvd`, which is whole at any moment.
class VtkSeries {
  public:
    /// Begins a series, in place of any of that list; its files are replaced as it grows. Throws
    /// input_error unless the path ends in .pvd, and std::runtime_error naming it if it cannot be
    /// written.
    explicit VtkSeries(std::filesystem::path list) : VtkSeries(std::move(list), {}) {}
    /// Goes on with a series: data sets later than `time` [s] leave the list. Begins it if there is
    /// none. Throws input_error if the file is not such a list.
    static VtkSeries resumed(const std::filesystem::path& list, double time) {
        std::vector<double> times;
        if (std::filesystem::exists(list)) times = times_of(list, time + 1e-9 * std::abs(time));
        return VtkSeries(list, std::move(times));
    }

    /// Adds a data set. Throws input_error unless times ascend, and as write_file and vtp_text do.
    void add(double time, const VtkPolyData& data) {
        if (!std::isfinite(time) || (!times_.empty() && !(time > times_.back())))
            detail::reject("time of a VTK data set", time, "finite and later than the one before");
        write_file(file(times_.size()), vtp_text(data));
        times_.push_back(time);
        try {
            write_list();
        } catch (...) {
            times_.pop_back();
            throw;
        }
    }
    std::size_t size() const { return times_.size(); }
    /// Of the k-th data set.
    std::filesystem::path file(std::size_t k) const { return list_.parent_path() / name_of(k); }

  private:
    VtkSeries(std::filesystem::path list, std::vector<double> times)
        : list_(std::move(list)), times_(std::move(times)) {
        if (list_.extension() != ".pvd")
            throw input_error("list of a VTK series is " + detail::printable(list_.string()) +
                              ", but must end in .pvd");
        write_list();
    }
    std::string name_of(std::size_t k) const {
        std::string number = std::to_string(k);
        number.insert(0, number.size() < 6 ? 6 - number.size() : 0, '0');
        return list_.stem().string() + "-" + number + ".vtp";
    }
    void write_list() const {
        std::string text =
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
            "byte_order=\"LittleEndian\">\n<Collection>\n";
        for (std::size_t k = 0; k < times_.size(); ++k) {
            std::array<char, 32> digits{};
            const auto end =
                std::to_chars(digits.data(), digits.data() + digits.size(), times_[k]).ptr;
            text += before_time + std::string(digits.data(), end) + "\" part=\"0\" file=\"" +
                    detail::xml_escaped(name_of(k)) + "\"/>\n";
        }
        write_file(list_, text + "</Collection>\n</VTKFile>\n");
    }
    static std::vector<double> times_of(const std::filesystem::path& list, double latest) {
        std::ifstream in(list, std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(in), {}};
        if (text.find("<VTKFile type=\"Collection\"") == std::string::npos)
            throw input_error(detail::printable(list.string()) +
                              " is no list of a VTK series (.pvd), but must be to go on with it");
        std::vector<double> times;
        for (std::size_t at = text.find(before_time); at != std::string::npos;
             at = text.find(before_time, at)) {
            at += before_time.size();
            double time = 0.0;
            const auto error = std::from_chars(&text[at], text.data() + text.size(), time).ec;
            if (error != std::errc{} || (!times.empty() && !(time > times.back())))
                throw input_error("time of " + detail::numbered("data set", times.size(), " in ") +
                                  detail::printable(list.string()) +
                                  " is no number later than the one before, but must be");
            if (time > latest) break;
            times.push_back(time);
        }
        return times;
    }
    static constexpr std::string_view opening = "<DataSet timestep=\"";
    inline static const std::string before_time{opening};

    std::filesystem::path list_;
    std::vector<double> times_;
};

}  // namespace talus
