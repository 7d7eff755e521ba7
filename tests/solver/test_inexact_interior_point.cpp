// SPDX-License-Identifier: BSL-1.0
#include <talus/solver/cones/inexact_interior_point.hpp>

#include <Eigen/Dense>
#include <Eigen/LU>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

#include "common/dimensions.hpp"
#include "common/gallery_tester.hpp"
#include "common/random_problem.hpp"

BOOST_AUTO_TEST_SUITE(inexact_interior_point)

template <int Dim>
using Law = talus::Coulomb<Dim>;
template <int Dim>
using Problem = talus::ContactProblem<Dim, Law<Dim>>;
template <int Dim>
using Solver = talus::InexactInteriorPoint<Dim, Law<Dim>>;

constexpr int most = 80;  // Newton steps

/// The same problem twice: from its bodies, and from the blocks of W.
template <int Dim>
std::pair<talus::ConeSystem<Dim>, talus::ConeSystem<Dim>> both_forms(const Problem<Dim>& p) {
    const talus::DelassusSparse<Dim> w(p.jacobian, p.inverse_mass);
    talus::ResidualMeasure<Dim> measure;
    measure.prepare(w);
    std::vector<talus::FrictionCone<Dim>> cones;
    for (const auto& law : p.laws) cones.push_back({law.mu});
    std::pair<talus::ConeSystem<Dim>, talus::ConeSystem<Dim>> s;
    s.first.assign(talus::BodyMap<Dim>(p.jacobian, p.inverse_mass), p.free_velocity, cones,
                   measure);
    s.second.assign(w, p.free_velocity, cones, measure);
    return s;
}

/// D of an interior point: lower triangular in (n, t), of all sizes, with a positive definite
/// tangential block. `coupling` 1 is where D + D^T becomes singular.
template <int Dim>
std::vector<talus::Matrix<Dim>> random_d(RandomBlocks& random, std::size_t n, double coupling) {
    std::vector<talus::Matrix<Dim>> d(n);
    for (auto& x : d) {
        const double size = random.log_uniform(1e-6, 1e3);
        const auto g = random.template normal<Dim - 1, Dim - 1>();
        x.setZero();
        Eigen::Matrix<double, Dim - 1, Dim - 1> t = g * g.transpose();
        t.diagonal().array() += 0.3;
        x.template bottomRightCorner<Dim - 1, Dim - 1>() = t;
        x(0, 0) = random.log_uniform(0.1, 10.0);
        Eigen::Matrix<double, Dim - 1, 1> s = random.template normal<Dim - 1, 1>();
        s *= coupling * std::sqrt(4.0 * x(0, 0) / s.dot(t.inverse() * s));
        x.template bottomLeftCorner<Dim - 1, 1>() = s;
        x *= size;
    }
    return d;
}

template <int Dim>
auto inexact() {
    return [](double tolerance) {
        return Solver<Dim>(
            {.max_iterations = most, .tolerance = tolerance, .max_inner_iterations = 1000});
    };
}

template <int Dim>
Problem<Dim> tower(std::size_t height) {
    auto p = stack_of_particles<Dim>(std::vector<double>(height, 1.0), Law<Dim>{0.5});
    for (std::size_t c = 0; c < height; ++c)
        p.free_velocity[c] = (c == 0 ? -1.0 : 0.0) * talus::Vector<Dim>::Unit(0);
    return p;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(incomplete_factors_of_a_chain_are_complete, D, dimensions) {
    // A block tridiagonal matrix fills nothing in: its ILU(0) is its LU.
    constexpr int n = D::value, nodes = 7;
    RandomBlocks random(11);
    talus::BlockIlu<n> ilu;
    std::vector<std::pair<int, int>> edges;
    for (int i = 0; i + 1 < nodes; ++i) {
        edges.emplace_back(i, i + 1);
        edges.emplace_back(i + 1, i);
        edges.emplace_back(i, i + 1);  // repeated
    }
    ilu.analyze(nodes, edges);
    ilu.set_zero();
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n * nodes, n * nodes);
    const auto put = [&](int i, int j, const talus::Matrix<n>& x) {
        ilu.block(ilu.slot(i, j)) += x;
        dense.block<n, n>(n * i, n * j) += x;
    };
    for (int i = 0; i < nodes; ++i) {
        put(i, i, random.normal<n, n>() + 8.0 * talus::Matrix<n>::Identity());
        if (i > 0) put(i, i - 1, random.normal<n, n>());
        if (i + 1 < nodes) put(i, i + 1, random.normal<n, n>());
    }
    Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(n * nodes, -1.0, 2.0), ax;
    ilu.multiply(x, ax);
    BOOST_TEST((ax - dense * x).norm() < 1e-13 * ax.norm());
    BOOST_REQUIRE(ilu.factorize());
    ilu.precondition(ax);
    BOOST_TEST((ax - x).norm() < 1e-13 * x.norm());
    ilu.set_zero();
    BOOST_TEST(!ilu.factorize());
}

