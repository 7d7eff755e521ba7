// SPDX-License-Identifier: BSL-1.0
#include <talus/spatial/inertia.hpp>
#include <talus/spatial/pose.hpp>
#include <talus/spatial/twist.hpp>

#include <type_traits>

namespace core_concepts {

template <int Dim>
constexpr bool is_space = talus::SpaceDimension<Dim>;

static_assert(is_space<2> && is_space<3>);
static_assert(!is_space<0> && !is_space<1> && !is_space<4> && !is_space<-2>);

/// Whether `Template<Dim>` can be named at all.
template <template <int> class Template, int Dim>
concept Exists = requires {
    typename Template<Dim>;
};

static_assert(Exists<talus::Pose, 2> && Exists<talus::Pose, 3> && !Exists<talus::Pose, 4>);
static_assert(Exists<talus::Twist, 2> && Exists<talus::Twist, 3> && !Exists<talus::Twist, 1>);
static_assert(Exists<talus::Inertia, 3> && !Exists<talus::Inertia, 4>);

static_assert(talus::rotation_dof<2> == 1 && talus::rotation_dof<3> == 3);
static_assert(talus::twist_dof<2> == 3 && talus::twist_dof<3> == 6);

// What is said of the plane and what is said of space do not mix.
static_assert(!std::is_convertible_v<talus::Pose<2>, talus::Pose<3>>);
static_assert(!std::is_convertible_v<talus::Rotation<2>, talus::Rotation<3>>);
static_assert(!std::is_convertible_v<double, talus::Rotation<2>>, "an angle is named as one");

/// Whether a matrix takes such a factor and such a divisor.
template <class M, class S>
concept Scales = requires(const M& m, S s) {
    m* s;
    s* m;
    m / s;
};

static_assert(Scales<talus::Vector<3>, double> && Scales<talus::Vector<3>, int>);
static_assert(!Scales<talus::SmallMatrix<3, 1, int>, double>, "halves of whole numbers are zero");

}  // namespace core_concepts
