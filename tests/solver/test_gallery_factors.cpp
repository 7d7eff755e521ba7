// SPDX-License-Identifier: BSL-1.0
#include <talus/solver/automatic.hpp>
#include <talus/solver/cones/interior_point.hpp>
#include <talus/solver/cones/newton_polish.hpp>

#include <boost/test/unit_test.hpp>

#include "common/dimensions.hpp"
#include "common/gallery_tester.hpp"

BOOST_AUTO_TEST_SUITE(gallery_of_factors)

template <int Dim>
using Law = talus::Coulomb<Dim>;

constexpr int most = 80;  // factorisations

template <int Dim>
auto interior_point() {
    return [](double tolerance) {
        return talus::InteriorPoint<Dim, Law<Dim>>(
            {.max_iterations = most, .tolerance = tolerance});
    };
}
template <int Dim>
auto newton_polish() {
    return [](double tolerance) {
        return talus::NewtonPolish<Dim, Law<Dim>>({.max_iterations = most, .tolerance = tolerance});
    };
}
constexpr int most_sweeps = 20000;
template <int Dim>
auto automatic() {
    return [](double tolerance) {
        return talus::Automatic<Dim, Law<Dim>>({.tolerance = tolerance, .max_sweeps = most_sweeps});
    };
}

BOOST_AUTO_TEST_CASE_TEMPLATE(interior_point_is_true, D, dimensions) {
    // A contact on its cone's border that does not slide is right to the root of complementarity.
    test_on_gallery(of_bodies<D::value>(interior_point<D::value>(), {.well_posed = 1e-6}, most));
    test_on_gallery(of_blocks<D::value>(interior_point<D::value>(), {}, most));
    test_on_gallery(of_matrices<D::value>(interior_point<D::value>(), {}, most));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(newton_polish_is_true, D, dimensions) {
    test_on_gallery(of_bodies<D::value>(newton_polish<D::value>(), {}, most));
    test_on_gallery(of_blocks<D::value>(newton_polish<D::value>(), {}, most));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(automatic_is_robust, D, dimensions) {
    const auto promises = SolverPromises::robust();
    test_on_gallery(of_bodies<D::value>(automatic<D::value>(), promises, most_sweeps));
    test_on_gallery(of_blocks<D::value>(automatic<D::value>(), promises, most_sweeps));
    test_on_gallery(of_matrices<D::value>(automatic<D::value>(), promises, most_sweeps));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(forms_agree, D, dimensions) {
    constexpr int dim = D::value;
    test_forms_agree<dim>({of_bodies<dim>(automatic<dim>(), {}, most_sweeps),
                           of_blocks<dim>(automatic<dim>(), {}, most_sweeps),
                           of_matrices<dim>(automatic<dim>(), {}, most_sweeps)},
                          1e-12, 1e-9);
}

BOOST_AUTO_TEST_SUITE_END()
