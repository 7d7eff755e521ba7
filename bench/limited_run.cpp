// SPDX-License-Identifier: BSL-1.0
#include "limited_run.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <fcntl.h>
#include <new>
#include <sys/mman.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

namespace bench {
namespace {

double cpu_seconds() {
    std::timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// When the process has used this much CPU time, it shall end [s].
double deadline = 0.0;

/// Lets SIGALRM come after `seconds`; 0: never.
void ring_in(double seconds) {
    itimerval timer{};
    timer.it_value.tv_sec = static_cast<std::time_t>(seconds);
    timer.it_value.tv_usec =
        static_cast<suseconds_t>(1e6 * (seconds - static_cast<double>(timer.it_value.tv_sec)));
    setitimer(ITIMER_REAL, &timer, nullptr);
}

/// Ends the process past its deadline. A timer of real time, set again while there is CPU time
/// left: one of CPU time would make the clock of CPU time advance by scheduler ticks.
void on_alarm(int signal) {
    constexpr double least = 1e-3;  // [s]
    const double left = deadline - cpu_seconds();
    if (left > 0.0) {
        ring_in(left > least ? left : least);
    } else {
        std::signal(signal, SIG_DFL);
        std::raise(signal);
    }
}

[[noreturn]] void be_child(const std::function<void()>& work) {
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    try {
        work();
    } catch (const std::exception&) {
        _exit(EXIT_FAILURE);
    }
    _exit(EXIT_SUCCESS);
}

}  // namespace

Ending run_in_child(const std::function<void()>& work) {
    // What is still in a buffer would otherwise be written by both.
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
    if (child == 0) be_child(work);
    int status = 0;
    while (waitpid(child, &status, 0) < 0)
        if (errno != EINTR) throw std::system_error(errno, std::generic_category(), "waitpid");
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) return Ending::out_of_time;
    return WIFEXITED(status) && WEXITSTATUS(status) == EXIT_SUCCESS ? Ending::finished
                                                                    : Ending::crashed;
}

void LimitedClock::start() {
    std::signal(SIGALRM, on_alarm);
    begin_ = cpu_seconds();
    deadline = begin_ + limit_;
    ring_in(limit_);
    begin_ = cpu_seconds();
}

double LimitedClock::stop() {
    const double end = cpu_seconds();
    ring_in(0.0);
    return end - begin_;
}

SharedMemory::SharedMemory(std::size_t bytes)
    : bytes_(bytes),
      data_(mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {
    if (data_ == MAP_FAILED) throw std::bad_alloc();
}

SharedMemory::~SharedMemory() { munmap(data_, bytes_); }

}  // namespace bench
