// SPDX-License-Identifier: BSL-1.0
#include <talus/law/rolling_coulomb.hpp>
#include <talus/problem/matrix_problem.hpp>
#include <talus/solver/sweeps/gauss_seidel.hpp>

#include <Eigen/Core>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <numbers>
#include <tuple>

#include "common/random_blocks.hpp"

BOOST_AUTO_TEST_SUITE(rolling_problems)

constexpr double g = 9.81, m = 2.0, R = 0.1;  // [m/s^2], [kg], [m]

/// A disc (a ball in space) on a plane, in the plane's axes, normal first: how u = map v comes from
/// the velocity v = (linear, angular).
struct Disc {
    static constexpr int rows = 3, dof = 3;
    static constexpr double inertia = 0.5 * m * R * R;
    static Eigen::Matrix3d map() {
        Eigen::Matrix3d x = Eigen::Matrix3d::Identity();
        x(1, 2) = -R;  // spin counted as that of rolling along + t
        return x;
    }
    /// Direction along the plane.
    static Eigen::Vector2d heading() { return {0.0, 1.0}; }
};
struct Ball {
    static constexpr int rows = 5, dof = 6;
    static constexpr double inertia = 0.4 * m * R * R;
    static Eigen::Matrix<double, 5, 6> map() {
        Eigen::Matrix<double, 5, 6> x = Eigen::Matrix<double, 5, 6>::Zero();
        x.leftCols<3>().topRows<3>().setIdentity();
        // u = v + spin x (-R n), frame (n, t1, t2) right-handed.
        x(1, 5) = -R, x(2, 4) = R;
        x(3, 4) = x(4, 5) = 1.0;
        return x;
    }
    static Eigen::Vector3d heading() { return {0.0, 0.8, 0.6}; }
};
using bodies = std::tuple<Disc, Ball>;

struct Motion {
    double along = 0.0;   ///< velocity down the slope [m/s]
    double spin = 0.0;    ///< magnitude [rad/s]
    double across = 0.0;  ///< speed in any other direction [m/s]
};

/// Velocity after `steps` steps from rest on an incline.
template <class Body>
Motion on_incline(double slope, double mu, double mu_r, double h, int steps) {
    constexpr int rows = Body::rows, dof = Body::dof, dim = (rows + 1) / 2;
    using Law = talus::RollingCoulomb<rows>;
    const Eigen::Matrix<double, rows, dof> map = Body::map();
    Eigen::Matrix<double, dof, 1> mobility = Eigen::Matrix<double, dof, 1>::Constant(1.0 / m);
    mobility.template tail<dof - dim>().setConstant(1.0 / Body::inertia);
    talus::AssembledProblem<rows, Law> p;
    p.delassus =
        talus::DelassusSparse<rows>(1, {{0, 0, map * mobility.asDiagonal() * map.transpose()}});
    p.free_velocity.resize(1);
    p.laws = {{mu, mu_r}};
    talus::GaussSeidel<rows, Law> solver({.max_sweeps = 10, .tolerance = 1e-14});
    std::vector<talus::Vector<rows>> r(1, talus::Vector<rows>::Zero());
    Eigen::Matrix<double, dof, 1> v = Eigen::Matrix<double, dof, 1>::Zero();
    for (int k = 0; k < steps; ++k) {
        v.template head<dim>() += g * h * std::sin(slope) * Body::heading();
        v[0] -= g * h * std::cos(slope);
        p.free_velocity[0] = map * v;
        const auto& report = solver.solve(p.delassus, p.free_velocity, p.laws, r);
        BOOST_TEST((report.status == talus::SolveStatus::converged));
        v += mobility.asDiagonal() * map.transpose() * r[0];
    }
    const double along = v.template head<dim>().dot(Body::heading());
    return {along, v.template tail<dof - dim>().norm(),
            (v.template head<dim>() - along * Body::heading()).norm()};
}

constexpr double h = 1e-3;
constexpr int steps = 100;
constexpr double duration = h * steps;
/// Velocities of order 1 m/s and spins of order 10 rad/s after a hundred steps, each to rounding.
constexpr double rounding = 1e-13;

