// SPDX-License-Identifier: BSL-1.0
// Compiled with OpenMP, with which Eigen shares large products among threads unless it is kept from
// that: the bits of a solve must not depend on the number of threads.
#include <talus/law/coulomb.hpp>
#include <talus/solver/automatic.hpp>
#include <talus/solver/cones/interior_point.hpp>

#include <boost/test/unit_test.hpp>

#include <array>
#include <cstring>
#include <omp.h>
#include <span>
#include <thread>
#include <vector>

#include "common/dimensions.hpp"
#include "common/random_problem.hpp"

BOOST_AUTO_TEST_SUITE(solver_threads)

template <int Dim>
using Problem = talus::ContactProblem<Dim, talus::Coulomb<Dim>>;
template <int Dim>
using Impulses = std::vector<talus::Vector<Dim>>;

/// Bodies that touch others anywhere, so that fronts are large.
template <int Dim>
Problem<Dim> entangled() {
    RandomBlocks random(7);
    auto p =
        RandomProblem<Dim, talus::Coulomb<Dim>>{.bodies = 300, .contacts = 1500, .arm = 0.1}.make(
            random, {0.3});
    move_bodies_only<Dim>(p, random);
    return p;
}

template <int Dim, class Solver>
Impulses<Dim> solved(const Problem<Dim>& p, Solver solver) {
    Impulses<Dim> r(p.contact_count(), talus::Vector<Dim>::Zero());
    solver.solve(p, std::span(r));
    return r;
}
template <int Dim>
bool same_bits(const Impulses<Dim>& a, const Impulses<Dim>& b) {
    for (std::size_t i = 0; i < a.size(); ++i)
        if (std::memcmp(a[i].data(), b[i].data(), sizeof(double) * Dim) != 0) return false;
    return a.size() == b.size();
}

template <int Dim, class Solver>
void test_thread_counts(const Solver& solver) {
    const Problem<Dim> p = entangled<Dim>();
    const int usual = omp_get_max_threads();
    omp_set_num_threads(1);
    const Impulses<Dim> alone = solved<Dim>(p, solver);
    for (const int threads : {2, 3, 7}) {
        omp_set_num_threads(threads);
        BOOST_TEST(same_bits<Dim>(alone, solved<Dim>(p, solver)), threads << " threads");
    }
    omp_set_num_threads(usual);
    std::array<Impulses<Dim>, 3> at_once;
    {
        std::vector<std::jthread> threads;
        for (auto& r : at_once)
            threads.emplace_back([&p, &r, solver] { r = solved<Dim>(p, solver); });
    }
    for (const auto& r : at_once) BOOST_TEST(same_bits<Dim>(alone, r));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(interior_point_has_the_same_bits, D, dimensions) {
    using Law = talus::Coulomb<D::value>;
    test_thread_counts<D::value>(talus::InteriorPoint<D::value, Law>({.max_iterations = 2}));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(automatic_has_the_same_bits, D, dimensions) {
    using Law = talus::Coulomb<D::value>;
    test_thread_counts<D::value>(talus::Automatic<D::value, Law>(
        {.tolerance = 1e-11, .max_sweeps = 100, .max_factorizations = 2}));
}

BOOST_AUTO_TEST_SUITE_END()
