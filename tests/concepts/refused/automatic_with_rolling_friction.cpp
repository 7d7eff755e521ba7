// SPDX-License-Identifier: BSL-1.0
// expect: has_rolling_rows
// Nor does what hands over between engines, whatever adapts the law.
#include <talus/law/rolling_coulomb.hpp>
#include <talus/solver/automatic.hpp>

talus::Automatic<5, talus::WeightedMean<5, talus::RollingFriction<3>>> solver;
