// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <atomic>
#include <csignal>

namespace pile {

/// The first SIGINT (Ctrl-C) or SIGTERM asks for the run to end after the step under way; the
/// second ends the program at once. A signal that was ignored before stays so (nohup).
class StopRequest {
  public:
    static void listen() {
        for (const int signal : {SIGINT, SIGTERM})
            if (std::signal(signal, &note) == SIG_IGN) std::signal(signal, SIG_IGN);
    }
    /// The signal that asked, 0 while none did.
    static int signal() { return signal_; }

  private:
    static void note(int signal) {
        signal_ = signal;
        std::signal(SIGINT, SIG_DFL);
        std::signal(SIGTERM, SIG_DFL);
    }
    static inline std::atomic<int> signal_{0};
    static_assert(std::atomic<int>::is_always_lock_free, "signal handlers may use it");
};

}  // namespace pile
