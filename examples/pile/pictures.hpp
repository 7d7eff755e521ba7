// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/io/pile_drawing.hpp>
#include <talus/io/space_drawing.hpp>
#include <talus/io/vtk.hpp>
#include <talus/io/write_file.hpp>
#include <talus/measure/grain_load.hpp>
#include <talus/sample/scene.hpp>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

namespace pile {

/// A point of the plane or of space as a point of space, the plane upright.
inline talus::Vector<3> in_space(const talus::Vector<2>& p) { return {p[0], p[1], 0.0}; }
inline talus::Vector<3> in_space(const talus::Vector<3>& p) { return p; }

/// A settled pile as plain figures, the input of all pictures. Grain k of the scene is body
/// `first + k` of the simulation, in its principal frame.
template <int Dim>
struct Snapshot {
    struct Grain {
        talus::Vector<Dim> centre, velocity;
        double radius, load;
        std::vector<talus::Vector<Dim>> corners;  ///< world; none for balls
        std::vector<talus::VertexLoop> faces;     ///< of polyhedra
    };
    std::vector<Grain> grains;
    std::vector<talus::DrawnContact<Dim>> contacts;
    talus::Vector<Dim> box_size;
};

/// Faces of a grain, by its corners; none for balls.
template <class AnyShape>
std::vector<talus::VertexLoop> faces(const AnyShape& shape) {
    std::vector<talus::VertexLoop> loops;
    if (const auto* polytope = shape.template get_if<talus::ConvexPolytope<3>>())
        for (std::size_t f = 0; f < polytope->core().face_count(); ++f) {
            const auto loop = polytope->core().face(f);
            loops.emplace_back(loop.begin(), loop.end());
        }
    return loops;
}

/// Corners of a grain in the world; none for balls.
template <int Dim, class AnyShape>
std::vector<talus::Vector<Dim>> world_corners(const AnyShape& shape, const talus::Pose<Dim>& pose) {
    std::vector<talus::Vector<Dim>> corners;
    if (const auto* polytope = shape.template get_if<talus::ConvexPolytope<Dim>>())
        for (const auto& v : polytope->vertices()) corners.push_back(pose.point_world(v));
    return corners;
}

template <class Simulation, int Dim>
Snapshot<Dim> snapshot(const Simulation& sim, const talus::Scene<Dim>& scene) {
    const auto& bodies = sim.system().bodies;
    const auto& data = sim.data();
    const std::size_t first = bodies.count() - scene.grains.size();
    std::vector<double> load;
    talus::grain_load<Dim>(data.problem.jacobian, data.impulse, bodies.count(), load);

    Snapshot<Dim> s;
    s.box_size = scene.box_size;
    for (std::size_t k = 0; k < scene.grains.size(); ++k) {
        const std::size_t i = first + k;
        s.grains.push_back({bodies.position[i],
                            bodies.velocity[i],
                            scene.grains[k].radius,
                            load[i] / data.h,
                            world_corners<Dim>(sim.system().shapes()[i], bodies.pose(i)),
                            {}});
        if constexpr (Dim == 3) s.grains.back().faces = faces(sim.system().shapes()[i]);
    }
    for (std::size_t c = 0; c < data.contact_count(); ++c) {
        const talus::Vector<Dim>& point = data.contacts.point[c];
        const auto end = [&](talus::BodyIndex body) {
            const auto i = static_cast<std::size_t>(body);
            return bodies.is_obstacle(i) ? point : bodies.position[i];
        };
        s.contacts.push_back({end(data.contacts.key[c].a), point, end(data.contacts.key[c].b),
                              data.impulse[c].norm() / data.h});
    }
    return s;
}

inline std::string picture(const Snapshot<2>& s, const talus::DrawingParams& params,
                           const std::string& title, const std::vector<std::string>& captions) {
    talus::PileDrawing drawing{s.box_size[0], {}, s.contacts, title, captions};
    for (const auto& g : s.grains)
        drawing.grains.push_back({g.centre, g.radius, g.load, g.corners});
    return talus::pile_svg(drawing, params);
}

inline std::string picture(const Snapshot<3>& s, const talus::DrawingParams& params,
                           const std::string& title, const std::vector<std::string>& captions) {
    talus::SpaceDrawing drawing{s.box_size.head<2>(), {}, s.contacts, title, captions};
    for (const auto& g : s.grains) {
        talus::DrawnSolid solid{g.centre, g.radius, g.load};
        for (const auto& face : g.faces) {
            solid.faces.emplace_back();
            for (const auto v : face) solid.faces.back().push_back(g.corners[v]);
        }
        drawing.grains.push_back(std::move(solid));
    }
    drawing.captions.push_back("Left: the back half of the pile. Right: the forces in all of it.");
    talus::DrawingParams thin = params;
    thin.strongest_width = 0.3;  // a network of space covers itself
    return talus::space_svg(drawing, thin);
}

/// Grains for ParaView: balls as points with their radius (to be shown as glyphs), discs and
/// polygons as polygons, polyhedra by their faces; load and velocity on every cell.
template <int Dim>
talus::VtkPolyData vtk_grains(const Snapshot<Dim>& s) {
    talus::VtkPolyData data;
    talus::VtkField load{"load [N]", 1, {}}, radius{"radius [m]", 1, {}},
        velocity{"velocity [m/s]", 3, {}};
    const auto add_cell = [&](auto& cells, const std::vector<talus::Vector<3>>& points,
                              const auto& grain) {
        cells.emplace_back();
        for (const auto& p : points) {
            cells.back().push_back(static_cast<std::int64_t>(data.points.size()));
            data.points.push_back(p);
        }
        load.values.push_back(grain.load);
        radius.values.push_back(grain.radius);
        for (const double v : in_space(grain.velocity)) velocity.values.push_back(v);
    };
    for (const auto& g : s.grains) {
        std::vector<talus::Vector<3>> points;
        if (g.corners.empty() && Dim == 3) {
            add_cell(data.vertices, {in_space(g.centre)}, g);
        } else if (g.corners.empty()) {
            constexpr int sides = 48;
            for (int k = 0; k < sides; ++k) {
                const double angle = 2 * std::numbers::pi * k / sides;
                points.push_back(in_space(g.centre) +
                                 g.radius * talus::Vector<3>(std::cos(angle), std::sin(angle), 0));
            }
            add_cell(data.polygons, points, g);
        } else if (g.faces.empty()) {
            for (const auto& p : g.corners) points.push_back(in_space(p));
            add_cell(data.polygons, points, g);
        }
        for (const auto& face : g.faces) {
            points.clear();
            for (const auto v : face) points.push_back(in_space(g.corners[v]));
            add_cell(data.polygons, points, g);
        }
    }
    data.cell_fields = {load, radius, velocity};
    return data;
}

/// Contacts for ParaView: polylines centre, contact, centre with the magnitude of the force.
template <int Dim>
talus::VtkPolyData vtk_contacts(const Snapshot<Dim>& s) {
    talus::VtkPolyData data;
    talus::VtkField force{"force [N]", 1, {}};
    for (const auto& c : s.contacts) {
        const auto first = static_cast<std::int64_t>(data.points.size());
        for (const auto* p : {&c.from, &c.point, &c.to}) data.points.push_back(in_space(*p));
        data.lines.push_back({first, first + 1, first + 2});
        force.values.push_back(c.force);
    }
    data.cell_fields = {force};
    return data;
}

/// Writes all pictures of a settled pile into the files of picture_files; returns their names.
template <class Simulation, int Dim>
std::vector<std::string> write_pictures(const Simulation& sim, const talus::Scene<Dim>& scene,
                                        double mean_grain_weight,
                                        const std::vector<std::filesystem::path>& files) {
    const auto s = snapshot(sim, scene);
    talus::DrawingParams params;
    if (mean_grain_weight > 0.0) {
        params.unit = mean_grain_weight;
        params.unit_name = "mean grain weights";
    }
    char caption[200];
    std::snprintf(caption, sizeof caption,
                  "Grey: sum of the normal forces on a grain. Red: contact forces. Residual of the "
                  "exact law %.1e.",
                  sim.data().report.residual);
    const bool balls = s.grains.front().corners.empty();
    const char* kind =
        Dim == 2 ? (balls ? " discs" : " polygons") : (balls ? " spheres" : " polyhedra");
    const std::string title = std::to_string(s.grains.size()) + kind + " after " +
                              talus::detail::text_of(sim.time()) + " s";
    std::vector<std::string> written;
    const auto write = [&](const std::string& text) {
        const auto& file = files[written.size()];
        talus::write_file(file, text);
        written.push_back(file.string());
    };
    write(picture(s, params, title, {caption}));
    write(talus::vtp_text(vtk_grains(s)));
    write(talus::vtp_text(vtk_contacts(s)));
    return written;
}

}  // namespace pile
