// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstddef>

namespace talus::detail {

/// Room for n entries of a std::vector, with half as many to spare: numbers that creep up, as those
/// of contacts do, then seldom ask for more. (`reserve` and `assign` make room for n alone.)
template <class Container>
void make_room(Container& v, std::size_t n) {
    if (n > v.capacity()) v.reserve(n + n / 2);
}

}  // namespace talus::detail