// Rests iff tan(slope) <= mu_r / R; else rolls with
//   a = (g sin - g cos mu_r / R) / (1 + I / (m R^2)).
BOOST_AUTO_TEST_CASE_TEMPLATE(wheel_rests_on_a_slope_up_to_mu_r_over_R, Body, bodies) {
    const double slope = 10.0 * std::numbers::pi / 180.0, critical = R * std::tan(slope);
    const double kap = Body::inertia / (m * R * R);
    for (const double part : {0.0, 0.5, 0.999, 1.001, 3.0}) {
        const double mu_r = part * critical;
        const double a =
            std::max(0.0, (g * std::sin(slope) - g * std::cos(slope) * mu_r / R) / (1.0 + kap));
        const Motion end = on_incline<Body>(slope, 0.8, mu_r, h, steps);
        BOOST_TEST(std::abs(end.along - a * duration) < rounding);
        BOOST_TEST(std::abs(end.spin - a * duration / R) < 10.0 * rounding);
        BOOST_TEST(end.across < rounding);
    }
}

// Little friction, mu R > mu_r: it slides with g (sin - mu cos) and spins up with g cos (mu R -
// mu_r) m / I. With mu R < mu_r it slides without turning.
BOOST_AUTO_TEST_CASE_TEMPLATE(wheel_slides_and_rolls, Body, bodies) {
    const double slope = 40.0 * std::numbers::pi / 180.0, mu = 0.1;
    for (const double mu_r : {0.0, 0.3 * mu * R, 0.9 * mu * R, 1.1 * mu * R}) {
        const double a = g * (std::sin(slope) - mu * std::cos(slope));
        const double spin_up =
            std::max(0.0, g * std::cos(slope) * (mu * R - mu_r) * m / Body::inertia);
        const Motion end = on_incline<Body>(slope, mu, mu_r, h, steps);
        BOOST_TEST(std::abs(end.along - a * duration) < rounding);
        BOOST_TEST(std::abs(end.spin - spin_up * duration) < 10.0 * rounding);
        BOOST_TEST(end.across < rounding);
    }
}

// Several contacts with full blocks: converges, and to one velocity from any start and order.
BOOST_AUTO_TEST_CASE_TEMPLATE(problems_of_many_contacts_are_solved, Body, bodies) {
    constexpr int rows = Body::rows;
    using Law = talus::RollingCoulomb<rows>;
    using Vec = talus::Vector<rows>;
    RandomBlocks random(51);
    for (int k = 0; k < 20; ++k) {
        const std::size_t n = 6;
        std::vector<Eigen::Matrix<double, rows, 24>> maps;
        std::vector<Vec> free_velocity;
        for (std::size_t i = 0; i < n; ++i) {
            maps.push_back(random.normal<rows, 24>());
            free_velocity.push_back(random.normal<rows>());
        }
        std::vector<talus::DelassusBlock<rows>> blocks;
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j)
                blocks.push_back({i, j, maps[i] * maps[j].transpose()});
        talus::DelassusSparse<rows> w(n, blocks);
        const std::vector<Law> laws(n, Law{0.2, 0.1});
        std::vector<std::vector<Vec>> found;
        for (const auto order : {talus::SweepOrder::forward, talus::SweepOrder::random}) {
            talus::GaussSeidel<rows, Law> solver({100000, 1e-13, order, 3});
            std::vector<Vec> r(n);
            for (Vec& x : r) x = random.normal<rows>();
            const auto& report = solver.solve(w, free_velocity, laws, r);
            BOOST_TEST((report.status == talus::SolveStatus::converged));
            std::vector<Vec> u(n);
            w.multiply(r, u);
            found.push_back(u);
        }
        for (std::size_t i = 0; i < n; ++i) BOOST_TEST((found[0][i] - found[1][i]).norm() < 1e-9);
    }
}

BOOST_AUTO_TEST_SUITE_END()
