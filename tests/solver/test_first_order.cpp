// SPDX-License-Identifier: BSL-1.0
#include <talus/solver/concepts.hpp>
#include <talus/solver/cones/projected_gradient.hpp>

#include <boost/test/unit_test.hpp>

#include "common/dimensions.hpp"
#include "common/gallery_tester.hpp"
#include "common/random_problem.hpp"

BOOST_AUTO_TEST_SUITE(first_order)

constexpr int most = 2000;

/// `make.template operator()<Law>(tolerance)` returns a solver.
template <int Dim, class Make>
void test_first_order(Make make, SolverPromises promises) {
    using Law = talus::Coulomb<Dim>;
    const auto of_gallery = [=](double tolerance) {
        auto solver = make.template operator()<Law>(tolerance);
        static_assert(talus::ContactSolver<decltype(solver), Dim, Law>);
        return solver;
    };
    test_on_gallery(of_bodies<Dim>(of_gallery, promises, most), 200, 1);
    test_on_gallery(of_blocks<Dim>(of_gallery, promises, most), 201, 1);
    test_on_gallery(of_matrices<Dim>(of_gallery, promises, most), 202, 1);
}

template <int Dim>
void test_projected_gradient(talus::GradientStep step, SolverPromises promises) {
    test_first_order<Dim>(
        [step]<class Law>(double tolerance) {
            return talus::ProjectedGradient<Dim, Law>(
                {.max_iterations = most, .tolerance = tolerance, .step = step});
        },
        promises);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(spectral_gradient, D, dimensions) {
    test_projected_gradient<D::value>(talus::GradientStep::spectral, {.well_posed = 1e-7});
}

BOOST_AUTO_TEST_CASE_TEMPLATE(accelerated_gradient, D, dimensions) {
    test_projected_gradient<D::value>(talus::GradientStep::accelerated, {.well_posed = 1e-7});
}

// W = 1: the convex program's impulse is the point of the cone nearest to -u_free, Coulomb's has
// the normal part 1. The former opens the contact at mu |u_t|, and is not called converged.
BOOST_AUTO_TEST_CASE_TEMPLATE(convexified_law_is_the_nearest_point_of_the_cone, D, dimensions) {
    constexpr int dim = D::value;
    using Law = talus::Coulomb<dim>;
    using Vec = talus::Vector<dim>;
    auto p = stack_of_particles<dim>({1.0}, Law{.mu = 0.5});
    p.free_velocity[0] = 2.0 * Vec::Unit(1) - Vec::Unit(0);
    for (const auto step : {talus::GradientStep::spectral, talus::GradientStep::accelerated})
        for (const auto shift : {talus::ShiftRule::convexified, talus::ShiftRule::exact}) {
            std::vector<Vec> r(1, Vec::Zero());
            talus::ProjectedGradient<dim, Law> solver(
                {.max_iterations = 200, .tolerance = 1e-12, .step = step, .shift = shift});
            const auto report = solver.solve(p, std::span(r));
            const bool exact = shift == talus::ShiftRule::exact;
            const double r_n = exact ? 1.0 : 1.6;
            const Vec expected = r_n * Vec::Unit(0) - 0.5 * r_n * Vec::Unit(1);
            BOOST_TEST(((report.status == talus::SolveStatus::converged) == exact));
            BOOST_TEST((r[0] - expected).norm() < 1e-9);
        }
}

BOOST_AUTO_TEST_SUITE_END()
