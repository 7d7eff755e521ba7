// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/io/series/csv_series.hpp>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "../plot.hpp"
#include "../table.hpp"
#include "fits.hpp"

namespace lab {

/// What columns of grains become that collapse: a number for each.
struct Collapses {
    std::vector<double> aspect;           ///< H0 / L0 of what settled
    std::vector<double> run_out, height;  ///< (L - L0) / L0, H / L0
    std::vector<double> time;             ///< until 0.98 of L is reached, over sqrt(2 H0 / g)

    /// One more, from how far grains were every so many steps of h [s], by which it fell from the
    /// height H0 to H; lengths in [m], sqrt(2 H0 / g) in [s]. Writes `length.csv`.
    void add(const std::filesystem::path& folder, const std::vector<double>& length,
             std::int64_t every, double h, double l0, double h0, double h1, double fall) {
        const double end = length.back();
        aspect.push_back(h0 / l0);
        run_out.push_back(end / l0 - 1.0);
        height.push_back(h1 / l0);
        time.push_back(0.0);
        talus::CsvSeries table(folder / "length.csv", {{"length", "m"}});
        for (std::size_t k = 0; k < length.size(); ++k) {
            const double t = static_cast<double>(static_cast<std::int64_t>(k + 1) * every) * h;
            table.add(t, {length[k]});
            if (time.back() == 0.0 && length[k] >= 0.98 * end) time.back() = t / fall;
        }
    }
    /// The last one.
    void print() const {
        std::printf("%5.2f   %12.3f   %11.3f   %21.2f\n", aspect.back(), run_out.back(),
                    height.back(), time.back());
    }
    /// The exponent of the run-out over columns from `low` to `high`; nan of less than two.
    double exponent(double low, double high) const {
        std::vector<double> a, far;
        for (std::size_t k = 0; k < aspect.size(); ++k)
            if (aspect[k] >= low && aspect[k] <= high && run_out[k] > 0.0)
                a.push_back(aspect[k]), far.push_back(run_out[k]);
        return a.size() < 2 ? std::nan("") : fit_power(a, far).exponent;
    }
    /// The exponents of run-out and height over columns from `low` to `high`, beside what was
    /// found elsewhere.
    void print_exponents(double low, double high, const char* reference) const {
        std::vector<double> a, far, tall;
        for (std::size_t k = 0; k < aspect.size(); ++k) {
            if (aspect[k] < low || aspect[k] > high || !(run_out[k] > 0.0)) continue;
            a.push_back(aspect[k]);
            far.push_back(run_out[k]);
            tall.push_back(height[k]);
        }
        if (a.size() < 2) return;
        const auto of_run_out = fit_power(a, far), of_height = fit_power(a, tall);
        std::printf("a from %.2f to %.2f: run-out %.2f a^%.2f (%s); height %.2f a^%.2f\n",
                    a.front(), a.back(), of_run_out.factor, of_run_out.exponent, reference,
                    of_height.factor, of_height.exponent);
    }
    /// `columns.csv` and `columns.svg`.
    void write(const std::filesystem::path& folder) const {
        write_table(folder / "columns.csv", {{"aspect ratio", aspect},
                                             {"run-out / L0", run_out},
                                             {"height / L0", height},
                                             {"time / sqrt(2 H0 / g)", time}});
        write_plot(folder / "columns.svg",
                   {"Collapse of columns",
                    "aspect ratio H0 / L0",
                    "over L0",
                    {{"run-out", aspect, run_out, true}, {"height", aspect, height, true}},
                    true});
    }
};

}  // namespace lab
