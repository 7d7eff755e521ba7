// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/number_record.hpp>
#include <talus/io/series/csv_series.hpp>
#include <talus/measure/block_average.hpp>

#include <cstddef>
#include <filesystem>
#include <limits>
#include <vector>

namespace lab {

/// What has flowed out, and how high what is left stands, at some times. To be carried along.
class Flow {
  public:
    void add(double time, double mass, double height) {  // [s], [kg], [m]
        time_.push_back(time);
        mass_.push_back(mass);
        height_.push_back(height);
    }
    /// Mean flow, with its error, over the times from `begin` to `end` [s] at which what is left
    /// stands between two heights [m]. [kg/s]
    talus::BlockAverage mean(double begin, double end, double low = 0.0,
                             double high = std::numeric_limits<double>::infinity()) const {
        talus::BlockAverage average;
        for (std::size_t k = 1; k < time_.size(); ++k)
            if (time_[k - 1] >= begin && time_[k] <= end && height_[k] >= low && height_[k] < high)
                average.add(flow(k));
        return average;
    }
    void write_csv(const std::filesystem::path& file) const {
        talus::CsvSeries table(file, {{"flow", "kg/s"}, {"height", "m"}});
        for (std::size_t k = 1; k < time_.size(); ++k) table.add(time_[k], {flow(k), height_[k]});
    }

    void write(talus::NumberRecord& out) const {
        out.integer(time_.size());
        for (const auto* list : {&time_, &mass_, &height_})
            for (const double x : *list) out.real(x);
    }
    static Flow read(talus::NumberRecordReader& in) {
        Flow flow;
        const std::size_t count = in.count(3, 0);
        for (auto* list : {&flow.time_, &flow.mass_, &flow.height_})
            for (std::size_t k = 0; k < count; ++k) list->push_back(in.real());
        return flow;
    }

  private:
    double flow(std::size_t k) const {
        return (mass_[k] - mass_[k - 1]) / (time_[k] - time_[k - 1]);
    }
    std::vector<double> time_, mass_, height_;
};

}  // namespace lab
