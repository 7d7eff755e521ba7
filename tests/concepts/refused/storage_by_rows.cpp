// SPDX-License-Identifier: BSL-1.0
// expect: EIGEN_DEFAULT_TO_ROW_MAJOR
// Products of small matrices read columns: stored by rows they would be wrong in silence.
#define EIGEN_DEFAULT_TO_ROW_MAJOR
#include <talus/core/types.hpp>
