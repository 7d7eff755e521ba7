// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/dynamics/bodies.hpp>
#include <talus/geometry/half_space.hpp>
#include <talus/geometry/shape_view.hpp>
#include <talus/io/series/directions.hpp>
#include <talus/io/vtk.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace talus {

/// How bodies are drawn for ParaView.
struct VtkShapesParams {
    std::size_t meridians = 16;  ///< of what is round; even, from 4 to 1000
    /// Half the side of the square (in the plane the line) that is drawn of a half-space, about the
    /// point of its surface nearest to the body's origin [m]; 0: none. Holes are not drawn.
    double wall = 0.0;
};

/// The shapes of bodies where they are, as polygons with numbers of each body, for a VtkSeries:
///
///     const VtkShapes<3> shapes(sim.system().bodies, sim.system().shapes());
///     const VtkPolyData& polygons = shapes.data();  // for VtkSeries::add
///
/// Sharp shapes are drawn by their own faces, in the plane by their outline; of round ones those
/// points that are farthest in directions all around. What a shape is of a compound, or holds, is
/// drawn each for itself. Fields are the serial of the body's id ("body"), its velocity and spin.
template <int Dim>
requires SpaceDimension<Dim>
class VtkShapes {
  public:
    /// Throws input_error for parameters out of range, and if there is not a shape for each body.
    template <class ShapeType>
    VtkShapes(const Bodies<Dim>& bodies, std::span<const ShapeType> shapes,
              const VtkShapesParams& params = {})
        : around_(checked(params).meridians), wall_(params.wall), count_(bodies.count()) {
        require_count("shapes", shapes.size(), "bodies", bodies.count());
        std::vector<double> serial(count_);
        std::vector<Vector<3>> velocity(count_), spin(count_);
        for (std::size_t i = 0; i < count_; ++i) {
            add_shape(i, view_of<Dim>(shapes[i]), bodies.pose(i));
            serial[i] = static_cast<double>(bodies.id[i].serial);
            velocity[i] = in_space(bodies.velocity[i]);
            spin[i] = spin_in_space(bodies.spin[i]);
        }
        add("body", serial);
        add_vectors("velocity [m/s]", velocity);
        add_vectors("spin [rad/s]", spin);
    }

    /// A number of each body, such as its load. Throws input_error if there is not one for each.
    void add(std::string name, std::span<const double> of_bodies) {
        require_count("values of the field '" + name + "'", of_bodies.size(), "bodies", count_);
        VtkField field{std::move(name), 1, {}};
        for (const std::size_t i : owner_) field.values.push_back(of_bodies[i]);
        data_.cell_fields.push_back(std::move(field));
    }
    const VtkPolyData& data() const { return data_; }

  private:
    static constexpr bool in_plane = rotation_dof<Dim> == 1;
    static const VtkShapesParams& checked(const VtkShapesParams& params) {
        require_in("meridians", static_cast<double>(params.meridians), 4.0, 1000.0);
        if (params.meridians % 2 != 0)
            detail::reject("meridians", static_cast<double>(params.meridians), "even");
        require_non_negative("wall", params.wall);
        return params;
    }
    static Vector<3> in_space(const Vector<Dim>& v) {
        Vector<3> x = Vector<3>::Zero();
        for (int d = 0; d < Dim; ++d) x[d] = v[d];
        return x;
    }
    static Vector<3> spin_in_space(const AngularVector<Dim>& spin) {
        if constexpr (in_plane)
            return Vector<3>(0.0, 0.0, spin[0]);
        else
            return spin;
    }
    void add_vectors(std::string name, const std::vector<Vector<3>>& of_bodies) {
        VtkField field{std::move(name), 3, {}};
        for (const std::size_t i : owner_)
            field.values.insert(field.values.end(), of_bodies[i].data(), of_bodies[i].data() + 3);
        data_.cell_fields.push_back(std::move(field));
    }

