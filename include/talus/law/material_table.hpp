// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/check.hpp>
#include <talus/core/column.hpp>
#include <talus/core/ids.hpp>
#include <talus/core/input.hpp>

#include <concepts>
#include <optional>
#include <string>
#include <utility>

namespace talus {

namespace detail {

[[gnu::cold]] inline std::string law_of_materials(MaterialIndex i, MaterialIndex j) {
    return joined({"law of materials (", digits_of(i), ", ", digits_of(j), ")"});
}
[[noreturn, gnu::cold]] inline void refuse_missing_law(MaterialIndex i, MaterialIndex j) {
    throw input_error(
        joined({law_of_materials(i, j), " is missing, but must be set before the pair meets"}));
}

}  // namespace detail

/// The law between each pair of materials, symmetric: which surface meets which makes no
/// difference. Pairs must be set, unless the table was given a law for all of them.
template <std::copyable Law>
class MaterialTable {
  public:
    /// Table of `materials` kinds of surface, no pair set. Throws input_error unless positive.
    explicit MaterialTable(MaterialIndex materials) : materials_(materials) {
        if (materials <= 0) detail::reject("materials", materials, "at least 1");
        const auto n = static_cast<std::size_t>(materials);
        laws_.resize(n * (n + 1) / 2);
    }
    /// The same with `law` for every pair.
    MaterialTable(MaterialIndex materials, const Law& law) : MaterialTable(materials) {
        require_valid(law, "law");
        for (auto& entry : laws_) entry = law;
    }

    MaterialIndex material_count() const { return materials_; }

    /// Sets the law between materials i and j. Throws input_error on an index outside the table and
    /// on a law that finds itself invalid.
    void set(MaterialIndex i, MaterialIndex j, const Law& law) {
        auto& entry = laws_[slot(i, j)];
        require_valid(law, detail::law_of_materials(i, j));
        entry = law;
    }
    /// The law between materials i and j. Throws input_error on an index outside the table and on a
    /// pair that was never set.
    const Law& at(MaterialIndex i, MaterialIndex j) const {
        const auto& entry = laws_[slot(i, j)];
        if (!entry) detail::refuse_missing_law(i, j);
        return *entry;
    }

  private:
    static void require_valid(const Law& law, const std::string& item) {
        if constexpr (requires { law.require_valid(item); }) law.require_valid(item);
    }
    /// Place of the pair in the lower triangle, row by row.
    std::size_t slot(MaterialIndex i, MaterialIndex j) const {
        for (const MaterialIndex k : {i, j}) require_in("material index", k, 0, materials_ - 1);
        const auto high = static_cast<std::size_t>(i > j ? i : j);
        const auto low = static_cast<std::size_t>(i > j ? j : i);
        return high * (high + 1) / 2 + low;
    }

    MaterialIndex materials_;
    Column<std::optional<Law>> laws_;
};

}  // namespace talus
