// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/types.hpp>
#include <talus/law/concepts.hpp>
#include <talus/problem/delassus_sparse.hpp>

#include <cstddef>
#include <vector>

namespace talus {

/// A contact problem given by its Delassus operator,  u = W r + free_velocity: what FCLib calls
/// local. W is used as it is, also where a file's is not exactly symmetric.
template <int Rows, ContactLaw<Rows> Law>
struct AssembledProblem {
    DelassusSparse<Rows> delassus;
    std::vector<Vector<Rows>> free_velocity;  ///< FCLib's q [m/s]
    std::vector<Law> laws;

    std::size_t contact_count() const { return free_velocity.size(); }
};

}  // namespace talus
