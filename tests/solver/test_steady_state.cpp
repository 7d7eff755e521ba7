// SPDX-License-Identifier: BSL-1.0
#include <talus/collision/hierarchical_grid.hpp>
#include <talus/core/column.hpp>
#include <talus/solver/sweeps/gauss_seidel.hpp>

#include "common/allocation_counter.hpp"
#include "common/dimensions.hpp"
#include "common/solver_tester.hpp"

BOOST_AUTO_TEST_SUITE(steady_state)

BOOST_AUTO_TEST_CASE_TEMPLATE(second_solve_of_no_larger_problem_does_not_allocate, D, dimensions) {
    constexpr int dim = D::value;
    using Law = talus::Coulomb<dim>;
    using Vec = talus::Vector<dim>;
    RandomBlocks random(61);
    const auto large = RandomProblem<dim, Law>{.bodies = 20, .contacts = 60}.make(random, {0.4});
    const auto small = RandomProblem<dim, Law>{.bodies = 9, .contacts = 30}.make(random, {0.4});
    for (const auto order : {talus::SweepOrder::symmetric, talus::SweepOrder::random}) {
        talus::GaussSeidel<dim, Law> solver({.max_sweeps = 500, .tolerance = 0.0, .order = order});
        std::vector<Vec> r(large.contact_count(), Vec::Zero());
        solver.solve(large, r);
        const long before = allocation_count;
        BOOST_TEST(before > 0);
        solver.solve(large, r);
        solver.solve(small, std::span<Vec>(r).first(small.contact_count()));
        const long during = allocation_count - before;
        BOOST_TEST(during == 0);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(broad_phase_of_the_same_scene_does_not_allocate, D, dimensions) {
    using Vec = talus::Vector<D::value>;
    RandomBlocks random(62);
    std::vector<talus::Aabb<D::value>> boxes;
    for (int k = 0; k < 500; ++k) {
        const Vec low = 5.0 * random.normal<D::value>();
        boxes.push_back({low, low + random.log_uniform(0.05, 1.0) * Vec::Ones()});
    }
    talus::HierarchicalGrid<D::value> grid;
    talus::Column<talus::CandidatePair> pairs;
    grid.find_pairs(boxes, talus::NoObstacles{}, pairs);
    const long before = allocation_count;
    grid.find_pairs(boxes, talus::NoObstacles{}, pairs);
    const long during = allocation_count - before;
    BOOST_TEST(during == 0);
}

BOOST_AUTO_TEST_SUITE_END()
