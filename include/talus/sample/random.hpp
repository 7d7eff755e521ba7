// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/check.hpp>
#include <talus/core/number_record.hpp>

#include <cstdint>
#include <limits>
#include <random>

namespace talus {

/// Seeded source of random numbers whose bits are the same everywhere: the engine's sequence is
/// fixed by the C++ standard, and the conversions, which the standard leaves open, are done here.
class Random {
  public:
    explicit Random(std::uint64_t seed) : engine_(seed), seed_(seed) {}

    /// Uniform in [0, 1), a multiple of 2^-53.
    double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }

    /// Uniform in [low, high).
    double uniform(double low, double high) { return low + (high - low) * uniform(); }

    /// Uniform among the integers low, ..., high.
    int integer(int low, int high) {
        TALUS_CHECK(low <= high, "the range of integers is not empty");
        const auto width = static_cast<std::uint64_t>(static_cast<std::int64_t>(high) - low) + 1;
        // Numbers above the last multiple of `width` are drawn again, so that none is favoured.
        constexpr auto top = std::numeric_limits<std::uint64_t>::max();
        const std::uint64_t limit = top - top % width;
        std::uint64_t x = next();
        while (x >= limit) x = next();
        return static_cast<int>(low + static_cast<std::int64_t>(x % width));
    }

    /// The seed, and how many numbers were drawn; reading draws as many again, some 3 ns for each.
    void write(NumberRecord& out) const {
        out.integer(seed_);
        out.integer(drawn_);
    }
    static Random read(NumberRecordReader& in) {
        Random random(in.integer<std::uint64_t>());
        random.drawn_ = in.integer<std::uint64_t>(0, most_drawn);
        random.engine_.discard(random.drawn_);
        return random;
    }

  private:
    static constexpr std::int64_t most_drawn = std::int64_t{1} << 40;  // an hour to draw again

    std::uint64_t next() {
        ++drawn_;
        return engine_();
    }

    std::mt19937_64 engine_;
    std::uint64_t seed_, drawn_ = 0;
};

}  // namespace talus
