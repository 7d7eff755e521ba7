// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>

/// Number of allocations of the program so far. To be included in one file of a test: it replaces
/// all global operators, so that what one of them gives another can take back.
inline long allocation_count = 0;

// GCC takes new and free for a mismatch when it sees through one of the two replacements only.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"
#endif

namespace allocation_counter {

inline void* allocate(std::size_t size, std::size_t alignment) noexcept {
    ++allocation_count;
    if (alignment <= alignof(std::max_align_t)) return std::malloc(size > 0 ? size : 1);
    return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}
inline void* or_throw(void* p) {
    if (p == nullptr) throw std::bad_alloc();
    return p;
}

}  // namespace allocation_counter

void* operator new(std::size_t n) {
    return allocation_counter::or_throw(allocation_counter::allocate(n, 1));
}
void* operator new[](std::size_t n) {
    return allocation_counter::or_throw(allocation_counter::allocate(n, 1));
}
void* operator new(std::size_t n, const std::nothrow_t&) noexcept {
    return allocation_counter::allocate(n, 1);
}
void* operator new[](std::size_t n, const std::nothrow_t&) noexcept {
    return allocation_counter::allocate(n, 1);
}
void* operator new(std::size_t n, std::align_val_t a) {
    const auto alignment = static_cast<std::size_t>(a);
    return allocation_counter::or_throw(allocation_counter::allocate(n, alignment));
}
void* operator new[](std::size_t n, std::align_val_t a) {
    const auto alignment = static_cast<std::size_t>(a);
    return allocation_counter::or_throw(allocation_counter::allocate(n, alignment));
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete[](void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t) noexcept { std::free(p); }
void operator delete(void* p, const std::nothrow_t&) noexcept { std::free(p); }
void operator delete[](void* p, const std::nothrow_t&) noexcept { std::free(p); }
void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete[](void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }
