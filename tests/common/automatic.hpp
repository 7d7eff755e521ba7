// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/law/coulomb.hpp>
#include <talus/solver/automatic.hpp>

// Compiled once for all tests, as users may do who include it in many files.
extern template class talus::Automatic<2, talus::Coulomb<2>>;
extern template class talus::Automatic<3, talus::Coulomb<3>>;
