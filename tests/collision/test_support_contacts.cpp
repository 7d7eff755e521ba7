// SPDX-License-Identifier: BSL-1.0
// Shapes of one's own, known by support mapping alone, against faces and sides far wider than they
// are: where the supports along the normal are corners far from the contact.
#include <talus/collision/narrow_phase.hpp>
#include <talus/core/column.hpp>
#include <talus/geometry/any_shape.hpp>

#include <Eigen/Core>
#include <boost/test/unit_test.hpp>

#include "common/dimensions.hpp"
#include "common/ellipsoid.hpp"
#include "common/random_geometry.hpp"
#include "stepping/experiment.hpp"

BOOST_AUTO_TEST_SUITE(collision_support_contacts)

using random_geometry::uniform;

template <int Dim>
struct Bead {
    double radius;

    talus::Vector<Dim> support(const talus::Vector<Dim>& d) const {
        return radius * d.normalized();
    }
    talus::Aabb<Dim> aabb(const talus::Pose<Dim>& pose) const {
        return talus::Aabb<Dim>{pose.position, pose.position}.expanded(radius);
    }
};

/// A box that tells its supports only.
template <int Dim>
struct Slab {
    talus::Vector<Dim> half;

    talus::Vector<Dim> support(const talus::Vector<Dim>& d) const {
        return (d.array() < 0.0).select(-half, half);
    }
    talus::Aabb<Dim> aabb(const talus::Pose<Dim>& pose) const {
        const talus::Vector<Dim> reach = pose.rotation.matrix().cwiseAbs() * half;
        return {pose.position - reach, pose.position + reach};
    }
};

/// How well a ball's direction from a shape `width` wide can be known: supports are rounded to
/// epsilon times the width, and change the distance to second order in the direction. The factor is
/// for the weights of thin triangles. Deep overlap blunts the best direction by (r + gap) / r.
double direction_accuracy(double width, double r, double gap = 0.0) {
    const double blunt = std::min(1.0, std::abs(r + gap) / r);
    return 20.0 * std::sqrt(std::numeric_limits<double>::epsilon() * (1.0 + width / r)) / blunt;
}
double point_accuracy(double width, double r, double gap = 0.0) {
    return r * direction_accuracy(width, r, gap);
}
/// 1e-10 of the smaller size is promised; places are rounded relative to the larger.
double gap_accuracy(double width, double r) { return 2e-10 * r + 1e-14 * width; }

template <int Dim, class A, class B>
talus::ContactPoint<Dim> contact(const A& a, const talus::Pose<Dim>& at_a, const B& b,
                                 const talus::Pose<Dim>& at_b, double margin) {
    talus::Column<talus::ContactPoint<Dim>> found;
    talus::contact_points<Dim>(a, at_a, b, at_b, margin, found);
    BOOST_REQUIRE_EQUAL(found.size(), 1u);
    return found[0];
}

// A query for overlaps deeper than some depth alone.
BOOST_AUTO_TEST_CASE_TEMPLATE(a_margin_below_zero_keeps_what_is_deeper, D, dimensions) {
    constexpr int Dim = D::value;
    const auto shift = 0.12 * talus::Vector<Dim>::Unit(0);
    for (const double margin : {-0.05, -0.1}) {
        talus::Column<talus::ContactPoint<Dim>> found, exact;
        talus::contact_points<Dim>(Bead<Dim>{0.1}, {}, Bead<Dim>{0.1}, {shift, {}}, margin, found);
        talus::contact_points<Dim>(talus::Ball<Dim>{0.1}, {}, talus::Ball<Dim>{0.1}, {shift, {}},
                                   margin, exact);
        BOOST_TEST(found.size() == exact.size());
        BOOST_TEST(found.size() == (margin == -0.05 ? 1u : 0u));
    }
}

