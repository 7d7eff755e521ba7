// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/check.hpp>
#include <talus/core/number_record.hpp>
#include <talus/geometry/convex_core.hpp>

#include <concepts>
#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

namespace talus {

namespace detail {

/// The first of the list that is no shape, else the last. One type is asked in place of the pack,
/// since compilers then show what it lacks.
template <int Dim, class S, class... Others>
struct FirstNoShape {
    using type = S;
};
template <int Dim, class S, class... Others>
requires(Shape<S, Dim> && sizeof...(Others) > 0) struct FirstNoShape<Dim, S, Others...>
    : FirstNoShape<Dim, Others...> {
};

/// As std::visit, for less work of the compiler.
template <class... Shapes, class Question>
void visit_held(const std::variant<Shapes...>& held, const Question& question) {
    TALUS_CHECK(!held.valueless_by_exception(), "a shape whose assignment threw is not used");
    [&]<std::size_t... I>(std::index_sequence<I...>) {
        ((held.index() == I ? question(*std::get_if<I>(&held)) : void()), ...);
    }
    (std::index_sequence_for<Shapes...>{});
}

}  // namespace detail

/// One of a closed list of shapes, chosen at run time; itself a SolidShape, so that a scene of
/// mixed shapes is stored like a scene of one. Shapes of the list that have no inside (half-spaces)
/// are held as well: asking one for its mass properties throws input_error.
template <int Dim, class... Shapes>
requires Shape<typename detail::FirstNoShape<Dim, Shapes...>::type, Dim>
class AnyShapeOf {
  public:
    template <class S>
    requires(std::same_as<S, Shapes> || ...) AnyShapeOf(S shape) : held_(std::move(shape)) {}

    /// The shape itself: `visit(overloads, shape.held())`, `std::get_if<Ball<3>>(&shape.held())`.
    const std::variant<Shapes...>& held() const { return held_; }

    Aabb<Dim> aabb(const Pose<Dim>& pose) const {
        Aabb<Dim> box;
        detail::visit_held(held_, [&](const auto& s) { box = s.aabb(pose); });
        return box;
    }
    MassProperties<Dim> mass_properties() const {
        return std::visit(
            []<class S>(const S& s) -> MassProperties<Dim> {
                if constexpr (SolidShape<S, Dim>)
                    return s.mass_properties();
                else
                    throw input_error(
                        "shape of a body is unbounded, but must be a solid; "
                        "half-spaces are for obstacles");
            },
            held_);
    }
    AnyShapeOf placed(const Pose<Dim>& pose) const {
        return std::visit([&](const auto& s) { return AnyShapeOf(s.placed(pose)); }, held_);
    }

    /// Of the shape that is held [m].
    double half_thickness() const {
        double half = 0.0;
        detail::visit_held(held_, [&](const auto& s) { half = talus::half_thickness<Dim>(s); });
        return half;
    }

    /// Which of the list it is, and the shape itself.
    void write(NumberRecord& out) const requires(Recordable<Shapes>&&...) {
        out.integer(held_.index());
        detail::visit_held(held_, [&](const auto& s) { s.write(out); });
    }
    static AnyShapeOf read(NumberRecordReader& in) requires(Recordable<Shapes>&&...) {
        const auto kind = in.integer<std::size_t>(0, sizeof...(Shapes) - 1);
        std::optional<AnyShapeOf> shape;
        std::size_t k = 0;
        ((k++ == kind ? void(shape.emplace(Shapes::read(in))) : void()), ...);
        return *shape;
    }

  private:
    std::variant<Shapes...> held_;
};

/// Whether S is an AnyShapeOf.
template <class S>
inline constexpr bool is_any_shape = false;
template <int Dim, class... Shapes>
inline constexpr bool is_any_shape<AnyShapeOf<Dim, Shapes...>> = true;

}  // namespace talus
