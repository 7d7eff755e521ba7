// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <unistd.h>

namespace pile {

/// A progress bar with the time left on standard error: redrawn in place on a terminal, one line
/// per tenth of the work otherwise.
class Progress {
  public:
    explicit Progress(std::string label)
        : label_(std::move(label)), terminal_(isatty(STDERR_FILENO) != 0), start_(Clock::now()) {}

    /// Shows the share of the work that is done, in [0, 1], and a remark.
    void show(double done, const std::string& remark) {
        const double elapsed = seconds_since(start_);
        const bool finished = done >= 1.0;
        if (terminal_ ? !finished && elapsed < next_time_ : done < next_share_) return;
        next_time_ = elapsed + 0.1;
        next_share_ = std::max(next_share_ + 0.1, done);
        const double left = done > 0.0 ? elapsed * (1.0 - done) / done : 0.0;
        constexpr int width = 28;
        std::string bar(width, '.');
        std::fill_n(bar.begin(), static_cast<int>(done * width), '#');
        std::fprintf(stderr, "%s%s [%s] %3.0f %%  %s left  %s%s", terminal_ ? "\r" : "",
                     label_.c_str(), bar.c_str(), 100.0 * done, clock_text(left).c_str(),
                     remark.c_str(), terminal_ && !finished ? "\033[K" : "\n");
        std::fflush(stderr);
    }
    double seconds() const { return seconds_since(start_); }

  private:
    using Clock = std::chrono::steady_clock;
    static double seconds_since(Clock::time_point t) {
        return std::chrono::duration<double>(Clock::now() - t).count();
    }
    static std::string clock_text(double seconds) {
        char text[32];
        const int whole = static_cast<int>(seconds + 0.5);
        std::snprintf(text, sizeof text, "%d:%02d", whole / 60, whole % 60);
        return text;
    }

    std::string label_;
    bool terminal_;
    Clock::time_point start_;
    double next_time_ = 0.0;
    double next_share_ = 0.0;
};

}  // namespace pile
