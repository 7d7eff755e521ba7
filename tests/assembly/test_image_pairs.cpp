// SPDX-License-Identifier: BSL-1.0
// Contacts in a periodic cell against all pairs of all images, one by one.
#include <talus/assembly/contact_detection.hpp>
#include <talus/collision/brute_force.hpp>
#include <talus/collision/hierarchical_grid.hpp>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "common/dimensions.hpp"
#include "common/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(assembly_image_pairs)

using random_geometry::uniform;

template <int Dim>
struct Crowd {
    talus::Bodies<Dim> bodies;
    std::vector<talus::AnyShape<Dim>> shapes;
    std::vector<double> radius, reach;
    talus::PeriodicCell<Dim> cell = talus::PeriodicCell<Dim>::box(talus::Vector<Dim>::Ones());

    void add(const talus::AnyShape<Dim>& shape, const talus::Pose<Dim>& pose, bool obstacle,
             double reach_) {
        const talus::Inertia<Dim> inertia{1.0, talus::AngularVector<Dim>::Ones()};
        if (obstacle)
            bodies.add_obstacle(pose);
        else
            bodies.add(inertia, pose);
        shapes.push_back(shape);
        const auto box = shape.aabb({});
        radius.push_back(box.bounded() ? box.low.cwiseAbs().cwiseMax(box.high).norm()
                                       : std::numeric_limits<double>::infinity());
        reach.push_back(reach_);
    }
    talus::ShapeList<Dim, talus::AnyShape<Dim>> list() const { return {shapes, radius, 1}; }

    /// In the order of the keys, from shifts of up to `far` lattice vectors.
    talus::ContactSet<Dim> all_images(int far) const {
        talus::ContactSet<Dim> found;
        talus::Column<talus::ContactPoint<Dim>> points;
        const auto most = [&](std::size_t k) {
            return k < cell.periodic().size() && cell.periodic()[k] ? far : 0;
        };
        for (std::size_t a = 0; a < shapes.size(); ++a)
            for (std::size_t b = a + 1; b < shapes.size(); ++b)
                for (int i = -most(0); i <= most(0); ++i)
                    for (int j = -most(1); j <= most(1); ++j)
                        for (int k = -most(2); k <= most(2); ++k) {
                            if (bodies.is_obstacle(a) && bodies.is_obstacle(b)) continue;
                            talus::ImageShift shift;
                            shift.n = {i, j, k};
                            const bool wall =
                                !std::isfinite(radius[a]) || !std::isfinite(radius[b]);
                            if (wall && !shift.is_zero()) continue;
                            const talus::Vector<Dim> offset = cell.offset(shift);
                            auto pose_a = bodies.pose(a), pose_b = bodies.pose(b);
                            pose_a.position -= 0.5 * offset;
                            pose_b.position += 0.5 * offset;
                            points.clear();
                            talus::contact_points<Dim>(shapes[a], pose_a, shapes[b], pose_b,
                                                       reach[a] + reach[b], points);
                            talus::sort_by_feature(points);
                            for (auto& point : points) {
                                point.point += 0.5 * offset;
                                found.push_back(static_cast<talus::BodyIndex>(a),
                                                static_cast<talus::BodyIndex>(b), point, shift,
                                                offset);
                            }
                        }
        return found;
    }
};

template <int Dim>
Crowd<Dim> random_crowd(random_geometry::Generator& g, int count, bool balls_alone) {
    Crowd<Dim> crowd;
    talus::Matrix<Dim> lattice = talus::Matrix<Dim>::Identity();
    for (int i = 0; i < Dim; ++i)
        for (int j = 0; j < Dim; ++j) lattice(i, j) += uniform(g, -0.35, 0.35);
    typename talus::PeriodicCell<Dim>::Directions periodic{};
    bool any = false;
    for (bool& along : periodic) any |= along = g() % 4 != 0;
    if (!any) periodic[0] = true;
    crowd.cell = talus::PeriodicCell<Dim>(lattice, talus::Matrix<Dim>::Zero(), periodic);
    for (int i = 0; i < count; ++i) {
        const int kind = balls_alone ? 0 : static_cast<int>(g() % 4);
        const auto shape = random_geometry::convex_shape<Dim>(g, kind, Dim == 2 ? 0.1 : 0.2);
        const auto pose = random_geometry::pose<Dim>(g, 2.0);
        const bool fixed = !balls_alone && g() % 5 == 0;
        crowd.add(shape, pose, fixed, uniform(g, 0.0, 0.02));
    }
    return crowd;
}

