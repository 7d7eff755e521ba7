// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstdlib>
#include <new>

/// Number of allocations of the program so far. To be included in one file of a test: it replaces
/// the global operators.
inline long allocation_count = 0;

// GCC takes new and free for a mismatch when it sees through one of the two replacements only.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"
#endif

void* operator new(std::size_t size) {
    ++allocation_count;
    if (void* p = std::malloc(size)) return p;
    throw std::bad_alloc();
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
