// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/law/cone_of.hpp>
#include <talus/law/prepared.hpp>

#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

namespace talus {

/// One of several laws, chosen at run time per contact: for problems that mix, say, rough contacts
/// and pins. The price is one branch per visit; a problem of one kind of law should use that law.
template <int Rows, ContactLaw<Rows>... Laws>
requires(sizeof...(Laws) > 0) struct AnyLaw {
    static constexpr bool rolling_rows = (has_rolling_rows<Laws> || ...);

    std::variant<Laws...> law;

    /// What each of the laws keeps of W, in the order of the laws (types may repeat).
    using PreparedAny = std::variant<Prepared<Laws, Rows>...>;

    PreparedAny prepare(const Matrix<Rows>& w) const { return prepare_from(w); }
    Vector<Rows> improved(const PreparedAny& prepared, const Vector<Rows>& u,
                          const Vector<Rows>& r) const {
        return improved_from(prepared, u, r);
    }
    Vector<Rows> solve(const LocalProblem<Rows>& p, const Vector<Rows>& r) const {
        return std::visit([&](const auto& l) { return Vector<Rows>(l.solve(p, r)); }, law);
    }
    Vector<Rows> natural_map(const Vector<Rows>& u, const Vector<Rows>& r, double rho) const {
        return std::visit([&](const auto& l) { return Vector<Rows>(l.natural_map(u, r, rho)); },
                          law);
    }
    double steep_error(const Vector<Rows>& u, const Vector<Rows>& r, double rho) const {
        return std::visit([&](const auto& l) { return talus::steep_error<Rows>(l, u, r, rho); },
                          law);
    }
    /// The shift of the chosen law; zero for one without restitution. If all are without, so is
    /// this, and WeightedMean may adapt it.
    Vector<Rows> restitution_shift(const Vector<Rows>& u_begin) const
        requires(RestitutionLaw<Laws, Rows> || ...) {
        return std::visit(
            [&](const auto& l) -> Vector<Rows> {
                if constexpr (RestitutionLaw<std::remove_cvref_t<decltype(l)>, Rows>)
                    return l.restitution_shift(u_begin);
                else
                    return Vector<Rows>::Zero();
            },
            law);
    }
    auto friction_cone() const requires SpaceDimension<Rows> {
        return std::visit([](const auto& l) { return cone_of<Rows>(l); }, law);
    }
    /// Throws input_error naming `item` unless the chosen law is valid.
    void require_valid(std::string_view item) const {
        std::visit(
            [&](const auto& l) {
                if constexpr (requires { l.require_valid(item); }) l.require_valid(item);
            },
            law);
    }

  private:
    template <std::size_t I = 0>
    PreparedAny prepare_from(const Matrix<Rows>& w) const {
        if constexpr (I + 1 < sizeof...(Laws))
            if (law.index() != I) return prepare_from<I + 1>(w);
        return PreparedAny(std::in_place_index<I>, talus::prepare<Rows>(std::get<I>(law), w));
    }
    template <std::size_t I = 0>
    Vector<Rows> improved_from(const PreparedAny& prepared, const Vector<Rows>& u,
                               const Vector<Rows>& r) const {
        if constexpr (I + 1 < sizeof...(Laws))
            if (law.index() != I) return improved_from<I + 1>(prepared, u, r);
        return talus::improved<Rows>(std::get<I>(law), std::get<I>(prepared), u, r);
    }
};

}  // namespace talus
