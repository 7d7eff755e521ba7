// SPDX-License-Identifier: BSL-1.0
#include <talus/geometry/any_shape.hpp>

namespace core_shape_concepts {

/// The least that the narrow phase treats by its vertices, edges and faces.
template <int Dim>
struct Cored {
    talus::CoreView<Dim> core() const;
};
static_assert(talus::CoreShape<Cored<2>, 2> && talus::CoreShape<Cored<3>, 3>);
static_assert(!talus::CoreShape<Cored<2>, 3>, "a polygon is no polyhedron");
static_assert(talus::CoreShape<talus::Ball<2>, 2> && talus::CoreShape<talus::Box<3>, 3>);
static_assert(!talus::CoreShape<talus::HalfSpace<3>, 3>, "a half-space has no vertices");
static_assert(!talus::CoreShape<talus::Compound<3>, 3>, "a compound has several cores");

struct OwnsItsCore {
    const talus::ConvexCore<3>& core() const;
};
static_assert(!talus::CoreShape<OwnsItsCore, 3>, "a core is handed out as a view");

/// A list of shapes of one's own is a shape like any other, and solid even with walls in it.
template <int Dim>
using Mixed = talus::AnyShapeOf<Dim, talus::Ball<Dim>, talus::HalfSpace<Dim>>;
static_assert(talus::SolidShape<Mixed<2>, 2> && talus::SolidShape<Mixed<3>, 3>);
static_assert(!talus::ConvexShape<Mixed<3>, 3>, "it may hold what is not convex");
static_assert(!std::is_constructible_v<Mixed<3>, talus::Box<3>>, "the list is closed");

}  // namespace core_shape_concepts
