// SPDX-License-Identifier: BSL-1.0
#include <talus/solver/admm.hpp>
#include <talus/solver/concepts.hpp>
#include <talus/solver/extragradient.hpp>
#include <talus/solver/projected_gradient.hpp>

#include "common/dimensions.hpp"
#include "common/gallery_tester.hpp"

namespace {

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

}  // namespace

BOOST_AUTO_TEST_SUITE(first_order)

BOOST_AUTO_TEST_CASE_TEMPLATE(spectral_gradient, D, dimensions) {
    test_projected_gradient<D::value>(talus::GradientStep::spectral, {.well_posed = 1e-7});
}

BOOST_AUTO_TEST_CASE_TEMPLATE(accelerated_gradient, D, dimensions) {
    test_projected_gradient<D::value>(talus::GradientStep::accelerated, {.well_posed = 1e-7});
}

BOOST_AUTO_TEST_CASE_TEMPLATE(extragradient, D, dimensions) {
    test_first_order<D::value>(
        []<class Law>(double tolerance) {
            return talus::Extragradient<D::value, Law>(
                {.max_iterations = most, .tolerance = tolerance});
        },
        {.well_posed = 1e-5});
}

BOOST_AUTO_TEST_CASE_TEMPLATE(admm, D, dimensions) {
    test_first_order<D::value>(
        []<class Law>(double tolerance) {
            return talus::Admm<D::value, Law>({.max_iterations = most, .tolerance = tolerance});
        },
        {.well_posed = 1e-7});
}

BOOST_AUTO_TEST_SUITE_END()
