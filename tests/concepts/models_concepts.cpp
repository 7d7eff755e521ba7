// SPDX-License-Identifier: BSL-1.0
// Every type of the library models the concepts that it says it does: compiling this is the test.
#define TALUS_CHECK_MODELS
#include <talus/talus.hpp>

#ifndef TALUS_MODEL
#error "no header of the library asks TALUS_MODEL"
#endif
