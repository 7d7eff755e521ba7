// SPDX-License-Identifier: BSL-1.0
#include <talus/law/any_law.hpp>
#include <talus/law/bilateral.hpp>
#include <talus/linear/dense_solve.hpp>
#include <talus/problem/delassus_sparse.hpp>
#include <talus/solver/sweeps/gauss_seidel.hpp>

#include <Eigen/LU>

#include "common/dimensions.hpp"
#include "common/solver_tester.hpp"

BOOST_AUTO_TEST_SUITE(gauss_seidel)

/// A user's law in its shortest form: the two functions of the concept.
template <int Dim>
struct ShortCoulomb {
    double mu;
    talus::Vector<Dim> solve(const talus::LocalProblem<Dim>& p, const talus::Vector<Dim>& r) const {
        return talus::Coulomb<Dim>{mu}.solve(p, r);
    }
    talus::Vector<Dim> natural_map(const talus::Vector<Dim>& u, const talus::Vector<Dim>& r,
                                   double rho) const {
        return talus::Coulomb<Dim>{mu}.natural_map(u, r, rho);
    }
};

/// A problem with one solution in u: few contacts, short arms, little friction.
template <int Dim, class Law>
talus::ContactProblem<Dim, Law> well_posed(RandomBlocks& random, const Law& law,
                                           bool scalar_inertia = false) {
    auto p =
        RandomProblem<Dim, Law>{
            .bodies = 8, .contacts = 6, .arm = 0.1, .scalar_inertia = scalar_inertia}
            .make(random, law);
    move_bodies_only<Dim>(p, random);
    return p;
}

/// Velocities of solves to 1e-13 agree to this, with condition numbers up to some hundred.
constexpr double same_velocity = 1e-9;

BOOST_AUTO_TEST_CASE_TEMPLATE(gauss_seidel_is_a_contact_solver, D, dimensions) {
    for (const auto order : {talus::SweepOrder::forward, talus::SweepOrder::backward,
                             talus::SweepOrder::symmetric, talus::SweepOrder::random})
        test_solver<D::value>([order]<class Law>(double tolerance, int max_sweeps) {
            return talus::GaussSeidel<D::value, Law>(
                {.max_sweeps = max_sweeps, .tolerance = tolerance, .order = order});
        });
}

