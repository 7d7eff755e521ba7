// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/contact_point.hpp>
#include <talus/core/column.hpp>
#include <talus/geometry/any_shape_of.hpp>
#include <talus/geometry/ball.hpp>
#include <talus/geometry/compound.hpp>
#include <talus/geometry/shape_view.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <span>
#include <type_traits>

namespace talus {

/// Contact routine for a pair of one's own shape types, preferred to everything talus knows:
/// specialise with a static function `append` of the signature of contact_points. One order of the
/// two types is enough, the other is served by mirroring. Codes of features are one's own, but of
/// children of compounds bits 20 to 31 and 52 to 63 give way to the numbers of the children.
template <int Dim, class A, class B>
struct PairContacts {};

template <int Dim, class A, class B>
concept HasPairContacts = requires(const A& a, const B& b, const Pose<Dim>& pose,
                                   Column<ContactPoint<Dim>>& out) {
    PairContacts<Dim, A, B>::append(a, pose, b, pose, 0.0, out);
};

/// A PairContacts routine for shapes whose types are told by the addresses of their tables.
template <int Dim>
requires SpaceDimension<Dim>
struct OwnPair {
    const ShapeAccess<Dim>* a;
    const ShapeAccess<Dim>* b;
    void (*append)(const void* a, const Pose<Dim>& pose_a, const void* b, const Pose<Dim>& pose_b,
                   double margin, Column<ContactPoint<Dim>>& out);
};

namespace detail {

template <class... S>
struct TypeList {};
template <class... S, class... T>
TypeList<S..., T...> operator+(TypeList<S...>, TypeList<T...>);

/// What an S holds: the list of an AnyShapeOf, the children of a compound.
template <class S>
struct Inner {
    using type = TypeList<>;
};
template <int Dim, class... Shapes>
struct Inner<AnyShapeOf<Dim, Shapes...>> {
    using type = TypeList<Shapes...>;
};
template <int Dim, class Child>
struct Inner<CompoundOf<Dim, Child>> {
    using type = TypeList<Child>;
};

/// S and everything that may be met within it, however deep.
template <class S>
struct Parts {
    template <class... Held>
    static auto all(TypeList<Held...>)
        -> decltype((TypeList<S>{} + ... + typename Parts<Held>::type{}));
    using type = decltype(all(typename Inner<S>::type{}));
};

/// Calls `visit.operator()<S, T>()` for all pairs of the two lists.
template <class S, class... T, class Visit>
constexpr void for_pairs_with(TypeList<T...>, const Visit& visit) {
    (visit.template operator()<S, T>(), ...);
}
template <class... S, class T, class Visit>
constexpr void for_pairs(TypeList<S...>, T list, const Visit& visit) {
    (for_pairs_with<S>(list, visit), ...);
}

/// The same for all that may meet when an A meets a B, in both orders.
template <class A, class B, class Visit>
constexpr void for_meetings(const Visit& visit) {
    for_pairs(typename Parts<A>::type{}, typename Parts<B>::type{}, visit);
    if constexpr (!std::same_as<A, B>)
        for_pairs(typename Parts<B>::type{}, typename Parts<A>::type{}, visit);
}

template <int Dim, class A, class B>
constexpr std::size_t own_pair_count() {
    std::size_t count = 0;
    for_meetings<A, B>([&]<class S, class T>() { count += HasPairContacts<Dim, S, T>; });
    return count;
}

template <int Dim, class A, class B>
constexpr auto make_own_pairs() {
    std::array<OwnPair<Dim>, own_pair_count<Dim, A, B>()> pairs{};
    std::size_t count = 0;
    for_meetings<A, B>([&]<class S, class T>() {
        if constexpr (HasPairContacts<Dim, S, T>)
            pairs[count++] = {
                &shape_access<Dim, S>, &shape_access<Dim, T>,
                [](const void* a, const Pose<Dim>& pose_a, const void* b, const Pose<Dim>& pose_b,
                   double margin, Column<ContactPoint<Dim>>& out) {
                    PairContacts<Dim, S, T>::append(*static_cast<const S*>(a), pose_a,
                                                    *static_cast<const T*>(b), pose_b, margin, out);
                }};
    });
    return pairs;
}

/// The routines of one's own for what an A and a B may hold, in either order. Empty for talus' own
/// shapes, which thus never look for one.
template <int Dim, class A, class B>
inline constexpr auto own_pairs = make_own_pairs<Dim, A, B>();

/// Whether an A or a B is or may hold a shape of that kind.
template <int Dim, class... S>
constexpr bool any_is(ShapeKind kind, TypeList<S...>) {
    return ((kind_of<S, Dim> == kind) || ...);
}
template <int Dim, class A, class B>
constexpr bool may_hold(ShapeKind kind) {
    return any_is<Dim>(kind, typename Parts<A>::type{}) ||
           any_is<Dim>(kind, typename Parts<B>::type{});
}

/// A type of shape that cannot be met; void if there is none.
template <class S>
struct Stranger {
    using type = S;
};
template <class S, class T>
constexpr auto operator|(Stranger<S> s, Stranger<T> t) {
    if constexpr (std::is_void_v<S>)
        return t;
    else
        return s;
}

/// The type within A or B that keeps the two from meeting: it has neither support mapping nor core,
/// and some shape of the other side has no routine of one's own with it.
template <int Dim, class A, class B>
constexpr auto find_stranger();

template <int Dim, class B, class... As>
constexpr auto find_stranger_among(TypeList<As...>) {
    return (find_stranger<Dim, As, B>() | ... | Stranger<void>{});
}
template <int Dim, class A, class B>
constexpr auto find_stranger() {
    if constexpr (is_any_shape<A>)
        return find_stranger_among<Dim, B>(typename Inner<A>::type{});
    else if constexpr (is_any_shape<B>)
        return find_stranger_among<Dim, A>(typename Inner<B>::type{});
    else if constexpr (HasPairContacts<Dim, A, B> || HasPairContacts<Dim, B, A>)
        return Stranger<void>{};
    else if constexpr (is_compound<A>)
        return find_stranger_among<Dim, B>(typename Inner<A>::type{});
    else if constexpr (is_compound<B>)
        return find_stranger_among<Dim, A>(typename Inner<B>::type{});
    else if constexpr (kind_of<A, Dim> == ShapeKind::stranger)
        return Stranger<A>{};
    else if constexpr (kind_of<B, Dim> == ShapeKind::stranger)
        return Stranger<B>{};
    else
        return Stranger<void>{};
}

/// That type, or a ball, which can meet all.
template <int Dim, class A, class B,
          class Found = typename decltype(find_stranger<Dim, A, B>())::type>
using LeastSociable = std::conditional_t<std::is_void_v<Found>, Ball<Dim>, Found>;

}  // namespace detail

/// Two shapes that the narrow phase can bring together: whatever they hold is convex and has a
/// support mapping, or has PairContacts with all that it can meet. A compiler that refuses a pair
/// shows the type at fault and what it lacks.
template <class A, class B, int Dim>
concept CanMeet =
    Shape<A, Dim> && Shape<B, Dim> && ConvexShape<detail::LeastSociable<Dim, A, B>, Dim>;

}  // namespace talus
