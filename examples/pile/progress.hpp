// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <unistd.h>
#include <utility>

namespace pile {

/// A duration as people say it: 0:07, 12:34, 5:06:07, 3.2 days, 1.5e+09 years; "unknown" if it is
/// not finite.
inline std::string duration_text(double seconds) {
    constexpr double day = 86400.0, year = 365.25 * day;
    if (!std::isfinite(seconds)) return "unknown";
    char text[40];
    const double whole = std::floor(std::max(seconds, 0.0) + 0.5);
    if (whole < day) {
        const int s = static_cast<int>(whole);
        if (s < 3600)
            std::snprintf(text, sizeof text, "%d:%02d", s / 60, s % 60);
        else
            std::snprintf(text, sizeof text, "%d:%02d:%02d", s / 3600, s / 60 % 60, s % 60);
    } else if (whole < year) {
        std::snprintf(text, sizeof text, "%.1f days", whole / day);
    } else {
        std::snprintf(text, sizeof text, "%.3g years", whole / year);
    }
    return text;
}

/// A bar of `width` characters; shares outside of [0, 1] are full or empty.
inline std::string bar_text(double done, int width) {
    std::string bar(static_cast<std::size_t>(width), '.');
    const double share = done > 0.0 ? std::min(done, 1.0) : 0.0;  // NaN is none
    std::fill_n(bar.begin(), static_cast<int>(share * width), '#');
    return bar;
}

/// A progress bar with the time left on standard error: redrawn in place on a terminal, one line
/// per tenth of the work otherwise.
class Progress {
  public:
    explicit Progress(std::string label)
        : label_(std::move(label)), terminal_(isatty(STDERR_FILENO) != 0), start_(Clock::now()) {}
    ~Progress() { end_line(); }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Whether anything would be shown: remarks cost time to write.
    bool due(double done) const {
        return done >= 1.0 || (terminal_ ? seconds() >= next_time_ : done >= next_share_);
    }
    /// Shows the share of the work that is done, in [0, 1], and a remark.
    void show(double done, const std::string& remark) {
        if (!due(done)) return;
        const double elapsed = seconds();
        next_time_ = elapsed + 0.1;
        next_share_ = std::max(next_share_ + 0.1, done);
        const double left = done > 0.0 ? elapsed * (1.0 - done) / done : 0.0;
        std::fprintf(stderr, "%s%s [%s] %3.0f %%  %s left  %s%s", terminal_ ? "\r" : "",
                     label_.c_str(), bar_text(done, 28).c_str(), 100.0 * done,
                     duration_text(left).c_str(), remark.c_str(), terminal_ ? "\033[K" : "\n");
        line_open_ = terminal_;
        std::fflush(stderr);
    }
    /// What is printed next begins on a line of its own.
    void end_line() {
        if (std::exchange(line_open_, false)) std::fputc('\n', stderr);
    }
    double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  private:
    using Clock = std::chrono::steady_clock;

    std::string label_;
    bool terminal_;
    bool line_open_ = false;
    Clock::time_point start_;
    double next_time_ = 0.0;
    double next_share_ = 0.0;
};

}  // namespace pile