/// Contacts of a bead with `base`, at random places all around it and of given gap, against those
/// of a ball in its place, which are in closed form.
template <int Dim, class Base>
void bead_acts_like_ball(random_geometry::Generator& g, const Base& base, double width, double r,
                         double gap) {
    const talus::Aabb<Dim> box = base.aabb(talus::Pose<Dim>{});
    for (int trial = 0; trial < 30; ++trial) {
        talus::Pose<Dim> local = random_geometry::pose<Dim>(g, 1.0);
        for (int k = 0; k < Dim; ++k)
            local.position[k] = uniform(g, box.low[k] - r, box.high[k] + r);
        const int side = trial % (2 * Dim), k = side / 2;
        local.position[k] = side % 2 == 0 ? box.low[k] - 2.0 * r : box.high[k] + 2.0 * r;
        const auto far =
            contact<Dim>(talus::Ball<Dim>(r), local, base, talus::Pose<Dim>{}, 10.0 * width);
        local.position += (gap - far.gap) * far.normal;
        const auto at = random_geometry::pose<Dim>(g, 1.0);

        const auto exact = contact<Dim>(talus::Ball<Dim>(r), at * local, base, at, 1.0);
        const auto found = contact<Dim>(Bead<Dim>{r}, at * local, base, at, 1.0);
        BOOST_CHECK_SMALL(found.gap - exact.gap, gap_accuracy(width, std::min(r, width)));
        // Deep inside two faces may be as near.
        if (found.normal.dot(exact.normal) < 0.99 && gap < -r) continue;
        const double direction = direction_accuracy(width, r, gap),
                     place = point_accuracy(width, r, gap);
        BOOST_CHECK_SMALL((found.point - exact.point).norm(), place);
        BOOST_CHECK_SMALL((found.normal - exact.normal).norm(), direction);

        const auto mirrored = contact<Dim>(base, at, Bead<Dim>{r}, at * local, 1.0);
        BOOST_CHECK_SMALL((mirrored.point - exact.point).norm(), place);
        BOOST_CHECK_SMALL((mirrored.normal + exact.normal).norm(), direction);
    }
}

const double relative_gaps[] = {1e-2, 1e-5, -1e-9, -1e-4, -0.1, -0.9, -1.5};

