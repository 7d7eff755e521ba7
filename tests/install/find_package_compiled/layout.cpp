// SPDX-License-Identifier: BSL-1.0
// The least that a file can have of talus.
#include <talus/core/instantiate.hpp>

int main() {}
