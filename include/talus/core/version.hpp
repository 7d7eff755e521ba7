// SPDX-License-Identifier: BSL-1.0
#pragma once

#define TALUS_VERSION_MAJOR 0
#define TALUS_VERSION_MINOR 1
#define TALUS_VERSION_PATCH 0

namespace talus {

/// Version of the headers; CMake reads the macros above, so there is one place to change.
inline constexpr struct {
    int major = TALUS_VERSION_MAJOR;
    int minor = TALUS_VERSION_MINOR;
    int patch = TALUS_VERSION_PATCH;
} version;

}  // namespace talus
