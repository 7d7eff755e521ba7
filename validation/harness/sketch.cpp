// SPDX-License-Identifier: BSL-1.0
#include "sketch.hpp"

#include <talus/io/svg.hpp>

#include <algorithm>
#include <variant>
#include <vector>

namespace validation {

namespace {

using P = talus::Vector<2>;
using Outline = std::vector<P>;

template <int Dim>
P flat(const V<Dim>& v) {
    return {v[0], v[Dim - 1]};
}

/// Convex hull, counter-clockwise (monotone chain).
Outline hull(Outline points) {
    std::sort(points.begin(), points.end(),
              [](const P& a, const P& b) { return a[0] < b[0] || (a[0] == b[0] && a[1] < b[1]); });
    Outline h;
    for (int pass = 0; pass < 2; ++pass) {
        const std::size_t base = h.size();
        for (const P& p : points) {
            while (h.size() >= base + 2) {
                const P u = h.back() - h[h.size() - 2], v = p - h.back();
                if (u[0] * v[1] - u[1] * v[0] > 0.0) break;
                h.pop_back();
            }
            h.push_back(p);
        }
        h.pop_back();
        std::reverse(points.begin(), points.end());
    }
    return h;
}

struct Frame {
    P low{1e300, 1e300}, high{-1e300, -1e300};
    void include(const P& p) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    double size() const { return (high - low).maxCoeff(); }
};

void arrow(talus::Svg& svg, const P& from, const P& way, double unit, const char* colour) {
    const double length = way.norm();
    if (!(length > 0.2 * unit)) return;
    const P d = way / length, n(-d[1], d[0]);
    const double head = std::min(unit, 0.5 * length);
    const P tip = from + way, neck = tip - head * d;
    svg.line(from, neck, {.stroke = colour, .stroke_width = 0.22 * unit, .round = true});
    const Outline triangle{tip, neck + 0.42 * head * n, neck - 0.42 * head * n};
    svg.polygon(triangle, {.fill = colour});
}

template <int Dim>
class Picture {
  public:
    explicit Picture(const World<Dim>& world) : world_(world), bodies_(world.bodies()) {
        for (std::size_t i = 0; i < bodies_.count(); ++i) include(i);
        if (!(frame_.size() > 0.0)) {
            frame_.include(frame_.low - P(1.0, 1.0));
            frame_.include(frame_.high + P(1.0, 1.0));
        }
        const P middle = 0.5 * (frame_.low + frame_.high);
        // No band thinner than half of its length, room for arrows all around.
        const P half = (0.5 * (frame_.high - frame_.low)).cwiseMax(0.25 * frame_.size()) * 1.7;
        frame_.low = middle - half;
        frame_.high = middle + half;
        unit_ = 0.028 * frame_.size();
    }
    std::string str() const {
        talus::Svg svg(frame_.low, frame_.high, 420.0);
        for (std::size_t i = 0; i < bodies_.count(); ++i)
            if (bodies_.is_obstacle(i)) draw_body(svg, i);
        for (std::size_t i = 0; i < bodies_.count(); ++i)
            if (!bodies_.is_obstacle(i)) draw_body(svg, i);
        draw_velocities(svg);
        draw_impulses(svg);
        return svg.str();
    }