    void add_shape(std::size_t body, const ShapeView<Dim>& shape, const Pose<Dim>& pose) {
        switch (shape.kind()) {
            case ShapeKind::compound:
                for (std::size_t k = 0; k < shape.bounds().size(); ++k)
                    add_shape(body, shape.child(k), pose);
                return;
            case ShapeKind::half_space:
                return add_wall(body, shape.template as<HalfSpace<Dim>>().placed(pose),
                                pose.position);
            case ShapeKind::core:
                if (shape.core().radius == 0.0) return add_core(body, shape.core(), pose);
                return add_outline(body, shape, pose);
            case ShapeKind::ball:
            case ShapeKind::convex:
                return add_outline(body, shape, pose);
            default:
                return;  // holes, and what tells no more than its box
        }
    }
    /// The points must have been added from `first` on.
    template <class Face>
    void add_face(std::size_t body, std::size_t first, const Face& face) {
        VtkPolyData::Cell cell;
        for (const auto v : face) cell.push_back(static_cast<std::int64_t>(first + v));
        data_.polygons.push_back(std::move(cell));
        owner_.push_back(body);
    }
    std::size_t add_points(std::span<const Vector<Dim>> points, const Pose<Dim>& pose) {
        const std::size_t first = data_.points.size();
        for (const Vector<Dim>& x : points) data_.points.push_back(in_space(pose.point_world(x)));
        return first;
    }
    void add_core(std::size_t body, const CoreView<Dim>& core, const Pose<Dim>& pose) {
        const std::size_t first = add_points(core.vertices, pose);
        if constexpr (in_plane) {
            // Its sides, one after the other, as a polygon.
            std::vector<std::uint32_t> after(core.vertices.size(), 0), outline;
            for (std::size_t f = 0; f < core.face_count(); ++f)
                after[core.face(f)[0]] = core.face(f)[1];
            std::uint32_t v = 0;
            do {
                outline.push_back(v);
                v = after[v];
            } while (v != 0 && outline.size() < after.size());
            add_face(body, first, outline);
        } else {
            for (std::size_t f = 0; f < core.face_count(); ++f) add_face(body, first, core.face(f));
        }
    }
    void add_outline(std::size_t body, const ShapeView<Dim>& shape, const Pose<Dim>& pose) {
        std::vector<Vector<Dim>> points;
        for (const Vector<Dim>& d : around_.unit) points.push_back(shape.support(d));
        const std::size_t first = add_points(points, pose);
        if constexpr (in_plane) {
            std::vector<std::size_t> outline(points.size());
            for (std::size_t k = 0; k < outline.size(); ++k) outline[k] = k;
            add_face(body, first, outline);
        } else {
            for (const auto& face : around_.faces) add_face(body, first, face);
        }
    }
    void add_wall(std::size_t body, const HalfSpace<Dim>& wall, const Vector<Dim>& origin) {
        if (wall_ == 0.0) return;
        const Vector<Dim>& n = wall.normal();
        const Vector<Dim> centre = origin - (n.dot(origin) - wall.offset()) * n;
        std::vector<Vector<Dim>> corners;
        if constexpr (in_plane) {
            const Vector<2> along = wall_ * Vector<2>(-n[1], n[0]);
            corners = {centre - along, centre + along};
        } else {
            int least = 0;
            n.cwiseAbs().minCoeff(&least);
            const Vector<3> u =
                wall_ * Vector<3>(cross(n, Vector<3>(Vector<3>::Unit(least))).normalized());
            const Vector<3> v = cross(n, u);
            corners = {centre - u - v, centre + u - v, centre + u + v, centre - u + v};
        }
        const std::size_t first = add_points(corners, Pose<Dim>{});
        std::vector<std::size_t> face(corners.size());
        for (std::size_t k = 0; k < face.size(); ++k) face[k] = k;
        add_face(body, first, face);
    }

    detail::Directions<Dim> around_;
    double wall_;
    std::size_t count_;
    VtkPolyData data_;
    std::vector<std::size_t> owner_;  // the body of each polygon
};

}  // namespace talus
