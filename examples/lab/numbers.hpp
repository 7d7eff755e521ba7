// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/number_record.hpp>

#include <utility>
#include <vector>

namespace lab {

/// A list of numbers that a run carries along: what was measured on the way.
struct Numbers {
    std::vector<double> values;

    bool empty() const { return values.empty(); }
    double& operator[](std::size_t k) { return values[k]; }
    double operator[](std::size_t k) const { return values[k]; }

    void write(talus::NumberRecord& out) const {
        out.integer(values.size());
        for (const double x : values) out.real(x);
    }
    static Numbers read(talus::NumberRecordReader& in) {
        std::vector<double> values(in.count(1, 0));
        for (double& x : values) x = in.real();
        return {std::move(values)};
    }
};

}  // namespace lab
