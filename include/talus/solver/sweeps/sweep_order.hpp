// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/column.hpp>

#include <cstddef>
#include <cstdint>
#include <utility>

namespace talus {

/// In which order a sweep visits the contacts. Where impulses are not unique the order chooses
/// among them; velocities and the residual reached do not depend on it.
enum class SweepOrder {
    forward,   ///< ascending: the order of the contact keys. The fastest: contacts come as a stream
    backward,  ///< descending
    symmetric,  ///< forward and backward in turn: no direction along the keys is preferred
    random,     ///< a new permutation each sweep, the same ones for the same seed on any machine
};

/// Visits all contacts, sweep after sweep, in a given order.
class SweepSequence {
  public:
    /// Starts over. Allocates only for a random order of more contacts than any before.
    void reset(SweepOrder order, std::uint64_t seed, std::size_t contacts) {
        order_ = order;
        state_ = seed;
        contacts_ = contacts;
        sweep_ = 0;
        permutation_.resize(order == SweepOrder::random ? contacts : 0);
        for (std::size_t i = 0; i < permutation_.size(); ++i) permutation_[i] = i;
    }

    /// Calls visit(i) for every contact, in the order of the next sweep.
    template <class Visit>
    void next(Visit&& visit) {
        const bool odd = sweep_++ % 2 == 1;
        if (order_ == SweepOrder::random) {
            shuffle();
            for (const std::size_t i : permutation_) visit(i);
        } else if (order_ == SweepOrder::backward || (order_ == SweepOrder::symmetric && odd)) {
            for (std::size_t i = contacts_; i-- > 0;) visit(i);
        } else {
            for (std::size_t i = 0; i < contacts_; ++i) visit(i);
        }
    }

  private:
    /// Fisher-Yates. Written out because std::shuffle differs between standard libraries.
    void shuffle() {
        for (std::size_t i = permutation_.size(); i > 1; --i)
            std::swap(permutation_[i - 1], permutation_[below(i)]);
    }
    /// Number in [0, n) by SplitMix64 [SteeleLeaFlood2014]; its bias, n / 2^64, does not matter
    /// here.
    std::size_t below(std::size_t n) {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return static_cast<std::size_t>((z ^ (z >> 31)) % n);
    }

    SweepOrder order_ = SweepOrder::forward;
    std::uint64_t state_ = 0;
    std::size_t contacts_ = 0;
    std::uint64_t sweep_ = 0;
    Column<std::size_t> permutation_;
};

}  // namespace talus
