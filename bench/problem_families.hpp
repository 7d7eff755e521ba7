// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bench_problem.hpp"

namespace bench {

/// The contact problems that talus makes itself: one implicit step of every family from rest under
/// gravity, assembled by the library's own step. Names are FAMILY-SIZE, where the size is the
/// number of contacts aimed at; the same name and seed give the same problem.
///
/// `-perturbed` is a warm start: impulses of a first solve to 1e-3, then gravity turned by 1
/// degree.
///
/// `sizes` replaces the sizes of every family, unless empty.
std::vector<ProblemEntry> generated_problems(std::span<const std::size_t> sizes,
                                             std::uint64_t seed);

}  // namespace bench
