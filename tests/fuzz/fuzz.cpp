// SPDX-License-Identifier: BSL-1.0
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "fuzz/reading.hpp"

/// Entry of a coverage-guided fuzzer; TALUS_FUZZED names the check.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        reading::TALUS_FUZZED({reinterpret_cast<const char*>(data), size});
    } catch (const std::exception& error) {
        std::fprintf(stderr, "not as it must be: %s\n", error.what());
        std::abort();
    }
    return 0;
}
