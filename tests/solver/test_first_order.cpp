// SPDX-License-Identifier: BSL-1.0
#include <talus/solver/admm.hpp>
#include <talus/solver/extragradient.hpp>
#include <talus/solver/projected_gradient.hpp>

#include "common/dimensions.hpp"
#include "common/solver_tester.hpp"

namespace {

template <int Dim>
void test_projected_gradient(talus::GradientStep step) {
    test_solver<Dim>([step]<class Law>(double tolerance, int max_iterations) {
        return talus::ProjectedGradient<Dim, Law>(
            {.max_iterations = max_iterations, .tolerance = tolerance, .step = step});
    });
}

}  // namespace

BOOST_AUTO_TEST_SUITE(first_order)

BOOST_AUTO_TEST_CASE_TEMPLATE(spectral_gradient_is_a_contact_solver, D, dimensions) {
    test_projected_gradient<D::value>(talus::GradientStep::spectral);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(accelerated_gradient_is_a_contact_solver, D, dimensions) {
    test_projected_gradient<D::value>(talus::GradientStep::accelerated);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(extragradient_is_a_contact_solver, D, dimensions) {
    test_solver<D::value>([]<class Law>(double tolerance, int max_iterations) {
        return talus::Extragradient<D::value, Law>(
            {.max_iterations = max_iterations, .tolerance = tolerance});
    });
}

BOOST_AUTO_TEST_CASE_TEMPLATE(admm_is_a_contact_solver, D, dimensions) {
    test_solver<D::value>([]<class Law>(double tolerance, int max_iterations) {
        return talus::Admm<D::value, Law>(
            {.max_iterations = max_iterations, .tolerance = tolerance});
    });
}

BOOST_AUTO_TEST_SUITE_END()
