// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <nlohmann/json.hpp>

#include <vector>

#include "runner.hpp"

namespace validation {

/// The results as the document that everything else (pages, tables, JUnit) is made from.
nlohmann::ordered_json report_of(const std::vector<Result>& results);

/// The matrix fault by case.
nlohmann::ordered_json matrix_of(const std::vector<Cell>& cells);

/// Compiler, flags, processor and versions of this run.
nlohmann::ordered_json environment();

}  // namespace validation
