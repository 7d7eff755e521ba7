// SPDX-License-Identifier: BSL-1.0
//
// A shape of one's own: an ellipse (in space an ellipsoid of revolution) that rocks on a floor. All
// a convex shape has to tell is a box around it and its support mapping. Small rocking without slip
// about the flat pole is a pendulum; its period follows from the curvature there.
// Sample run:  examples/run 03_own_shape
#include <talus/talus.hpp>

#include <cmath>
#include <cstdio>
#include <numbers>

/// Half axis `a` along all axes but the last, `b` along the last.
template <int Dim>
struct Ellipse {
    double a, b;  ///< [m]

    talus::Vector<Dim> axes() const {
        return a * talus::Vector<Dim>::Ones() + (b - a) * talus::Vector<Dim>::Unit(Dim - 1);
    }
    talus::Vector<Dim> support(const talus::Vector<Dim>& d) const {
        const talus::Vector<Dim> scaled = axes().cwiseProduct(d);
        return axes().cwiseProduct(scaled) / scaled.norm();
    }
    talus::Aabb<Dim> aabb(const talus::Pose<Dim>& pose) const {
        talus::Vector<Dim> reach;
        for (int k = 0; k < Dim; ++k) {
            const auto axis = pose.rotation.transpose_times(talus::Vector<Dim>::Unit(k));
            reach[k] = axes().cwiseProduct(axis).norm();
        }
        return {pose.position - reach, pose.position + reach};
    }
};
static_assert(talus::ConvexShape<Ellipse<3>, 3>);

template <int Dim>
struct WithEllipses : talus::SimulationTypes<Dim> {
    using Shape = talus::AnyShapeOf<Dim, Ellipse<Dim>, talus::HalfSpace<Dim>>;
};

template <int Dim>
void rock() {
    using namespace talus;
    const double a = 0.2, b = 0.1, m = 1.0, g = 9.81, h = 2e-4;
    const double moment = m * (a * a + b * b) / (Dim == 2 ? 4 : 5);  // about the rocking axis
    const Vector<Dim> up = Vector<Dim>::Unit(Dim - 1);

    Simulation<Dim, WithEllipses<Dim>> sim({Coulomb<Dim>{.mu = 1.0}}, {.h = h});
    auto& system = sim.system();
    system.gravity = -g * up;
    system.add_obstacle(HalfSpace<Dim>{up, 0.0});
    AngularVector<Dim> moments = AngularVector<Dim>::Constant(moment);
    AngularVector<Dim> tilt = AngularVector<Dim>::Zero();
    if constexpr (Dim == 3) moments[2] = 0.4 * m * a * a;
    tilt[Dim == 2 ? 0 : 1] = 0.01;
    const auto turned = Rotation<Dim>::exp(tilt);
    const Ellipse<Dim> ellipse{a, b};
    const double height = -(turned * ellipse.support(turned.transpose_times(-up)))[Dim - 1];
    system.add(ellipse, Inertia<Dim>{m, moments}, {height * up, turned});

    int crossings = 0;
    double first = 0.0, last = 0.0, before = 0.01;
    const RunSummary run = sim.run(4.0, [&](const auto& s) {
        const double angle = s.system().bodies.rotation[1].log()[Dim == 2 ? 0 : 1];
        if (angle * before < 0) {
            last = s.time() - h * angle / (angle - before);
            if (crossings++ == 0) first = last;
        }
        before = angle;
    });
    const double curvature_radius = a * a / b;  // at the flat pole
    const double period =
        2 * std::numbers::pi * std::sqrt((moment + m * b * b) / (m * g * (curvature_radius - b)));
    std::printf("%dD: period %.4f s, small-angle theory %.4f s, residual %.0e\n", Dim,
                2 * (last - first) / (crossings - 1), period, run.residual.value);
}

int main() {
    rock<2>();
    rock<3>();
}