template <int Dim>
talus::Box<Dim> block(double width, double height) {
    talus::Vector<Dim> half = talus::Vector<Dim>::Constant(0.5 * width);
    half[Dim - 1] = 0.5 * height;
    return talus::Box<Dim>(half);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_bead_acts_like_a_ball_on_boxes_of_any_width, D, dimensions) {
    constexpr int Dim = D::value;
    random_geometry::Generator g(31);
    for (const double width : {0.2, 1.0, 10.0, 100.0})
        for (const double height : {0.5, width})
            for (const double gap : relative_gaps)
                bead_acts_like_ball<Dim>(g, block<Dim>(width, height), width, 0.1, 0.1 * gap);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_bead_acts_like_a_ball_on_capsules_and_polytopes, D, dimensions) {
    constexpr int Dim = D::value;
    random_geometry::Generator g(32);
    for (const double gap : relative_gaps) {
        for (const double half : {0.2, 1.0, 10.0})
            bead_acts_like_ball<Dim>(g, talus::Capsule<Dim>(half, 0.1), 2.0 * half, 0.1, 0.1 * gap);
        const talus::ConvexPolytope<Dim> stone(random_geometry::corners<Dim>(g, 9, 1.0));
        bead_acts_like_ball<Dim>(g, stone, 2.0, 0.1, 0.1 * gap);
        bead_acts_like_ball<Dim>(g, talus::Ball<Dim>(1.0), 2.0, 0.1, 0.1 * gap);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(sizes_may_differ_a_thousandfold, D, dimensions) {
    constexpr int Dim = D::value;
    random_geometry::Generator g(33);
    for (const double r : {1e-3, 1e3})
        for (const double gap : {1e-5, -1e-5, -1e-2}) {
            // Overlap measured by the smaller: a big bead looks flat to a small body.
            const double depth = gap * std::min(r, 1.0), width = std::max(r, 1.0);
            bead_acts_like_ball<Dim>(g, talus::Ball<Dim>(1.0), 2.0 * width, r, depth);
            bead_acts_like_ball<Dim>(g, block<Dim>(1.0, 0.7), 2.0 * width, r, depth);
        }
}

/// The lowest point of an ellipsoid in closed form, above a face of talus' or one's own.
BOOST_AUTO_TEST_CASE_TEMPLATE(a_pebble_meets_a_face_below_its_lowest_point, D, dimensions) {
    constexpr int Dim = D::value;
    random_geometry::Generator g(34);
    talus::Vector<Dim> axes = talus::Vector<Dim>::Constant(0.07);
    axes[0] = 0.1;
    axes[Dim - 1] = 0.05;
    const Ellipsoid<Dim> pebble{axes};
    const talus::Vector<Dim> up = talus::Vector<Dim>::Unit(Dim - 1);
    for (const double width : {0.4, 1.0, 10.0, 100.0})
        for (const double gap : {1e-3, 1e-6, -1e-6, -1e-3, -1e-2, -0.04})
            for (int trial = 0; trial < 20; ++trial) {
                const auto base = block<Dim>(width, 1.0);
                const Slab<Dim> own{base.half_extents()};
                talus::Pose<Dim> local = random_geometry::pose<Dim>(g, 1.0);
                for (int k = 0; k < Dim - 1; ++k)
                    local.position[k] = 0.5 * (width - 0.25) * uniform(g, -1.0, 1.0);
                local.position[Dim - 1] = 0.0;
                const talus::Vector<Dim> low =
                    local.point_world(pebble.support(local.rotation.transpose_times(-up)));
                local.position[Dim - 1] = 0.5 + gap - low[Dim - 1];
                talus::Vector<Dim> place = low;
                place[Dim - 1] = 0.5 + 0.5 * gap;

                const auto at = random_geometry::pose<Dim>(g, 1.0);
                for (const auto& c : {contact<Dim>(pebble, at * local, base, at, 1.0),
                                      contact<Dim>(pebble, at * local, own, at, 1.0)}) {
                    BOOST_CHECK_SMALL(c.gap - gap, gap_accuracy(width, 0.1));
                    BOOST_CHECK_SMALL((c.normal - at.rotation * up).norm(), 1e-7);
                    BOOST_CHECK_SMALL((c.point - at.point_world(place)).norm(),
                                      point_accuracy(width, 0.1));
                }
            }
}

/// As a bead sinks into a floor, the point goes down half as fast and not sideways, past touching
/// and past all limits between one way to find it and another.
BOOST_AUTO_TEST_CASE_TEMPLATE(the_point_passes_touching_without_a_jump, D, dimensions) {
    constexpr int Dim = D::value;
    const double r = 0.1;
    const talus::Vector<Dim> up = talus::Vector<Dim>::Unit(Dim - 1);
    for (const double width : {0.4, 1.0, 10.0, 100.0}) {
        const auto base = block<Dim>(width, 0.5);
        const auto check = [&](double gap) {
            talus::Pose<Dim> at;
            at.position = in_plane<Dim>(0.31 * width, 0.25 + r + gap);
            const auto c = contact<Dim>(Bead<Dim>{r}, at, base, talus::Pose<Dim>{}, 1.0);
            const talus::Vector<Dim> place = in_plane<Dim>(0.31 * width, 0.25 + 0.5 * gap);
            BOOST_CHECK_SMALL(c.gap - gap, gap_accuracy(width, r));
            BOOST_CHECK_SMALL((c.normal - up).norm(), 1e-6);
            BOOST_CHECK_SMALL((c.point - place).norm(), point_accuracy(width, r));
        };
        for (int i = -20; i <= 20; ++i) check(5e-8 * i);
        for (int e = -3; e > -17; --e)
            for (const double digit : {1.0, 2.0, 3.0, 5.0})
                for (const double sign : {1.0, -1.0}) check(sign * digit * std::pow(10.0, e));
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(bodies_about_the_same_centre_are_told_apart_by_their_size, D,
                              dimensions) {
    constexpr int Dim = D::value;
    random_geometry::Generator g(35);
    for (const double r : {1e-3, 0.1, 1.0, 1e3}) {
        const auto at = random_geometry::pose<Dim>(g, 1.0);
        const auto balls = contact<Dim>(Bead<Dim>{r}, at, talus::Ball<Dim>(1.0), at, 0.0);
        BOOST_CHECK_SMALL(balls.gap + r + 1.0, 1e-10 * (1.0 + r));
        BOOST_CHECK_SMALL(balls.normal.norm() - 1.0, 1e-14);
        // Half-way between the two surfaces: from r on this side to 1 on the other.
        BOOST_CHECK_SMALL((balls.point - at.position).norm() - 0.5 * std::abs(1.0 - r),
                          1e-6 * (1.0 + r));
        // Of a bead that large, leaving by one side or another is the same to 1e-3.
        if (r > 100.0) continue;
        const auto box = contact<Dim>(Bead<Dim>{r}, at, block<Dim>(3.0, 1.0), at, 0.0);
        BOOST_CHECK_SMALL(box.gap + r + 0.5, 1e-10 * (1.0 + r));
        BOOST_CHECK_SMALL(
            std::abs(box.normal.dot(at.rotation * talus::Vector<Dim>::Unit(Dim - 1))) - 1.0, 1e-9);
        BOOST_CHECK_SMALL((box.point - at.position).norm() - 0.5 * std::abs(0.5 - r),
                          1e-6 * (1.0 + r));
    }
}

/// A flat face on a wider one has one point still, but on both.
BOOST_AUTO_TEST_CASE_TEMPLATE(a_slab_on_a_wide_box_has_its_point_below_itself, D, dimensions) {
    constexpr int Dim = D::value;
    random_geometry::Generator g(36);
    for (const double width : {1.0, 10.0, 100.0})
        for (const double gap : {1e-4, 1e-7, -1e-7, -1e-4, -1e-2})
            for (int trial = 0; trial < 20; ++trial) {
                const Slab<Dim> slab{talus::Vector<Dim>::Constant(0.1)};
                talus::Pose<Dim> local;
                for (int k = 0; k < Dim - 1; ++k)
                    local.position[k] = 0.5 * (width - 0.2) * uniform(g, -1.0, 1.0);
                local.position[Dim - 1] = 0.35 + gap;
                const auto at = random_geometry::pose<Dim>(g, 1.0);
                const auto c = contact<Dim>(slab, at * local, block<Dim>(width, 0.5), at, 1.0);
                const talus::Vector<Dim> place = at.inverse().point_world(c.point);
                BOOST_CHECK_SMALL(c.gap - gap, gap_accuracy(width, 0.1));
                BOOST_CHECK_SMALL(place[Dim - 1] - 0.25 - 0.5 * gap, 1e-8);
                for (int k = 0; k < Dim - 1; ++k)
                    BOOST_CHECK_LE(std::abs(place[k] - local.position[k]), 0.1 + 1e-8);
            }
}

using namespace experiment;

template <int Dim>
struct Beads : Sweeping<Dim> {
    using Shape = talus::AnyShapeOf<Dim, Bead<Dim>, talus::Box<Dim>>;
};

/// A bead on a box, its first velocity v: pure rolling goes on, and a bead that cannot turn slides
/// by v t - mu g t^2 / 2. It starts 1e-5 in the box, so that every step sees the overlap.
template <int Dim>
void bead_moves_along(double width, double mu, const talus::Inertia<Dim>& inertia,
                      const talus::Twist<Dim>& twist, double distance, double accuracy) {
    const double r = 0.1, depth = 1e-5, start = -0.15 * width;
    talus::SimulationParams params;
    params.h = 1e-3;
    talus::Simulation<Dim, Beads<Dim>> sim(law<Dim>(mu), params);
    sim.solver().params.tolerance = solver_tolerance;
    sim.system().gravity = -g * up<Dim>();
    sim.system().add_obstacle(block<Dim>(width, 1.0));
    const auto i = static_cast<std::size_t>(sim.system().add(
        Bead<Dim>{r}, inertia, {in_plane<Dim>(start, 0.5 + r - depth), {}}, twist));
    BOOST_CHECK_LT(sim.run(0.3).residual.value, 1e-12);
    const auto& bodies = sim.system().bodies;
    BOOST_CHECK_SMALL(bodies.position[i][Dim - 1] - (0.5 + r - depth), 1e-6);
    BOOST_CHECK_SMALL(bodies.position[i][0] - start - distance, accuracy);
    BOOST_CHECK_SMALL(bodies.velocity[i][Dim - 1], 1e-5);
    if constexpr (Dim == 3) BOOST_CHECK_SMALL(bodies.position[i][1], 1e-6);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_bead_rolls_and_slides_on_a_wide_box, D, dimensions) {
    constexpr int Dim = D::value;
    const double r = 0.1, v = 1.0, mu = 0.2, t = 0.3;
    for (const double width : {1.5, 10.0, 100.0}) {
        bead_moves_along<Dim>(width, 0.5, round_inertia<Dim>(1.0, r),
                              {in_plane<Dim>(v, 0.0), rolling_spin<Dim>(v / r)}, v * t, 1e-6);
        bead_moves_along<Dim>(width, mu, point_mass<Dim>(1.0), {in_plane<Dim>(v, 0.0)},
                              v * t - 0.5 * mu * g * t * t, 1e-6);
    }
}

BOOST_AUTO_TEST_SUITE_END()
