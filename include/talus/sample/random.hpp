// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/check.hpp>

#include <cstdint>
#include <limits>
#include <random>

namespace talus {

/// Seeded source of random numbers whose bits are the same everywhere: the engine's sequence is
/// fixed by the C++ standard, and the conversions, which the standard leaves open, are done here.
class Random {
  public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}

    /// Uniform in [0, 1), a multiple of 2^-53.
    double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

    /// Uniform in [low, high).
    double uniform(double low, double high) { return low + (high - low) * uniform(); }

    /// Uniform among the integers low, ..., high.
    int integer(int low, int high) {
        TALUS_CHECK(low <= high, "the range of integers is not empty");
        const auto width = static_cast<std::uint64_t>(static_cast<std::int64_t>(high) - low) + 1;
        // Numbers above the last multiple of `width` are drawn again, so that none is favoured.
        constexpr auto top = std::numeric_limits<std::uint64_t>::max();
        const std::uint64_t limit = top - top % width;
        std::uint64_t x = engine_();
        while (x >= limit) x = engine_();
        return static_cast<int>(low + static_cast<std::int64_t>(x % width));
    }

  private:
    std::mt19937_64 engine_;
};

}  // namespace talus