BOOST_AUTO_TEST_CASE_TEMPLATE(after_enough_sweeps_any_order_becomes_random, D, dimensions) {
    constexpr int dim = D::value;
    using Law = talus::Coulomb<dim>;
    RandomBlocks random(70);
    const auto p = well_posed<dim, Law>(random, {0.3});
    const auto solved = [&](talus::SweepOrder order, int shuffle_after) {
        std::vector<talus::Vector<dim>> r(p.contact_count(), talus::Vector<dim>::Zero());
        talus::GaussSeidel<dim, Law> solver({.max_sweeps = 5,
                                             .tolerance = 0.0,
                                             .order = order,
                                             .seed = 9,
                                             .shuffle_after = shuffle_after});
        solver.solve(p, r);
        return r;
    };
    const auto from_start = solved(talus::SweepOrder::random, 1000);
    BOOST_CHECK(solved(talus::SweepOrder::forward, 0) == from_start);
    BOOST_CHECK(solved(talus::SweepOrder::backward, 0) == from_start);
    BOOST_CHECK(solved(talus::SweepOrder::forward, 2) != from_start);
    BOOST_CHECK(solved(talus::SweepOrder::forward, 2) != solved(talus::SweepOrder::forward, 5));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(velocities_depend_on_neither_order_nor_operator, D, dimensions) {
    constexpr int dim = D::value;
    using Law = talus::Coulomb<dim>;
    using Vec = talus::Vector<dim>;
    RandomBlocks random(71);
    for (int k = 0; k < 20; ++k) {
        const auto p = well_posed<dim>(random, Law{0.2}, k % 2 == 0);
        std::vector<std::vector<Vec>> found;
        for (const auto order :
             {talus::SweepOrder::forward, talus::SweepOrder::backward, talus::SweepOrder::random}) {
            talus::GaussSeidel<dim, Law> solver({100000, 1e-13, order, 3});
            std::vector<Vec> r(p.contact_count(), Vec::Zero());
            BOOST_TEST((solver.solve(p, r).status == talus::SolveStatus::converged));
            found.push_back(end_velocities<dim>(p, r));
            for (Vec& x : r) x = random.normal<dim>();
            talus::DelassusSparse<dim> w(p.jacobian, p.inverse_mass);
            solver.solve(w, p.free_velocity, p.laws, r);
            found.push_back(end_velocities<dim>(p, r));
        }
        for (const auto& u : found) BOOST_TEST(distance<dim>(u, found[0]) < same_velocity);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(short_law_gives_the_impulses_of_the_prepared_one, D, dimensions) {
    constexpr int dim = D::value;
    using Vec = talus::Vector<dim>;
    RandomBlocks one(72), two(72), three(72);
    const auto p = well_posed<dim>(one, talus::Coulomb<dim>{0.4});
    const auto q = well_posed<dim>(two, ShortCoulomb<dim>{0.4});
    using Any = talus::AnyLaw<dim, talus::Bilateral<dim>, ShortCoulomb<dim>>;
    const auto s = well_posed<dim>(three, Any{ShortCoulomb<dim>{0.4}});
    std::vector<Vec> r(p.contact_count(), Vec::Zero()), short_r = r, any_r = r;
    talus::GaussSeidel<dim, talus::Coulomb<dim>>({1000, 1e-13}).solve(p, r);
    talus::GaussSeidel<dim, ShortCoulomb<dim>>({1000, 1e-13}).solve(q, short_r);
    talus::GaussSeidel<dim, Any>({1000, 1e-13}).solve(s, any_r);
    BOOST_TEST(distance<dim>(r, short_r) < same_velocity);
    BOOST_TEST(distance<dim>(r, any_r) < same_velocity);
}

// The same impulses carried over instead of none: fewer sweeps after a small change of the load.
BOOST_AUTO_TEST_CASE_TEMPLATE(warm_start_saves_sweeps, D, dimensions) {
    constexpr int dim = D::value;
    using Vec = talus::Vector<dim>;
    auto p = stack_of_particles<dim>(std::vector<double>(10, 1.0), talus::Coulomb<dim>{0.3});
    p.free_velocity[0][0] = -1.0;
    talus::GaussSeidel<dim, talus::Coulomb<dim>> solver({10000, 1e-6});
    std::vector<Vec> r(10, Vec::Zero());
    const int cold = solver.solve(p, r).iterations;
    p.free_velocity[0][0] = -1.0001;
    const int warm = solver.solve(p, r).iterations;
    BOOST_TEST(warm > 0);
    BOOST_TEST(warm < cold / 2);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(observer_sees_every_sweep_changes_nothing_and_may_stop, D,
                              dimensions) {
    constexpr int dim = D::value;
    using Vec = talus::Vector<dim>;
    auto p = stack_of_particles<dim>(std::vector<double>(5, 1.0), talus::Coulomb<dim>{0.3});
    p.free_velocity[0] = Vec::Unit(1) - Vec::Unit(0);
    talus::GaussSeidel<dim, talus::Coulomb<dim>> solver({1000, 1e-11});
    std::vector<Vec> silent(p.contact_count(), Vec::Zero()), watched = silent, stopped = silent;
    const auto report = solver.solve(p, silent);
    std::vector<double> seen;
    solver.solve(p, watched, [&](int sweep, double residual) {
        seen.push_back(residual);
        BOOST_TEST(static_cast<std::size_t>(sweep) == seen.size());
    });
    BOOST_TEST(static_cast<int>(seen.size()) == report.iterations);
    BOOST_TEST(distance<dim>(silent, watched) == 0.0);
    BOOST_TEST(seen.back() <= 1e-11);
    BOOST_TEST(seen.front() > seen.back());

    const auto early = solver.solve(p, stopped, [](int sweep, double) { return sweep < 3; });
    BOOST_TEST((early.status == talus::SolveStatus::stopped));
    BOOST_TEST(early.iterations == 3);
    BOOST_TEST(early.residual == talus::residual(p, std::span<const Vec>(stopped)).relative,
               boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(problem_in_space_confined_to_a_plane_equals_the_plane_problem) {
    RandomBlocks random(74);
    for (int k = 0; k < 20; ++k) {
        const auto flat = well_posed<2>(random, talus::Coulomb<2>{0.3});
        talus::ContactProblem<3, talus::Coulomb<3>> p;
        const std::size_t n = flat.contact_count();
        const auto lift = [](const talus::Vector<2>& x) {
            return talus::Vector<3>(x[0], x[1], 0.0);
        };
        p.inverse_mass.linear = flat.inverse_mass.linear;
        for (const auto& x : flat.inverse_mass.angular)
            p.inverse_mass.angular.push_back(x[0] * talus::Matrix<3>::Identity());
        p.jacobian.resize(n);
        p.jacobian.a = flat.jacobian.a;
        p.jacobian.b = flat.jacobian.b;
        for (std::size_t i = 0; i < n; ++i) {
            p.jacobian.frame[i].setIdentity();
            p.jacobian.frame[i].topLeftCorner<2, 2>() = flat.jacobian.frame[i];
            p.jacobian.arm_a[i] = lift(flat.jacobian.arm_a[i]);
            p.jacobian.arm_b[i] = lift(flat.jacobian.arm_b[i]);
            p.free_velocity.push_back(lift(flat.free_velocity[i]));
            p.laws.push_back({flat.laws[i].mu});
        }
        std::vector<talus::Vector<2>> r2(n, talus::Vector<2>::Zero());
        std::vector<talus::Vector<3>> r3(n, talus::Vector<3>::Zero());
        talus::GaussSeidel<2, talus::Coulomb<2>>({10000, 1e-13}).solve(flat, r2);
        talus::GaussSeidel<3, talus::Coulomb<3>>({10000, 1e-13}).solve(p, r3);
        const auto u2 = end_velocities<2>(flat, r2);
        const auto u3 = end_velocities<3>(p, r3);
        for (std::size_t i = 0; i < n; ++i)
            BOOST_TEST((u3[i] - lift(u2[i])).norm() < same_velocity);
    }
}

// Validation case B08: the soft map without friction is the projection of the velocity on the cone
// of admissible ones in the kinetic metric, found here by trying every set of active contacts.
BOOST_AUTO_TEST_CASE_TEMPLATE(frictionless_solution_is_the_tangent_cone_projection, D, dimensions) {
    constexpr int dim = D::value;
    using Vec = talus::Vector<dim>;
    RandomBlocks random(75);
    for (int k = 0; k < 300; ++k) {
        const auto n = static_cast<std::size_t>(random.integer(1, 4));
        const Eigen::Matrix4d a = random.semidefinite<4>(4) + 0.1 * Eigen::Matrix4d::Identity();
        const Eigen::Vector4d u_begin = random.normal<4>();
        Eigen::MatrixXd g(static_cast<Eigen::Index>(n), 4);
        for (Eigen::Index i = 0; i < g.rows(); ++i) g.row(i) = random.unit<4>();
        const Eigen::MatrixXd w = g * a.inverse() * g.transpose();
        const Eigen::VectorXd b = g * u_begin;

        std::vector<talus::DelassusBlock<dim>> blocks;
        std::vector<Vec> free_velocity(n, Vec::Zero()), r(n, Vec::Zero());
        for (std::size_t i = 0; i < n; ++i) {
            free_velocity[i][0] = b[static_cast<Eigen::Index>(i)];
            for (std::size_t j = 0; j < n; ++j) {
                blocks.push_back({i, j, talus::Matrix<dim>::Zero()});
                blocks.back().value(0, 0) =
                    w(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
            }
        }
        talus::DelassusSparse<dim> operator_w(n, blocks);
        const std::vector<talus::Signorini<dim>> laws(n);
        talus::GaussSeidel<dim, talus::Signorini<dim>> solver({1000000, 1e-13});
        const auto& report = solver.solve(operator_w, free_velocity, laws, r);
        BOOST_TEST((report.status == talus::SolveStatus::converged));

        int solutions = 0;
        for (unsigned active = 0; active < (1u << n); ++active) {
            Eigen::MatrixXd system = w;
            Eigen::VectorXd right = -b;
            for (Eigen::Index i = 0; i < g.rows(); ++i)
                if (!(active >> i & 1u)) {
                    system.row(i) = Eigen::VectorXd::Unit(g.rows(), i).transpose();
                    right[i] = 0.0;
                }
            const Eigen::VectorXd p = talus::solved_dense(system, right);
            // Rounding of an ill-conditioned system, relative to what the solution is made of.
            const double rounding = 1e-12 * (1.0 + w.norm()) * (1.0 + p.norm());
            if (p.minCoeff() < -rounding || (w * p + b).minCoeff() < -rounding) continue;
            ++solutions;
            Eigen::VectorXd found(g.rows());
            for (Eigen::Index i = 0; i < g.rows(); ++i)
                found[i] = r[static_cast<std::size_t>(i)][0];
            const Eigen::Vector4d difference = a.inverse() * g.transpose() * (p - found);
            BOOST_TEST(std::sqrt(difference.dot(a * difference)) < 1e-10 * (1.0 + p.norm()));
        }
        BOOST_TEST(solutions >= 1);
    }
}

BOOST_AUTO_TEST_CASE(bad_parameters_and_lengths_are_named) {
    using Law = talus::Coulomb<3>;
    RandomBlocks random(76);
    auto p = well_posed<3>(random, Law{0.3});
    std::vector<talus::Vector<3>> r(p.contact_count(), talus::Vector<3>::Zero());
    using Solver = talus::GaussSeidel<3, Law>;
    BOOST_CHECK_THROW(Solver({.max_sweeps = -1}).solve(p, r), talus::input_error);
    BOOST_CHECK_THROW(Solver({.tolerance = -1.0}).solve(p, r), talus::input_error);
    BOOST_CHECK_THROW(Solver({.tolerance = std::nan("")}).solve(p, r), talus::input_error);
    r.pop_back();
    BOOST_CHECK_THROW(Solver().solve(p, r), talus::input_error);
    p.laws.pop_back();
    r.push_back(talus::Vector<3>::Zero());
    BOOST_CHECK_THROW(Solver().solve(p, r), talus::input_error);
}

BOOST_AUTO_TEST_SUITE_END()
