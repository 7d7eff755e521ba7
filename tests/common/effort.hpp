// SPDX-License-Identifier: BSL-1.0
#pragma once

#if defined(__SANITIZE_ADDRESS__)
#define TALUS_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define TALUS_SANITIZED 1
#endif
#endif

/// How often a random case is repeated: `full` times by tests/run --full without sanitizers (under
/// which each takes ten times as long), `brief` times for every change.
constexpr int repetitions([[maybe_unused]] int full, [[maybe_unused]] int brief) {
#if defined(TALUS_FULL_TESTS) && !defined(TALUS_SANITIZED)
    return full;
#else
    return brief;
#endif
}
