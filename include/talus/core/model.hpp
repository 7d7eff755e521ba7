// SPDX-License-Identifier: BSL-1.0
#pragma once

/// Says below a type which concepts it models. The compiler asks where TALUS_CHECK_MODELS is
/// defined, as tests/concepts does for all headers: these questions together are a fifth of the
/// work of including talus.hpp, which who uses the types should not pay for.
#ifdef TALUS_CHECK_MODELS
#define TALUS_MODEL(...) static_assert(__VA_ARGS__)
#else
#define TALUS_MODEL(...) static_assert(true)
#endif