  private:
    void include(std::size_t i) {
        const auto box = world_.system().shapes()[i].aabb(bodies_.pose(i));
        if (!box.bounded()) return;
        frame_.include(flat<Dim>(box.low));
        frame_.include(flat<Dim>(box.high));
    }
    void draw_body(talus::Svg& svg, std::size_t i) const {
        const bool obstacle = bodies_.is_obstacle(i);
        const talus::SvgStyle style{.fill = obstacle ? "#c9ccd1" : "#e9d8a6",
                                    .stroke = "#3c4043",
                                    .stroke_width = 0.08 * unit_,
                                    .round = true};
        const auto pose = bodies_.pose(i);
        world_.system().shapes()[i].visit(
            [&](const auto& shape) { draw_shape(svg, shape, pose, style); });
    }
    void draw_shape(talus::Svg& svg, const talus::Ball<Dim>& ball, const talus::Pose<Dim>& pose,
                    const talus::SvgStyle& style) const {
        const P centre = flat<Dim>(pose.position);
        // A point mass is drawn large enough to be seen.
        const double r = std::max(ball.radius(), 0.25 * unit_);
        svg.circle(centre, r, style);
        const V<Dim> mark = pose.rotation * V<Dim>(ball.radius() * V<Dim>::Unit(0));
        svg.line(centre, centre + flat<Dim>(mark),
                 {.stroke = "#8a7f5c", .stroke_width = 0.06 * unit_});
    }
    void draw_shape(talus::Svg& svg, const talus::HalfSpace<Dim>& half,
                    const talus::Pose<Dim>& pose, const talus::SvgStyle& style) const {
        const auto placed = half.placed(pose);
        P n = flat<Dim>(placed.normal());
        if (!(n.norm() > 0.1)) return;  // faces the viewer
        const double offset = placed.offset() / n.norm();
        n.normalize();
        const P t(-n[1], n[0]);
        const P middle = 0.5 * (frame_.low + frame_.high);
        const P on = middle + (offset - n.dot(middle)) * n;
        const double far = 3.0 * frame_.size();
        const Outline solid{on + far * t, on - far * t, on - far * t - far * n,
                            on + far * t - far * n};
        svg.polygon(solid, {.fill = style.fill});
        svg.line(on + far * t, on - far * t,
                 {.stroke = style.stroke, .stroke_width = style.stroke_width});
    }
    template <class Solid>
    requires requires(const Solid& s) { s.core().vertices; }
    void draw_shape(talus::Svg& svg, const Solid& solid, const talus::Pose<Dim>& pose,
                    const talus::SvgStyle& style) const {
        Outline points;
        for (const auto& v : solid.core().vertices)
            points.push_back(flat<Dim>(pose.point_world(v)));
        svg.polygon(hull(std::move(points)), style);
    }
    void draw_shape(talus::Svg& svg, const Rod<Dim>& rod, const talus::Pose<Dim>& pose,
                    const talus::SvgStyle&) const {
        svg.line(flat<Dim>(pose.point_world(rod.end(-1))), flat<Dim>(pose.point_world(rod.end(1))),
                 {.stroke = "#a3842c", .stroke_width = 0.35 * unit_, .round = true});
    }
    void draw_shape(talus::Svg& svg, const Bowl<Dim>& bowl, const talus::Pose<Dim>& pose,
                    const talus::SvgStyle& style) const {
        Outline arc;
        for (int k = 0; k <= 180; ++k) {
            const double a = 2.0 * pi * k / 180;
            arc.push_back(flat<Dim>(pose.position) + bowl.radius * P(std::cos(a), std::sin(a)));
        }
        svg.polyline(arc, {.fill = "none", .stroke = style.stroke, .stroke_width = 0.3 * unit_});
    }
    void draw_shape(talus::Svg& svg, const Rim& rim, const talus::Pose<3>& pose,
                    const talus::SvgStyle& style) const {
        Outline circle;
        for (int k = 0; k < 90; ++k) {
            const double a = 2.0 * pi * k / 90;
            circle.push_back(
                flat<3>(pose.point_world(rim.radius * V<3>(std::cos(a), std::sin(a), 0))));
        }
        svg.polygon(circle, style);
    }

    void draw_velocities(talus::Svg& svg) const {
        double fastest = 0.0;
        for (std::size_t i = 0; i < bodies_.count(); ++i)
            fastest = std::max(fastest, bodies_.velocity[i].norm());
        if (!(fastest > 1e-6)) return;
        const double scale = 0.16 * frame_.size() / fastest;
        for (std::size_t i = 0; i < bodies_.count(); ++i)
            arrow(svg, flat<Dim>(bodies_.position[i]), scale * flat<Dim>(bodies_.velocity[i]),
                  unit_, "#1f5fa8");
    }
    void draw_impulses(talus::Svg& svg) const {
        const auto& data = world_.data();
        double strongest = 0.0;
        for (const auto& r : data.impulse) strongest = std::max(strongest, r.norm());
        if (!(strongest > 0.0)) return;
        const double scale = 0.14 * frame_.size() / strongest;
        for (std::size_t c = 0; c < data.contact_count(); ++c) {
            const auto a = static_cast<std::size_t>(data.problem.jacobian.a[c]);
            const V<Dim> on_a = data.problem.jacobian.frame[c].transpose() * data.impulse[c];
            // Drawn as the push on the free body; towards A where both are free.
            const P push = (bodies_.is_obstacle(a) ? -scale : scale) * flat<Dim>(on_a);
            arrow(svg, flat<Dim>(data.contacts.point[c]), push, unit_, "#c0392b");
        }
    }

    const World<Dim>& world_;
    const talus::Bodies<Dim>& bodies_;
    Frame frame_;
    double unit_ = 1.0;
};

}  // namespace

template <int Dim>
std::string sketch(const World<Dim>& world) {
    return Picture<Dim>(world).str();
}
template std::string sketch<2>(const World<2>&);
template std::string sketch<3>(const World<3>&);

}  // namespace validation
