// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <concepts>
#include <cstddef>
#include <vector>

namespace talus {

/// One entry for each body: a std::vector whose index may be a BodyIndex, or any other integer,
/// without a cast.
template <class T>
class PerBody : public std::vector<T> {
  public:
    using std::vector<T>::vector;

    T& operator[](std::integral auto body) {
        return std::vector<T>::operator[](static_cast<std::size_t>(body));
    }
    const T& operator[](std::integral auto body) const {
        return std::vector<T>::operator[](static_cast<std::size_t>(body));
    }
};

}  // namespace talus
