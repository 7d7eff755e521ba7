// SPDX-License-Identifier: BSL-1.0
#include "picture.hpp"

#include <talus/geometry/shape_view.hpp>
#include <talus/io/pile_drawing.hpp>
#include <talus/io/space_drawing.hpp>
#include <talus/io/write_file.hpp>
#include <talus/measure/grain_load.hpp>

#include <cmath>
#include <cstddef>
#include <numbers>

namespace lab {

template <int Dim>
std::vector<double> loads(const talus::Simulation<Dim>& sim) {
    std::vector<double> load;
    const auto& data = sim.data();
    talus::grain_load<Dim>(data.problem.jacobian, data.impulse, sim.system().bodies.count(), load);
    for (double& l : load) l /= data.h;
    return load;
}

namespace {

/// The outlines of a placed shape of the plane: of a compound one for each child; walls are cut off
/// at `size` [m].
void add_outlines(const talus::ShapeView<2>& shape, const talus::Pose<2>& pose, double load,
                  double size, std::vector<talus::DrawnGrain>& out) {
    using Kind = talus::ShapeKind;
    talus::DrawnGrain drawn{pose.position, size, load, {}};
    const auto arc = [&](const Point& centre, double radius, double from, double to) {
        const int sides = static_cast<int>(std::ceil(16.0 * std::abs(to - from)));
        for (int k = 0; k <= sides; ++k) {
            const double angle = from + (to - from) * k / sides;
            drawn.outline.push_back(centre + radius * Point(std::cos(angle), std::sin(angle)));
        }
    };
    switch (shape.kind()) {
        case Kind::ball: {
            const auto& ball = shape.as<talus::Ball<2>>();
            drawn.centre = ball.centre_world(pose);
            drawn.radius = ball.radius();
            break;
        }
        case Kind::core: {
            const talus::CoreView<2> core = shape.core();
            drawn.radius = core.bound;
            for (std::size_t f = 0; f < core.face_count(); ++f) {
                const Point corner = pose.point_world(core.vertices[core.face(f)[0]]);
                if (core.radius == 0.0) {
                    drawn.outline.push_back(corner);
                    continue;
                }
                const auto direction = [&](std::size_t face) {
                    const Point n = pose.rotation * core.normals[face];
                    return std::atan2(n[1], n[0]);
                };
                const std::size_t before = (f + core.face_count() - 1) % core.face_count();
                const double from = direction(before);
                double to = direction(f);
                while (to < from) to += 2.0 * std::numbers::pi;
                arc(corner, core.radius, from, to);
            }
            break;
        }
        case Kind::half_space: {
            const auto wall = shape.as<talus::HalfSpace<2>>().placed(pose);
            const Point along(-wall.normal()[1], wall.normal()[0]);
            const Point foot = wall.offset() * wall.normal();
            drawn.outline = {foot + size * along, foot - size * along,
                             foot - size * along - size * wall.normal(),
                             foot + size * along - size * wall.normal()};
            break;
        }
        case Kind::hole: {
            const auto hole = shape.as<talus::RoundHole<2>>().placed(pose);
            arc(hole.centre(), hole.radius(), 0.0, 2.0 * std::numbers::pi);
            arc(hole.centre(), hole.radius() + 0.03 * size, 2.0 * std::numbers::pi, 0.0);
            break;
        }
        case Kind::compound:
            for (std::size_t k = 0; k < shape.bounds().size(); ++k)
                add_outlines(shape.child(k), pose, load, size, out);
            return;
        default:
            break;  // a shape of one's own: the ball that holds it
    }
    out.push_back(std::move(drawn));
}

/// Whether a body is no grain: an obstacle, or a lid.
template <int Dim>
bool is_wall(const talus::Simulation<Dim>& sim, std::size_t i) {
    const auto kind = talus::view_of<Dim>(sim.system().shapes()[i]).kind();
    return sim.system().bodies.is_obstacle(i) || kind == talus::ShapeKind::half_space;
}

/// Contacts of the last step as segments from centre to centre; what is no grain ends at the point.
template <int Dim>
std::vector<talus::DrawnContact<Dim>> drawn_contacts(const talus::Simulation<Dim>& sim) {
    std::vector<talus::DrawnContact<Dim>> contacts;
    const auto& bodies = sim.system().bodies;
    const auto& data = sim.data();
    data.contacts.require_bodies(bodies.id);
    for (std::size_t c = 0; c < data.contact_count(); ++c) {
        const talus::Vector<Dim>& point = data.contacts.point[c];
        const auto end = [&](talus::BodyIndex body) {
            return is_wall(sim, static_cast<std::size_t>(body)) ? point : bodies.position[body];
        };
        contacts.push_back({end(data.contacts.key[c].a), point, end(data.contacts.key[c].b),
                            data.impulse[c].norm() / data.h});
    }
    return contacts;
}

/// The picture of the last step of a simulation of the plane, as SVG.
std::string picture(const talus::Simulation<2>& sim, const PictureParams& params) {
    const auto& system = sim.system();
    talus::PileDrawing drawing;
    drawing.window = params.window;
    drawing.title = params.title;
    drawing.captions = params.captions;
    drawing.lines = params.lines;
    const double size = (params.window.second - params.window.first).norm();
    const std::vector<double> load = loads(sim);
    for (std::size_t i = 0; i < system.bodies.count(); ++i) {
        auto& list = is_wall(sim, i) ? drawing.obstacles : drawing.grains;
        add_outlines(talus::view_of<2>(system.shapes()[i]), system.bodies.pose(i), load[i], size,
                     list);
    }
    drawing.contacts = drawn_contacts(sim);
    talus::DrawingParams how{.unit = params.unit, .unit_name = params.unit_name};
    if (params.strongest_width > 0.0) how.strongest_width = params.strongest_width;
    return talus::pile_svg(drawing, how);
}

/// The same of space: cut open, seen from one side; the window is of the two horizontal axes.
std::string picture(const talus::Simulation<3>& sim, const PictureParams& params) {
    const auto& system = sim.system();
    const Point low = params.window.first, extent = params.window.second - low;
    const talus::Vector<3> shift(-low[0], -low[1], 0.0);
    talus::SpaceDrawing drawing{extent, {}, drawn_contacts(sim), params.title, params.captions};
    for (auto& c : drawing.contacts)
        for (auto* p : {&c.from, &c.point, &c.to}) *p += shift;
    const std::vector<double> load = loads(sim);
    for (std::size_t i = 0; i < system.bodies.count(); ++i) {
        if (is_wall(sim, i)) continue;
        const talus::Vector<3> centre = system.bodies.position[i] + shift;
        const auto view = talus::view_of<3>(system.shapes()[i]);
        const double radius = view.has_core() ? view.core().bound : system.bounding_radius()[i];
        talus::DrawnSolid solid{centre, radius, load[i]};
        if (view.kind() == talus::ShapeKind::core)
            for (std::size_t f = 0; f < view.core().face_count(); ++f) {
                solid.faces.emplace_back();
                for (const auto v : view.core().face(f))
                    solid.faces.back().push_back(
                        system.bodies.pose(i).point_world(view.core().vertices[v]) + shift);
            }
        drawing.grains.push_back(std::move(solid));
    }
    drawing.captions.push_back("Left: the back half. Right: the forces in all of it.");
    return talus::space_svg(
        drawing, {.strongest_width = params.strongest_width > 0.0 ? params.strongest_width : 0.3,
                  .unit = params.unit,
                  .unit_name = params.unit_name});
}

}  // namespace

template <int Dim>
void write_picture(const std::filesystem::path& file, const talus::Simulation<Dim>& sim,
                   const PictureParams& params) {
    talus::write_file(file, picture(sim, params));
}

template std::vector<double> loads(const talus::Simulation<2>&);
template std::vector<double> loads(const talus::Simulation<3>&);
template void write_picture(const std::filesystem::path&, const talus::Simulation<2>&,
                            const PictureParams&);
template void write_picture(const std::filesystem::path&, const talus::Simulation<3>&,
                            const PictureParams&);

}  // namespace lab
