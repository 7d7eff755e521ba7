// SPDX-License-Identifier: BSL-1.0
#include <Eigen/Core>

#include "harness/case.hpp"

namespace validation {
namespace E18 {

/// A frame of reference: what happens is turned, shifted and carried along with a velocity.
template <int Dim>
struct Frame {
    talus::Rotation<Dim> turn;
    V<Dim> shift = V<Dim>::Zero(), boost = V<Dim>::Zero();

    talus::Pose<Dim> pose(double t = 0.0) const { return {shift + t * boost, turn}; }
    talus::Twist<Dim> carry(const V<Dim>& velocity, const W<Dim>& spin) const {
        return {boost + turn * velocity, turn.spin_world(spin)};
    }
};

template <int Dim>
Frame<Dim> random_frame(std::mt19937_64& random) {
    std::uniform_real_distribution<double> component(-2.0, 2.0);
    Frame<Dim> frame;
    W<Dim> angles;
    for (auto& x : angles) x = component(random);
    frame.turn = talus::Rotation<Dim>::exp(angles);
    for (auto& x : frame.shift) x = component(random);
    for (auto& x : frame.boost) x = component(random);
    return frame;
}

template <int Dim>
struct Body {
    ShapeType<Dim> shape;
    talus::Inertia<Dim> inertia;
    talus::Pose<Dim> pose;
};

/// A body launched towards or along a floor.
template <int Dim>
struct Launch {
    std::string name;
    Law<Dim> contact;
    Body<Dim> body;
    V<Dim> velocity;
    W<Dim> spin;
    double h, duration;
};

template <int Dim>
Body<Dim> ball(double height) {
    constexpr double radius = 0.2;
    return {talus::Ball<Dim>(radius), round_inertia<Dim>(1.3, radius), {height * up<Dim>(), {}}};
}
/// A box that comes down on a corner.
template <int Dim>
Body<Dim> tilted_box() {
    V<Dim> half = V<Dim>::Constant(0.05);
    half[0] = 0.2, half[Dim - 1] = 0.1;
    W<Dim> attitude = W<Dim>::Constant(0.4);
    attitude[0] = 0.7;
    return {talus::Box<Dim>(half),
            box_inertia<Dim>(1.3, half),
            {0.3 * up<Dim>(), talus::Rotation<Dim>::exp(attitude)}};
}
/// A rod of one metre at 60 degrees to the floor, its foot at the origin.
template <int Dim>
Body<Dim> leaning_rod() {
    const double th = 60 * degree;
    return {Rod<Dim>{1.0},
            rod_inertia<Dim>(1.0, 1.0),
            {0.5 * in_plane<Dim>(std::cos(th), std::sin(th)), tilt<Dim>(th)}};
}

/// Way, velocity and spin at the end, in the frame's own axes.
template <int Dim>
Eigen::VectorXd outcome(Trial<Dim>& trial, const Launch<Dim>& launch, const Frame<Dim>& frame,
                        Series* path = nullptr) {
    auto world = trial.world(
        {.h = launch.h, .contact = launch.contact, .gravity = frame.turn * V<Dim>(-g * up<Dim>())});
    world.add_obstacle(
        talus::HalfSpace<Dim>(up<Dim>()),
        talus::PrescribedMotion<Dim>::uniform(frame.pose(), {frame.boost, W<Dim>::Zero()}));
    const Body<Dim>& body = launch.body;
    world.add(body.shape, body.inertia,
              {frame.pose().point_world(body.pose.position), frame.turn * body.pose.rotation},
              frame.carry(launch.velocity, launch.spin));
    const auto way = [&](const World<Dim>& w) {
        return frame.pose(w.time()).point_body(w.bodies().position[1]);
    };
    world.run(launch.duration, [&](const auto& w) {
        if (path) path->x.push_back(w.time()), path->y.push_back(way(w)[0]);
    });
    const auto twist = world.bodies().twist(1);
    Eigen::VectorXd state(2 * Dim + talus::rotation_dof<Dim>);
    state << way(world), frame.turn.transpose_times(twist.linear - frame.boost),
        frame.turn.spin_body(twist.angular);
    return state;
}

template <int Dim>
void run(Trial<Dim>& trial) {
    V<Dim> skew = in_plane<Dim>(3.0, -2.0);
    V<Dim> along = in_plane<Dim>(2.0, 0.0);
    if constexpr (Dim == 3) {
        skew = {2.4, 1.8, -2.0};
        along = {1.8, -0.9, 0.0};
    }
    const std::vector<Launch<Dim>> launches{
        {"slide to roll", law<Dim>(0.3), ball<Dim>(0.2), along, W<Dim>::Zero(), 3e-3, 0.5},
        {"backspin", law<Dim>(0.3), ball<Dim>(0.2), along, rolling_spin<Dim>(-40.0), 3e-3, 0.5},
        {"oblique impact, slipping", law<Dim>(0.1, 0.8), ball<Dim>(0.3), skew, W<Dim>::Zero(), 1e-2,
         0.15},
        {"oblique impact, sticking", law<Dim>(0.9, 0.8, 0.5), ball<Dim>(0.3), skew, W<Dim>::Zero(),
         1e-2, 0.15},
        {"box on a corner", law<Dim>(0.4, 0.5), tilted_box<Dim>(), skew, W<Dim>::Zero(), 3e-3,
         0.12},
        {"rod, impact without collision", law<Dim>(2.0), leaning_rod<Dim>(),
         in_plane<Dim>(-1.0, 0.0), W<Dim>::Zero(), 1e-3, 0.02}};
    auto random = trial.rng();
    for (const Launch<Dim>& launch : launches) {
        Series seen{"in another frame", {}, {}}, reference{"in the first frame", {}, {}, true};
        const Eigen::VectorXd expected = outcome(trial, launch, Frame<Dim>{}, &reference);
        Worst worst;
        for (int k = 0; k < 8; ++k)
            worst.see(outcome(trial, launch, random_frame<Dim>(random), k == 0 ? &seen : nullptr),
                      expected);
        trial.within("way, velocity and spin, " + launch.name, worst, 1e-11,
                     "rounding of coordinates of some metres over some hundred steps", launch.h);
        trial.curves(
            {"way along the first axis, " + launch.name, "t [s]", "x [m]", {seen, reference}});
    }
}

const Register e18(
    {.id = "E18",
     .name = "frame-invariance",
     .title = "The same in every frame",
     .gate = 1,
     .setup = "A ball that begins to roll, one with backspin, two that strike the floor at an "
              "angle, slipping and sticking with restitution, a box that strikes with a corner, "
              "and a rod at 60 degrees whose foot "
              "slides at 1 m/s with friction 2 the way that jams (C02); each also with everything "
              "turned and shifted at random and carried along at some metres per second, in eight "
              "frames.",
     .reference = {"x' = R x + s + V t",
                   "the same way, velocity and spin in the axes of the frame"},
     .compared = "Way, velocity and spin at the end, in the axes of the frame.",
     .kind = Class::R,
     .why = "Nothing in the method prefers a direction, a place or a frame: rounding only. In "
            "space a contact whose tangents bias friction would show, and an inertia tensor that "
            "does not turn with the rod.",
     .source = "Galilei 1632; derived here.",
     .catches = {Fault::axis_bias, Fault::faceted_cone, Fault::obstacle_velocity_forgotten,
                 Fault::stale_inertia}},
    run<2>, run<3>, __FILE__);

}  // namespace E18
}  // namespace validation
