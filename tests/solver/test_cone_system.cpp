// SPDX-License-Identifier: BSL-1.0
#include <talus/law/coulomb.hpp>
#include <talus/problem/delassus_sparse.hpp>
#include <talus/solver/cones/cone_system.hpp>

#include <Eigen/LU>

#include "common/delassus_tester.hpp"
#include "common/dimensions.hpp"
#include "common/random_problem.hpp"

BOOST_AUTO_TEST_SUITE(cone_system)

/// A random problem in both forms that ConeSystem takes, and written out.
template <int Dim>
struct Forms {
    using Vec = talus::Vector<Dim>;
    using Law = talus::Coulomb<Dim>;

    talus::ContactProblem<Dim, Law> problem;
    talus::ResidualMeasure<Dim> measure;
    talus::ConeSystem<Dim> contact_space, body_space;
    Eigen::MatrixXd w;      ///< scaled
    Eigen::VectorXd scale;  ///< sqrt(rho) for each component

    Forms(RandomBlocks& random, int bodies, int contacts) {
        problem =
            RandomProblem<Dim, Law>{.bodies = bodies, .contacts = contacts, .mass_ratio = 100.0}
                .make(random, Law{0.7});
        // Between obstacles: no effective mass of its own.
        problem.inverse_mass.linear[0] = 0.0;
        problem.inverse_mass.angular[0].setZero();
        if (bodies > 3) problem.inverse_mass.angular[1].setZero();  // a particle
        for (std::size_t c = 0; c < problem.contact_count(); c += 3) problem.laws[c].mu = 0.0;
        const talus::DelassusSparse<Dim> blocks(problem.jacobian, problem.inverse_mass);
        measure.template prepare<talus::DelassusSparse<Dim>, Law>(blocks, problem.free_velocity,
                                                                  problem.laws);
        std::vector<talus::FrictionCone<Dim>> cones;
        for (const Law& law : problem.laws) cones.push_back(law.friction_cone());
        contact_space.assign(blocks, problem.free_velocity, cones, measure);
        body_space.assign(talus::BodyMap<Dim>(problem.jacobian, problem.inverse_mass),
                          problem.free_velocity, cones, measure);
        scale.resize(static_cast<Eigen::Index>(Dim * problem.contact_count()));
        for (std::size_t c = 0; c < problem.contact_count(); ++c)
            scale.template segment<Dim>(at(c)).setConstant(std::sqrt(measure.effective_mass(c)));
        w = scale.asDiagonal() * dense_delassus<Dim>(problem.jacobian, problem.inverse_mass) *
            scale.asDiagonal();
    }
    static Eigen::Index at(std::size_t c) { return static_cast<Eigen::Index>(Dim * c); }
    Eigen::VectorXd random_vector(RandomBlocks& random) const {
        Eigen::VectorXd x(scale.size());
        for (double& value : x) value = random.uniform(-1.0, 1.0);
        return x;
    }
    /// Calls `visit(system)` for both.
    template <class Visit>
    void both(Visit&& visit) {
        visit(contact_space);
        visit(body_space);
    }
};

