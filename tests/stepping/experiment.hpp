// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/geometry/ball.hpp>
#include <talus/geometry/half_space.hpp>
#include <talus/solver/sweeps/gauss_seidel.hpp>
#include <talus/stepping/gap_correction.hpp>
#include <talus/stepping/simulation.hpp>

#include <cmath>
#include <limits>
#include <numbers>

#include "common/in_plane.hpp"

/// Set-ups shared by the validation cases that run as unit tests. Gravity acts along minus the last
/// axis, the floor is x_last = 0, units are SI.
namespace experiment {

inline constexpr double g = 9.81;
inline constexpr double pi = std::numbers::pi;

/// Class R of the catalogue: rounding, relative to the scale of the case.
inline constexpr double class_r = 1e-12;
/// Tolerance of the solver where class R or S is asked.
inline constexpr double solver_tolerance = 1e-14;
/// Bodies placed in touch are so up to rounding of their coordinates, all of order 1 m.
inline constexpr double touching = 1e-10;

template <int Dim>
using V = talus::Vector<Dim>;
template <int Dim>
using W = talus::AngularVector<Dim>;

template <int Dim>
V<Dim> up() {
    return V<Dim>::Unit(Dim - 1);
}

using ::in_plane;

/// The spin that rolls a body towards + the first axis on the floor, of magnitude w. In the plane
/// that is clockwise, in space a turn about the second axis.
template <int Dim>
W<Dim> rolling_spin(double w) {
    if constexpr (Dim == 2)
        return W<2>(-w);
    else
        return W<3>(0.0, w, 0.0);
}

/// Inertia factor kap of I = kap m r^2: disc 1/2, sphere 2/5.
template <int Dim>
inline constexpr double kap = Dim == 2 ? 0.5 : 0.4;

template <int Dim>
talus::Inertia<Dim> round_inertia(double mass, double radius) {
    return {mass, W<Dim>::Constant(kap<Dim> * mass * radius * radius)};
}

template <int Dim>
talus::Inertia<Dim> point_mass(double mass) {
    return {mass, W<Dim>::Constant(std::numeric_limits<double>::infinity())};
}

template <int Dim>
talus::DefaultLaw<Dim> law(double mu, double e_n = 0.0, double e_t = 0.0) {
    return {{mu}, e_n, e_t};
}

/// Plain Gauss-Seidel, the paper's.
template <int Dim>
struct Sweeping : talus::SimulationTypes<Dim> {
    using Solver = talus::GaussSeidel<Dim, talus::DefaultLaw<Dim>>;
};

/// A simulation with a tight solver, gravity and (if asked) a floor as body 0.
template <int Dim>
talus::Simulation<Dim, Sweeping<Dim>> simulation(const talus::DefaultLaw<Dim>& contact_law,
                                                 double h, const V<Dim>& gravity,
                                                 bool floor = true) {
    talus::SimulationParams params;
    params.h = h;
    params.step.contact_tolerance = touching;
    talus::Simulation<Dim, Sweeping<Dim>> sim(contact_law, params);
    sim.solver().params.tolerance = solver_tolerance;
    sim.solver().params.max_sweeps = 100000;
    sim.system().gravity = gravity;
    if (floor) sim.system().add_obstacle(talus::HalfSpace<Dim>{up<Dim>(), 0.0});
    return sim;
}

/// Largest coordinate of a vector.
template <class Vec>
double largest(const Vec& v) {
    return v.cwiseAbs().maxCoeff();
}

}  // namespace experiment