/// Bit for bit.
template <int Dim>
void check_same(const talus::ContactSet<Dim>& found, const talus::ContactSet<Dim>& expected) {
    BOOST_TEST_REQUIRE(found.count() == expected.count());
    for (std::size_t c = 0; c < found.count(); ++c) {
        BOOST_TEST((found.key[c] == expected.key[c]));
        BOOST_TEST(found.gap[c] == expected.gap[c]);
        BOOST_TEST((found.point[c] == expected.point[c]));
        BOOST_TEST((found.normal[c] == expected.normal[c]));
        BOOST_TEST((found.offset[c] == expected.offset[c]));
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(contacts_are_those_of_all_images, D, dimensions) {
    constexpr int Dim = D::value;
    using Shapes = talus::AnyShape<Dim>;
    random_geometry::Generator g(7);
    std::size_t contacts = 0, of_images = 0;
    for (int scene = 0; scene < (Dim == 2 ? 40 : 12); ++scene) {
        auto crowd = random_crowd<Dim>(g, Dim == 2 ? 12 : 8, false);
        talus::ContactDetection<Dim, Shapes, talus::HierarchicalGrid<Dim>> grid;
        talus::ContactDetection<Dim, Shapes, talus::BruteForce<Dim>> brute;
        talus::ContactSet<Dim> found, again;
        // Candidates are kept while the cell deforms and bodies move, some with it and some not.
        talus::Matrix<Dim> rate;
        for (int i = 0; i < Dim; ++i)
            for (int j = 0; j < Dim; ++j) rate(i, j) = uniform(g, -0.02, 0.02);
        crowd.cell.set_velocity_gradient(rate);
        for (int step = 0; step < 6; ++step) {
            const auto cell = talus::StepCell<Dim>::of(crowd.cell);
            grid.detect(crowd.bodies, crowd.list(), 0.05, crowd.reach, {}, 0.0, {}, found, cell);
            brute.detect(crowd.bodies, crowd.list(), 0.0, crowd.reach, {}, 0.0, {}, again, cell);
            check_same(found, crowd.all_images(Dim == 2 ? 9 : 6));
            check_same(again, found);
            contacts += found.count();
            for (const auto& key : found.key) of_images += key.image.is_zero() ? 0u : 1u;
            crowd.cell.advance(0.2);
            for (std::size_t i = 0; i < crowd.shapes.size(); ++i) {
                if (i % 3 != 0)
                    crowd.bodies.position[i] +=
                        0.2 * crowd.cell.velocity_at(crowd.bodies.position[i]);
                crowd.bodies.position[i] += 0.003 * random_geometry::direction<Dim>(g);
            }
        }
    }
    BOOST_TEST(contacts > 100u);
    BOOST_TEST(of_images > contacts / 4);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_sheared_lattice_is_the_same_lattice, D, dimensions) {
    // Whole shears change which image it is, not where: contacts are the same but for rounding.
    constexpr int Dim = D::value;
    random_geometry::Generator g(8);
    auto crowd = random_crowd<Dim>(g, 20, true);
    auto all = talus::PeriodicCell<Dim>::all_directions();
    crowd.cell = talus::PeriodicCell<Dim>(crowd.cell.lattice(), talus::Matrix<Dim>::Zero(), all);
    talus::Matrix<Dim> lattice = crowd.cell.lattice();
    lattice.col(1) += 20.0 * lattice.col(0);
    const talus::PeriodicCell<Dim> sheared(lattice);
    talus::ContactDetection<Dim, talus::AnyShape<Dim>, talus::HierarchicalGrid<Dim>> detection;
    talus::ContactSet<Dim> one, other;
    detection.detect(crowd.bodies, crowd.list(), 0.05, crowd.reach, {}, 0.0, {}, one,
                     talus::StepCell<Dim>::of(crowd.cell));
    detection.detect(crowd.bodies, crowd.list(), 0.05, crowd.reach, {}, 0.0, {}, other,
                     talus::StepCell<Dim>::of(sheared));
    BOOST_TEST_REQUIRE(one.count() == other.count());
    BOOST_TEST(one.count() > 3u);
    const auto gaps = [](const talus::ContactSet<Dim>& contacts) {
        std::vector<double> all_gaps(contacts.gap.begin(), contacts.gap.end());
        std::sort(all_gaps.begin(), all_gaps.end());
        return all_gaps;
    };
    for (std::size_t c = 0; c < one.count(); ++c)
        BOOST_TEST(std::abs(gaps(one)[c] - gaps(other)[c]) < 1e-13);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(permuted_bodies_have_the_same_contacts_to_rounding, D, dimensions) {
    constexpr int Dim = D::value;
    random_geometry::Generator g(9);
    auto crowd = random_crowd<Dim>(g, Dim == 2 ? 20 : 40, true);
    crowd.cell = talus::PeriodicCell<Dim>(crowd.cell.lattice());
    Crowd<Dim> turned;
    turned.cell = crowd.cell;
    const std::size_t n = crowd.shapes.size();
    for (std::size_t i = n; i-- > 0;)
        turned.add(crowd.shapes[i], crowd.bodies.pose(i), false, crowd.reach[i]);
    using Contact = std::tuple<talus::BodyIndex, talus::BodyIndex, talus::ImageShift, double,
                               std::vector<double>>;
    const auto contacts_of = [&](const Crowd<Dim>& scene, bool backwards) {
        talus::ContactDetection<Dim, talus::AnyShape<Dim>, talus::HierarchicalGrid<Dim>> detection;
        talus::ContactSet<Dim> found;
        detection.detect(scene.bodies, scene.list(), 0.05, scene.reach, {}, 0.0, {}, found,
                         talus::StepCell<Dim>::of(scene.cell));
        std::vector<Contact> list;
        for (std::size_t c = 0; c < found.count(); ++c) {
            auto [a, b, feature, image] = found.key[c];
            talus::Vector<Dim> normal = found.normal[c];
            if (backwards) {
                const auto last = static_cast<talus::BodyIndex>(n - 1);
                std::tie(a, b) = std::pair(last - b, last - a);
                for (auto& steps : image.n) steps = -steps;
                normal = -normal;
            }
            list.emplace_back(a, b, image, found.gap[c],
                              std::vector<double>(normal.data(), normal.data() + Dim));
        }
        std::sort(list.begin(), list.end());
        return list;
    };
    const auto forwards = contacts_of(crowd, false);
    BOOST_TEST(forwards.size() > 5u);
    const auto back = contacts_of(turned, true);
    BOOST_TEST_REQUIRE(back.size() == forwards.size());
    for (std::size_t c = 0; c < forwards.size(); ++c) {
        const auto& [a, b, image, gap, normal] = forwards[c];
        const auto& [other_a, other_b, other_image, other_gap, other_normal] = back[c];
        BOOST_TEST((std::tie(a, b, image) == std::tie(other_a, other_b, other_image)));
        BOOST_TEST(std::abs(gap - other_gap) < 1e-14);
        for (std::size_t d = 0; d < normal.size(); ++d)
            BOOST_TEST(std::abs(normal[d] - other_normal[d]) < 1e-13);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(walls_have_no_images, D, dimensions) {
    constexpr int Dim = D::value;
    Crowd<Dim> crowd;
    const talus::Vector<Dim> up = talus::Vector<Dim>::Unit(Dim - 1);
    typename talus::PeriodicCell<Dim>::Directions periodic{};
    periodic[0] = true;
    crowd.cell = talus::PeriodicCell<Dim>::box(talus::Vector<Dim>::Ones(), periodic);
    crowd.add(talus::HalfSpace<Dim>{up, 0.0}, {}, true, 0.0);
    for (const double x : {-57.2, 0.3, 12.95, 1e6})
        crowd.add(talus::Ball<Dim>(0.1), {x * talus::Vector<Dim>::Unit(0) + 0.1 * up, {}}, false,
                  1e-3);
    talus::ContactDetection<Dim, talus::AnyShape<Dim>, talus::HierarchicalGrid<Dim>> detection;
    talus::ContactSet<Dim> found;
    detection.detect(crowd.bodies, crowd.list(), 0.05, crowd.reach, {}, 0.0, {}, found,
                     talus::StepCell<Dim>::of(crowd.cell));
    std::size_t walls = 0;
    for (const auto& key : found.key) {
        if (key.a != 0) continue;
        BOOST_TEST(key.image.is_zero());
        ++walls;
    }
    BOOST_TEST(walls == 4u);
    // -57.2, 12.95 and 1e6 are images of 0.8, 0.95 and 1: each of the three touches the others.
    BOOST_TEST(found.count() == 7u);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(what_ends_on_one_side_meets_bodies_where_they_are, D, dimensions) {
    // A half-infinite box of a shape of one's own, whose image at home is far from the body.
    constexpr int Dim = D::value;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    using Box = talus::Aabb<Dim>;
    using V = talus::Vector<Dim>;
    const auto at = [](double x) {
        const V centre = x * V::Unit(0) + V::Constant(0.4);
        return Box{V(centre - V::Constant(0.1)), V(centre + V::Constant(0.1))};
    };
    Box half{V::Constant(-infinity), V::Constant(infinity)};
    half.low[0] = 5.0;
    const std::vector<Box> boxes{at(7.3), half, at(0.2), at(-6.5),
                                 Box{V::Constant(-infinity), V::Constant(infinity)}};
    talus::Column<bool> is_free{true, false, true, true, false};
    talus::BruteForce<Dim> broad;
    talus::ImagePairs<Dim> pairs;
    talus::Column<talus::CandidatePair> found;
    talus::Column<talus::ImageShift> images;
    const auto cell = talus::PeriodicCell<Dim>::box(V::Ones());
    pairs.find(talus::PairSearch<Dim>(broad), cell, boxes, is_free, found, images);
    std::vector<std::pair<int, int>> with_unbounded;
    for (std::size_t k = 0; k < found.size(); ++k) {
        if (found[k].b != 1 && found[k].a != 1 && found[k].b != 4) continue;
        with_unbounded.emplace_back(found[k].a, found[k].b);
        BOOST_TEST(images[k].is_zero());
    }
    const std::vector<std::pair<int, int>> expected{{0, 1}, {0, 4}, {2, 4}, {3, 4}};
    BOOST_TEST((with_unbounded == expected));
    // Two that are not bounded are a pair if one is free.
    is_free[4] = true;
    pairs.find(talus::PairSearch<Dim>(broad), cell, boxes, is_free, found, images);
    BOOST_TEST(std::count_if(found.begin(), found.end(), [](const talus::CandidatePair& pair) {
                   return pair.a == 1 && pair.b == 4;
               }) == 1);
}

BOOST_AUTO_TEST_SUITE_END()
