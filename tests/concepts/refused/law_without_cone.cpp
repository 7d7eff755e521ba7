// SPDX-License-Identifier: BSL-1.0
// expect: friction_cone
// Engines that treat all contacts at once need a law with a cone.
#include <talus/law/bilateral.hpp>
#include <talus/solver/cones/interior_point.hpp>

talus::InteriorPoint<3, talus::Bilateral<3>> solver;
