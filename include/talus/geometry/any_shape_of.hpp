// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/check.hpp>
#include <talus/core/number_record.hpp>
#include <talus/geometry/convex_core.hpp>
#include <talus/geometry/shape_view.hpp>

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <memory>
#include <new>
#include <optional>
#include <type_traits>
#include <utility>

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

/// What an AnyShapeOf asks of the shape that it holds, of which it knows the address alone.
template <int Dim, class Any>
struct HeldShape {
    const ShapeAccess<Dim>* access;
    std::size_t index;  ///< in the list
    void (*copy)(void* to, const void* from);
    void (*move)(void* to, void* from);
    void (*destroy)(void* shape);
    MassProperties<Dim> (*mass_properties)(const void* shape);
    Any (*placed)(const void* shape, const Pose<Dim>& pose);
    double (*half_thickness)(const void* shape);
    void (*write)(const void* shape, NumberRecord& out);
};

template <int Dim, class S>
MassProperties<Dim> held_mass_properties(const S& shape) {
    if constexpr (SolidShape<S, Dim>)
        return shape.mass_properties();
    else
        throw input_error(
            "shape of a body is unbounded, but must be a solid; half-spaces are for obstacles");
}

template <int Dim, class Any, class S>
Any held_placed(const S& shape, const Pose<Dim>& pose) {
    if constexpr (requires {
                      { shape.placed(pose) } -> std::convertible_to<S>;
                  })
        return Any(S(shape.placed(pose)));
    else
        throw input_error(
            "shape of a body cannot be seen from another frame, but must have `placed`");
}

template <int Dim, class Any, class S>
constexpr HeldShape<Dim, Any> make_held_shape(std::size_t index) {
    HeldShape<Dim, Any> held{};
    held.access = &shape_access<Dim, S>;
    held.index = index;
    held.copy = [](void* to, const void* from) { ::new (to) S(*static_cast<const S*>(from)); };
    held.move = [](void* to, void* from) { ::new (to) S(std::move(*static_cast<S*>(from))); };
    held.destroy = [](void* shape) { std::destroy_at(static_cast<S*>(shape)); };
    held.mass_properties = [](const void* shape) {
        return held_mass_properties<Dim>(*static_cast<const S*>(shape));
    };
    held.placed = [](const void* shape, const Pose<Dim>& pose) {
        return held_placed<Dim, Any>(*static_cast<const S*>(shape), pose);
    };
    held.half_thickness = [](const void* shape) {
        return talus::half_thickness<Dim>(*static_cast<const S*>(shape));
    };
    if constexpr (requires(const S& s, NumberRecord& out) { s.write(out); })
        held.write = [](const void* shape, NumberRecord& out) {
            static_cast<const S*>(shape)->write(out);
        };
    return held;
}

}  // namespace detail

/// One of a closed list of shapes, chosen at run time; itself a SolidShape, so that a scene of
/// mixed shapes is stored like a scene of one. Shapes of the list that have no inside (half-spaces)
/// are held as well: asking one for its mass properties throws input_error.
/// What a shape can do is reached through a table that comes with its first value: a program pays
/// the compiler for the shapes that it makes, not for those that the list allows.
template <int Dim, class... Shapes>
requires Shape<typename detail::FirstNoShape<Dim, Shapes...>::type, Dim>
class AnyShapeOf {
  public:
    template <class S>
    requires(std::same_as<S, Shapes> || ...) AnyShapeOf(S shape) : held_(&table<S>) {
        static_assert(std::is_nothrow_move_constructible_v<S>,
                      "a shape in a list moves without throwing");
        ::new (static_cast<void*>(bytes_.data())) S(std::move(shape));
    }
    AnyShapeOf(const AnyShapeOf& other) : held_(other.held_) {
        held_->copy(bytes_.data(), other.bytes_.data());
    }
    AnyShapeOf(AnyShapeOf&& other) noexcept : held_(other.held_) {
        held_->move(bytes_.data(), other.bytes_.data());
    }
    AnyShapeOf& operator=(const AnyShapeOf& other) {
        if (this != &other) *this = AnyShapeOf(other);
        return *this;
    }
    AnyShapeOf& operator=(AnyShapeOf&& other) noexcept {
        if (this == &other) return *this;
        held_->destroy(bytes_.data());
        held_ = other.held_;
        held_->move(bytes_.data(), other.bytes_.data());
        return *this;
    }
    ~AnyShapeOf() { held_->destroy(bytes_.data()); }

    /// The shape itself if it is an S, else null.
    template <class S>
    requires(std::same_as<S, Shapes> || ...) const S* get_if() const {
        return held_->index == index_of<S>()
                   ? std::launder(reinterpret_cast<const S*>(bytes_.data()))
                   : nullptr;
    }
    /// Calls `question` with the shape itself, which must be ready for every type of the list.
    template <class Question>
    decltype(auto) visit(Question&& question) const {
        return ask<Question, Shapes...>(question);
    }
    /// The shape as the narrow phase sees it; lives no longer than this.
    ShapeView<Dim> view() const { return {bytes_.data(), held_->access}; }

    Aabb<Dim> aabb(const Pose<Dim>& pose) const { return view().aabb(pose); }
    MassProperties<Dim> mass_properties() const { return held_->mass_properties(bytes_.data()); }
    AnyShapeOf placed(const Pose<Dim>& pose) const { return held_->placed(bytes_.data(), pose); }

    /// Of the shape that is held [m].
    double half_thickness() const { return held_->half_thickness(bytes_.data()); }

    /// Which of the list it is, and the shape itself.
    void write(NumberRecord& out) const requires(Recordable<Shapes>&&...) {
        out.integer(held_->index);
        held_->write(bytes_.data(), out);
    }
    static AnyShapeOf read(NumberRecordReader& in) requires(Recordable<Shapes>&&...) {
        const auto kind = in.integer<std::size_t>(0, sizeof...(Shapes) - 1);
        std::optional<AnyShapeOf> shape;
        std::size_t k = 0;
        ((k++ == kind ? void(shape.emplace(Shapes::read(in))) : void()), ...);
        return *shape;
    }

  private:
    template <class S>
    static constexpr std::size_t index_of() {
        std::size_t index = 0;
        static_cast<void>(((std::same_as<S, Shapes> || (++index, false)) || ...));
        return index;
    }
    template <class S>
    static constexpr detail::HeldShape<Dim, AnyShapeOf> table =
        detail::make_held_shape<Dim, AnyShapeOf, S>(index_of<S>());

    template <class Question, class S, class... Others>
    decltype(auto) ask(Question& question) const {
        const S* shape = get_if<S>();
        if constexpr (sizeof...(Others) > 0) {
            if (!shape) return ask<Question, Others...>(question);
        }
        return question(*shape);
    }

    const detail::HeldShape<Dim, AnyShapeOf>* held_;
    alignas(
        std::max({alignof(Shapes)...})) std::array<std::byte, std::max({sizeof(Shapes)...})> bytes_;
};

/// Whether S is an AnyShapeOf.
template <class S>
inline constexpr bool is_any_shape = false;
template <int Dim, class... Shapes>
inline constexpr bool is_any_shape<AnyShapeOf<Dim, Shapes...>> = true;

}  // namespace talus
