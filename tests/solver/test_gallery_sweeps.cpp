// SPDX-License-Identifier: BSL-1.0
#include <talus/solver/sweeps/accelerated_gauss_seidel.hpp>
#include <talus/solver/sweeps/gauss_seidel.hpp>

#include <boost/test/unit_test.hpp>

#include "common/dimensions.hpp"
#include "common/gallery_tester.hpp"

BOOST_AUTO_TEST_SUITE(gallery_of_sweeps)

constexpr int most = 20000;        // sweeps
constexpr int most_passes = 4000;  // accelerated ones
constexpr SolverPromises by_sweeps{.well_posed = 1e-9, .hyperstatic = 1e-4, .rough = 1e-9};

template <int Dim>
auto sweeps(talus::SweepOrder order) {
    return [order](double tolerance) {
        return talus::GaussSeidel<Dim, talus::Coulomb<Dim>>(
            {.max_sweeps = most, .tolerance = tolerance, .order = order});
    };
}
template <int Dim>
auto passes(talus::Acceleration acceleration) {
    return [acceleration](double tolerance) {
        return talus::AcceleratedGaussSeidel<Dim, talus::Coulomb<Dim>>(
            {.max_iterations = most_passes, .tolerance = tolerance, .acceleration = acceleration});
    };
}
template <int Dim, class Make>
void in_all_forms_agree(Make make) {
    test_forms_agree<Dim>(
        {of_bodies<Dim>(make, by_sweeps, most), of_blocks<Dim>(make, by_sweeps, most),
         of_matrices<Dim>(make, by_sweeps, most)},
        1e-12, 1e-9);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(gauss_seidel, D, dimensions) {
    for (const auto order : {talus::SweepOrder::forward, talus::SweepOrder::symmetric})
        test_on_gallery(of_bodies<D::value>(sweeps<D::value>(order), by_sweeps, most), 200, 1);
    test_on_gallery(
        of_blocks<D::value>(sweeps<D::value>(talus::SweepOrder::forward), by_sweeps, most), 200, 1);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(accelerated_gauss_seidel, D, dimensions) {
    for (const auto acceleration : {talus::Acceleration::nesterov, talus::Acceleration::anderson}) {
        BOOST_TEST_INFO_SCOPE(
            (acceleration == talus::Acceleration::nesterov ? "nesterov" : "anderson"));
        test_on_gallery(of_bodies<D::value>(passes<D::value>(acceleration), by_sweeps, most_passes),
                        200, 1);
        test_on_gallery(
            of_matrices<D::value>(passes<D::value>(acceleration), by_sweeps, most_passes), 200, 1);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(forms_agree, D, dimensions) {
    in_all_forms_agree<D::value>(sweeps<D::value>(talus::SweepOrder::symmetric));
    in_all_forms_agree<D::value>(passes<D::value>(talus::Acceleration::nesterov));
    in_all_forms_agree<D::value>(passes<D::value>(talus::Acceleration::anderson));
}

BOOST_AUTO_TEST_SUITE_END()
