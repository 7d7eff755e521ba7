// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>

namespace bench {

/// How a limited run ended.
enum class Ending { finished, out_of_time, crashed };

/// Runs `work` in a child process and waits for it: whatever it does to memory, other than to a
/// SharedBlock, is gone, and it may crash, exit or print (its output is dropped). It ends
/// `out_of_time` when a LimitedClock in it strikes.
Ending run_in_child(const std::function<void()>& work);

/// Measures the CPU time of this process between start and stop; ends the process if more than
/// `limit` [s] pass between them. For use in run_in_child.
class LimitedClock {
  public:
    explicit LimitedClock(double limit) : limit_(limit) {}
    void start();
    double stop();  ///< since the last start [s]

  private:
    double limit_;
    double begin_ = 0.0;
};

/// Memory that a child process shares with its parent.
class SharedMemory {
  public:
    explicit SharedMemory(std::size_t bytes);
    SharedMemory(const SharedMemory&) = delete;
    SharedMemory& operator=(const SharedMemory&) = delete;
    ~SharedMemory();
    void* data() const { return data_; }

  private:
    std::size_t bytes_;
    void* data_;
};

/// `count` elements of a type that may be copied byte by byte, in shared memory.
template <class T>
class SharedBlock {
  public:
    explicit SharedBlock(std::size_t count) : memory_(count * sizeof(T) + 1), count_(count) {
        std::uninitialized_value_construct_n(begin(), count);
    }
    std::span<T> span() const { return {begin(), count_}; }

  private:
    T* begin() const { return static_cast<T*>(memory_.data()); }
    SharedMemory memory_;
    std::size_t count_;
};

}  // namespace bench
