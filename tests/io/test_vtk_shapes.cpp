// SPDX-License-Identifier: BSL-1.0
// Bodies as polygons: closed surfaces with their faces outwards, where the bodies are, each with
// the numbers of its body.
#include <talus/io/series/vtk_shapes.hpp>
#include <talus/stepping/simulation.hpp>

#include <boost/test/unit_test.hpp>

#include <numbers>
#include <string>
#include <vector>

#include "common/dimensions.hpp"

BOOST_AUTO_TEST_SUITE(io_vtk_shapes)

template <int Dim>
using V = talus::Vector<Dim>;

/// What the polygons of a body enclose, positive if they are counter-clockwise seen from outside
/// (in the plane: from above).
template <int Dim>
double enclosed(const talus::VtkPolyData& data, double body) {
    double sum = 0.0;
    for (std::size_t c = 0; c < data.polygons.size(); ++c) {
        if (data.cell_fields[0].values[c] != body) continue;
        const auto at = [&](std::size_t k) {
            const auto& cell = data.polygons[c];
            return data.points[static_cast<std::size_t>(cell[k % cell.size()])];
        };
        for (std::size_t k = 0; k < data.polygons[c].size(); ++k) {
            if constexpr (Dim == 2)
                sum += 0.5 * (at(k)[0] * at(k + 1)[1] - at(k)[1] * at(k + 1)[0]);
            else if (k + 2 < data.polygons[c].size())
                sum += at(0).dot(at(k + 1).cross(at(k + 2))) / 6.0;
        }
    }
    return sum;
}

template <int Dim>
talus::Pose<Dim> somewhere() {
    talus::Pose<Dim> pose;
    pose.position = V<Dim>::Constant(3.0);
    if constexpr (Dim == 2)
        pose.rotation = talus::Rotation<2>::exp(talus::AngularVector<2>(0.7));
    else
        pose.rotation = talus::Rotation<3>::exp(talus::AngularVector<3>(0.3, -0.4, 0.8));
    return pose;
}

template <int Dim>
struct Scene {
    talus::Simulation<Dim> sim{{talus::Coulomb<Dim>{.mu = 0.3}}, {.h = 1e-3}};
    std::vector<double> volume;

    template <class S>
    void add(const S& shape, double measure) {
        sim.system().add(shape, 1000.0, somewhere<Dim>(), {V<Dim>::Unit(1), {}});
        volume.push_back(measure);
    }
    talus::VtkShapes<Dim> drawn(const talus::VtkShapesParams& params = {}) {
        return talus::VtkShapes<Dim>(sim.system().bodies, sim.system().shapes(), params);
    }
};

BOOST_AUTO_TEST_CASE_TEMPLATE(surfaces_enclose_what_the_shapes_do, D, dimensions) {
    constexpr int Dim = D::value;
    Scene<Dim> scene;
    const double pi = std::numbers::pi;
    scene.add(talus::Box<Dim>(V<Dim>::Constant(0.5)), 1.0);
    scene.add(talus::Ball<Dim>(0.5), Dim == 2 ? pi / 4 : pi / 6);
    const double caps = Dim == 2 ? pi * 0.04 : 4.0 / 3 * pi * 0.008;
    scene.add(talus::Capsule<Dim>(0.3, 0.2), caps + (Dim == 2 ? 0.6 * 0.4 : 0.6 * pi * 0.04));
    const talus::Box<Dim> half(V<Dim>::Constant(0.5));
    scene.add(talus::Compound<Dim>({{half, {}}, {half, {V<Dim>::Unit(0), {}}}}), 2.0);
    const auto shapes = scene.drawn({.meridians = 64});
    for (std::size_t i = 0; i < scene.volume.size(); ++i) {
        const double serial = static_cast<double>(scene.sim.system().bodies.id[i].serial);
        // Of what is round the polygons are inscribed.
        const bool round = i == 1 || i == 2;
        BOOST_TEST(enclosed<Dim>(shapes.data(), serial) == scene.volume[i],
                   boost::test_tools::tolerance(round ? 1e-2 : 1e-12));
    }
    BOOST_TEST(!talus::vtp_text(shapes.data()).empty());
}

BOOST_AUTO_TEST_CASE_TEMPLATE(fields_are_of_the_body, D, dimensions) {
    constexpr int Dim = D::value;
    Scene<Dim> scene;
    scene.add(talus::Box<Dim>(V<Dim>::Constant(0.5)), 1.0);
    scene.add(talus::Ball<Dim>(0.5), 1.0);
    auto shapes = scene.drawn();
    const std::vector<double> load{7.0, 8.0};
    shapes.add("load [N]", load);
    const auto& fields = shapes.data().cell_fields;
    BOOST_REQUIRE(fields.size() == 4u);
    BOOST_TEST(fields[3].values.front() == 7.0);
    BOOST_TEST(fields[3].values.back() == 8.0);
    BOOST_TEST(fields[1].values[1] == 1.0);
    const std::vector<double> short_one{1.0};
    BOOST_CHECK_THROW(shapes.add("load [N]", short_one), talus::input_error);
    BOOST_TEST(shapes.data().cell_fields.size() == 4u);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(walls_are_drawn_as_far_as_is_asked, D, dimensions) {
    constexpr int Dim = D::value;
    Scene<Dim> scene;
    const V<Dim> n = V<Dim>::Constant(1.0).normalized();
    scene.sim.system().add_obstacle(talus::HalfSpace<Dim>(n, 0.5));
    BOOST_TEST(scene.drawn().data().polygons.empty());
    const auto shapes = scene.drawn({.wall = 2.0});
    BOOST_REQUIRE(shapes.data().polygons.size() == 1u);
    BOOST_TEST(shapes.data().points.size() == (Dim == 2 ? 2u : 4u));
    for (const auto& x : shapes.data().points) {
        V<Dim> flat;
        for (int d = 0; d < Dim; ++d) flat[d] = x[d];
        BOOST_TEST(n.dot(flat) == 0.5, boost::test_tools::tolerance(1e-12));
        BOOST_TEST(flat.norm() == std::sqrt(0.25 + (Dim == 2 ? 4.0 : 8.0)),
                   boost::test_tools::tolerance(1e-12));
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(what_cannot_be_drawn_is_refused_by_name, D, dimensions) {
    constexpr int Dim = D::value;
    Scene<Dim> scene;
    scene.add(talus::Ball<Dim>(0.5), 1.0);
    for (const talus::VtkShapesParams& params : {talus::VtkShapesParams{.meridians = 3},
                                                 {.meridians = 5},
                                                 {.meridians = 2000},
                                                 {.wall = -1.0}})
        BOOST_CHECK_THROW(scene.drawn(params), talus::input_error);
    const std::span<const talus::AnyShape<Dim>> none;
    BOOST_CHECK_EXCEPTION(talus::VtkShapes<Dim>(scene.sim.system().bodies, none),
                          talus::input_error, [](const auto& error) {
                              return std::string(error.what()).find("shapes") != std::string::npos;
                          });
}

BOOST_AUTO_TEST_SUITE_END()