BOOST_AUTO_TEST_CASE_TEMPLATE(inner_solves_agree_with_factors, D, dimensions) {
    constexpr int dim = D::value;
    RandomBlocks random(12);
    // Reused: each problem must make what is kept of the last one harmless.
    talus::KrylovConeSolver<dim> krylov;
    for (const double coupling : {0.0, 0.7, 3.0})
        for (const int contacts : {4, 12, 40}) {
            BOOST_TEST_INFO_SCOPE("coupling " << coupling << ", contacts " << contacts);
            const auto p = RandomProblem<dim, Law<dim>>{.bodies = 12, .contacts = contacts}.make(
                random, Law<dim>{0.5});
            auto [bodies, blocks] = both_forms<dim>(p);
            const auto d = random_d<dim>(random, p.contact_count(), coupling);
            const Eigen::VectorXd b = bodies.free_velocity();
            for (auto* system : {&bodies, &blocks}) {
                BOOST_TEST_INFO_SCOPE("in body space: " << (system->bodies() != nullptr));
                Eigen::VectorXd direct, x = Eigen::VectorXd::Zero(b.size()), residual;
                BOOST_REQUIRE(system->factorize(d));
                system->solve(b, direct);
                krylov.analyze(*system);
                BOOST_REQUIRE(krylov.prepare(*system, d));
                const double tolerance = 1e-9 * b.norm();
                BOOST_TEST(krylov.solve(*system, b, x, tolerance, 2000));
                BOOST_TEST(krylov.iteration_count() > 0);
                // The defining property, and the direct solution within the smallest D.
                system->multiply(x, residual);
                for (std::size_t c = 0; c < d.size(); ++c) {
                    const auto at = system->first(c);
                    residual.segment<dim>(at) += d[c] * x.segment<dim>(at) - b.segment<dim>(at);
                }
                BOOST_TEST(residual.norm() <= 1.01 * tolerance);
                if (coupling < 1.0) BOOST_TEST((x - direct).norm() < 1e-2 * direct.norm());
                // Solved: nothing more to do.
                const long before = krylov.iteration_count();
                BOOST_TEST(krylov.solve(*system, b, x, 1.1 * tolerance, 10));
                BOOST_TEST(krylov.iteration_count() == before);
            }
        }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_limit_that_is_too_low_is_reported, D, dimensions) {
    constexpr int dim = D::value;
    const auto p = tower<dim>(30);
    auto [bodies, blocks] = both_forms<dim>(p);
    RandomBlocks random(13);
    const auto d = random_d<dim>(random, p.contact_count(), 0.5);
    talus::KrylovConeSolver<dim> krylov;
    krylov.analyze(bodies);
    BOOST_REQUIRE(krylov.prepare(bodies, d));
    const Eigen::VectorXd& b = bodies.free_velocity();
    Eigen::VectorXd x = Eigen::VectorXd::Zero(b.size());
    BOOST_TEST(!krylov.solve(bodies, b, x, 0.0, 3));
    BOOST_TEST(krylov.iteration_count() <= 3);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(gallery, D, dimensions) {
    // In space, bodies with slipping contacts may stop at 1e-5: incomplete factors of body space.
    const double of_bodies_promised = D::value == 2 ? 1e-6 : 0.0;
    // And a light body on one of a million times its mass is right to a few 1e-5 of its own speed.
    const double of_blocks_promised = D::value == 2 ? 1e-6 : 3e-5;
    test_on_gallery(
        of_bodies<D::value>(inexact<D::value>(), {.well_posed = of_bodies_promised}, most));
    test_on_gallery(
        of_blocks<D::value>(inexact<D::value>(), {.well_posed = of_blocks_promised}, most));
    test_on_gallery(of_matrices<D::value>(inexact<D::value>(), {}, most));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(takes_about_the_steps_of_the_exact_one, D, dimensions) {
    constexpr int dim = D::value;
    for (const std::size_t height : {5u, 30u}) {
        const auto p = tower<dim>(height);
        std::vector<talus::Vector<dim>> exact(height, talus::Vector<dim>::Zero()), r = exact;
        talus::InteriorPoint<dim, Law<dim>> with_factors({.tolerance = 1e-8});
        Solver<dim> without({.tolerance = 1e-8});
        const auto a = with_factors.solve(p, exact);
        const auto b = without.solve(p, r);
        BOOST_TEST((a.status == talus::SolveStatus::converged));
        BOOST_TEST((b.status == talus::SolveStatus::converged));
        BOOST_TEST(b.iterations <= a.iterations + 3);
        BOOST_TEST(without.directions().iteration_count() > 0);
        // The bodies of a tower come to rest.
        double worst = 0.0;
        for (std::size_t c = 0; c < height; ++c)
            worst = std::max(worst, (r[c] - exact[c]).norm() / exact[c].norm());
        BOOST_TEST(worst < 1e-5);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(an_inner_limit_stops_honestly, D, dimensions) {
    constexpr int dim = D::value;
    RandomBlocks random(14);
    auto p = RandomProblem<dim, Law<dim>>{.bodies = 20, .contacts = 60}.make(random, {0.5});
    move_bodies_only<dim>(p, random);
    std::vector<talus::Vector<dim>> r(60, talus::Vector<dim>::Zero());
    for (auto& x : r) x = random.normal<dim>();
    const double begin = talus::residual(p, std::span<const talus::Vector<dim>>(r)).relative;
    Solver<dim> solver({.max_inner_iterations = 1});
    const auto report = solver.solve(p, r);
    const double end = talus::residual(p, std::span<const talus::Vector<dim>>(r)).relative;
    BOOST_TEST(std::abs(report.residual - end) <= 1e-12 + 1e-6 * end);
    BOOST_TEST(end <= begin);
    BOOST_TEST((report.status == talus::SolveStatus::converged) == (end <= 1e-8));
    for (auto& x : r) x.setZero();
    solver.params.max_inner_iterations = 0;
    BOOST_CHECK_THROW(solver.solve(p, r), talus::input_error);
}

BOOST_AUTO_TEST_SUITE_END()