template <int Dim, class Visit>
void over_problems(unsigned seed, Visit&& visit) {
    RandomBlocks random(seed);
    for (int k = 0; k < 20; ++k) {
        const int bodies = random.integer(3, 9), contacts = random.integer(1, 24);
        BOOST_TEST_INFO_SCOPE("problem " << k << ": " << bodies << " bodies, " << contacts
                                         << " contacts");
        Forms<Dim> forms(random, bodies, contacts);
        visit(forms, random);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(products_are_those_of_the_dense_matrix, D, dimensions) {
    over_problems<D::value>(111, [](auto& forms, RandomBlocks& random) {
        const Eigen::VectorXd r = forms.random_vector(random), exact = forms.w * r;
        forms.both([&](const auto& system) {
            Eigen::VectorXd u;
            system.multiply(r, u);
            BOOST_TEST((u - exact).norm() <= 1e-13 * (1.0 + forms.w.norm()) * r.norm());
        });
    });
}

BOOST_AUTO_TEST_CASE_TEMPLATE(scaled_units_make_the_trace_of_each_contact_dim, D, dimensions) {
    constexpr int dim = D::value;
    over_problems<dim>(112, [](auto& forms, RandomBlocks& random) {
        for (std::size_t c = 0; c < forms.problem.contact_count(); ++c) {
            const double trace = forms.w.template block<dim, dim>(forms.at(c), forms.at(c)).trace();
            BOOST_TEST((trace == 0.0 || std::abs(trace - D::value) < 1e-12));
        }
        std::vector<talus::Vector<dim>> r(forms.problem.contact_count()), back = r;
        for (auto& x : r) x = random.normal<dim>();
        forms.both([&](const auto& system) {
            Eigen::VectorXd scaled;
            system.to_scaled(r, scaled);
            system.to_impulses(scaled, back);
            for (std::size_t c = 0; c < r.size(); ++c) {
                BOOST_TEST((back[c] - r[c]).norm() <= 1e-15 * r[c].norm());
                const double root = std::sqrt(forms.measure.effective_mass(c));
                const talus::Vector<dim> q =
                    system.free_velocity().template segment<dim>(forms.at(c));
                BOOST_TEST((q - root * forms.problem.free_velocity[c]).norm() <= 1e-15 * q.norm());
                BOOST_TEST(system.cone(c).mu == forms.problem.laws[c].mu);
            }
        });
    });
}

BOOST_AUTO_TEST_CASE_TEMPLATE(residual_is_the_measure, D, dimensions) {
    constexpr int dim = D::value;
    using Vec = talus::Vector<dim>;
    over_problems<dim>(113, [](auto& forms, RandomBlocks& random) {
        for (const double size : {0.0, 1.0, 1e6}) {
            std::vector<Vec> r(forms.problem.contact_count());
            for (auto& x : r) x = size * random.normal<dim>();
            const double exact = talus::residual(forms.problem, std::span<const Vec>(r)).relative;
            forms.both([&](const auto& system) {
                Eigen::VectorXd scaled, u;
                system.to_scaled(r, scaled);
                system.multiply(scaled, u);
                u += system.free_velocity();
                BOOST_TEST(std::abs(system.residual(scaled, u) - exact) <= 1e-13 * exact);
            });
        }
    });
}

BOOST_AUTO_TEST_CASE_TEMPLATE(solutions_are_those_of_the_dense_matrix, D, dimensions) {
    constexpr int dim = D::value;
    over_problems<dim>(114, [](auto& forms, RandomBlocks& random) {
        // Small, middling and large; not symmetric, with a positive definite symmetric part.
        for (const double size : {1e-6, 1.0, 1e6}) {
            std::vector<talus::Matrix<dim>> d;
            Eigen::MatrixXd dense = forms.w;
            for (std::size_t c = 0; c < forms.problem.contact_count(); ++c) {
                talus::Matrix<dim> skew = random.normal<dim, dim>();
                skew -= skew.transpose().eval();
                d.push_back(size * random.log_uniform(0.1, 10.0) *
                            (random.well_conditioned<dim>() + skew));
                dense.template block<dim, dim>(forms.at(c), forms.at(c)) += d.back();
            }
            const Eigen::VectorXd x = forms.random_vector(random), b = dense * x;
            forms.both([&](auto& system) {
                BOOST_REQUIRE(system.factorize(d));
                Eigen::VectorXd found;
                system.solve(b, found);
                // Refined, so that what is left is the rounding of b itself; in body space the
                // inverse of a small D multiplies it.
                const Eigen::VectorXd left = dense * found - b;
                BOOST_TEST(left.norm() <= 1e-13 * (1.0 + dense.norm() * found.norm()));
                BOOST_TEST(system.factorization_cost() > 0.0);
            });
        }
    });
}

BOOST_AUTO_TEST_CASE_TEMPLATE(one_system_serves_many_problems, D, dimensions) {
    constexpr int dim = D::value;
    talus::ConeSystem<dim> system;
    RandomBlocks random(115);
    for (int k = 0; k < 6; ++k) {
        Forms<dim> forms(random, random.integer(3, 8), random.integer(1, 15));
        std::vector<talus::FrictionCone<dim>> cones(forms.problem.contact_count());
        if (k % 2 == 0)
            system.assign(talus::BodyMap<dim>(forms.problem.jacobian, forms.problem.inverse_mass),
                          forms.problem.free_velocity, cones, forms.measure);
        else
            system.assign(
                talus::DelassusSparse<dim>(forms.problem.jacobian, forms.problem.inverse_mass),
                forms.problem.free_velocity, cones, forms.measure);
        const std::vector<talus::Matrix<dim>> d(forms.problem.contact_count(),
                                                talus::Matrix<dim>::Identity());
        BOOST_REQUIRE(system.factorize(d));
        const Eigen::VectorXd b = forms.random_vector(random);
        Eigen::VectorXd x;
        system.solve(b, x);
        BOOST_TEST((forms.w * x + x - b).norm() <= 1e-13 * (1.0 + forms.w.norm()) * b.norm());
    }
}

BOOST_AUTO_TEST_SUITE_END()
