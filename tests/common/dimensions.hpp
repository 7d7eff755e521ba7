// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/dimension.hpp>

#include <tuple>

/// Every test body runs in both: BOOST_AUTO_TEST_CASE_TEMPLATE(name, D, dimensions) with D::value.
using dimensions = std::tuple<talus::DimensionTag<2>, talus::DimensionTag<3>>;
