// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <type_traits>
#include <utility>

namespace talus {

/// The observer that watches nothing: the default of every hook, free of cost.
/// A named type rather than a lambda, so that it is one type in all translation units.
struct Ignore {
    template <class... Args>
    constexpr void operator()(Args&&...) const noexcept {}
};

/// Calls an observer; answers whether the loop may go on. An observer that returns bool stops the
/// loop by returning false; one that returns nothing never stops it.
template <class Observer, class... Args>
constexpr bool notify(Observer& observer, Args&&... args) {
    if constexpr (std::is_void_v<decltype(observer(std::forward<Args>(args)...))>) {
        observer(std::forward<Args>(args)...);
        return true;
    } else {
        return static_cast<bool>(observer(std::forward<Args>(args)...));
    }
}

}  // namespace talus
