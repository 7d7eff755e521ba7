// SPDX-License-Identifier: BSL-1.0
#pragma once

#if defined(__SANITIZE_ADDRESS__)
#define TALUS_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define TALUS_SANITIZED 1
#endif
#endif

/// How often a random case is repeated: `usual` times, or `sanitized` times under sanitizers, where
/// each takes ten times as long and what is looked for is not a rare number.
constexpr int repetitions([[maybe_unused]] int usual, [[maybe_unused]] int sanitized) {
#ifdef TALUS_SANITIZED
    return sanitized;
#else
    return usual;
#endif
}
