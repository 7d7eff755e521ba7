// SPDX-License-Identifier: BSL-1.0
#include <talus/io/read_problem.hpp>
#include <talus/problem/residual.hpp>
#include <talus/solver/automatic.hpp>

#include <Eigen/Core>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

using talus::Vector;

BOOST_AUTO_TEST_SUITE(io_shared_problems)

/// Contacts of some of the files: of each dimension, form and storage.
const std::map<std::string, std::size_t> known_contacts{
    {"FrictionContactProblem00031", 11}, {"fc2d_granularflowonwall_00667_00000", 667},
    {"KaplasTower-i1061-4", 570},        {"CubeH8", 1},
    {"Box_Stacks-i0122-82-5", 82},       {"SpherePile-1000", 3066},
};

template <int Dim>
talus::Residual residual_at(const talus::AssembledProblem<Dim, talus::Coulomb<Dim>>& p,
                            const std::vector<Vector<Dim>>& r) {
    auto w = p.delassus;
    w.start(r);
    talus::ResidualMeasure<Dim> measure;
    measure.template prepare<talus::DelassusSparse<Dim>, talus::Coulomb<Dim>>(w, p.free_velocity,
                                                                              p.laws);
    return measure.template evaluate<talus::Coulomb<Dim>>(
        p.free_velocity, p.laws, r, [&](std::size_t i) { return w.velocity(i); });
}

template <int Dim>
double norm(const std::vector<Vector<Dim>>& vectors) {
    double sum = 0.0;
    for (const auto& v : vectors) sum += v.squaredNorm();
    return std::sqrt(sum);
}

template <int Dim>
void check(const std::filesystem::path& path) {
    const auto content = talus::read_problem<Dim>(path);
    const auto local = talus::assembled(content);
    const std::size_t contacts = local.contact_count();
    const auto known = known_contacts.find(path.stem().string());
    if (known != known_contacts.end()) BOOST_TEST(contacts == known->second);
    BOOST_TEST(contacts > 0u);
    BOOST_TEST(!content.info.title.empty());
    const std::vector<Vector<Dim>> none(contacts, Vector<Dim>::Zero());
    BOOST_TEST(residual_at<Dim>(local, none).finite());
    if (!content.global) return;
    const double rounding = 1e-9;  // M of the finite elements has a condition of some 1e4
    std::vector<Vector<Dim>> r(contacts);
    for (std::size_t c = 0; c < contacts; ++c)
        r[c] = Vector<Dim>::Unit(static_cast<Eigen::Index>(c % Dim));
    const auto from_global = talus::solution_of<Dim>(*content.global, r).relative_velocity;
    auto difference = talus::solution_of<Dim>(local, r).relative_velocity;
    for (std::size_t c = 0; c < contacts; ++c) difference[c] -= from_global[c];
    BOOST_TEST(norm<Dim>(difference) < rounding * norm<Dim>(from_global));
}

/// Solves from zero with the default settings; checks that the report tells the truth.
template <int Dim>
talus::SolveReport solved(const std::filesystem::path& path, double tolerance, int max_sweeps) {
    using Law = talus::Coulomb<Dim>;
    auto local = talus::assembled(talus::read_problem<Dim>(path));
    talus::AutomaticParams params;
    params.tolerance = tolerance;
    params.max_sweeps = max_sweeps;
    talus::Automatic<Dim, Law> solver(params);
    std::vector<Vector<Dim>> r(local.contact_count(), Vector<Dim>::Zero());
    const auto report = solver.solve(local.delassus, local.free_velocity, local.laws, r);
    const double eta = residual_at<Dim>(local, r).relative;
    BOOST_TEST(std::abs(eta - report.residual) <= 1e-13 + 1e-6 * eta);
    return report;
}
template <class Visit>
void for_each_problem(Visit visit) {
    const std::filesystem::path shared = TALUS_SHARED_DATA "/problems";
    if (!std::filesystem::exists(shared)) {
        BOOST_TEST_MESSAGE("skipped, data not found");
        return;
    }
    for (const auto& entry : std::filesystem::directory_iterator(shared)) {
        if (entry.path().extension() != ".hdf5") continue;
        BOOST_TEST_CONTEXT(entry.path().filename()) { visit(entry.path()); }
    }
}

BOOST_AUTO_TEST_CASE(the_problems_of_other_codes_are_read) {
    std::size_t known = 0, count = 0;
    for_each_problem([&](const std::filesystem::path& path) {
        talus::problem_dimension(path) == 2 ? check<2>(path) : check<3>(path);
        known += known_contacts.count(path.stem().string());
        ++count;
    });
    BOOST_TEST((count == 0 || known == known_contacts.size()));
}

BOOST_AUTO_TEST_CASE(automatic_solves_the_problems_of_other_codes) {
    for_each_problem([](const std::filesystem::path& path) {
        // The one problem that nobody has solved to tight tolerance (bench/NOTEBOOK.md).
        const bool open = path.stem() == "SpherePile-1000";
        const double tolerance = open ? 1e-3 : 1e-12;  // its worst contact to a hundredth
        const int sweeps = open ? 2000 : talus::AutomaticParams{}.max_sweeps;
        const auto report = talus::problem_dimension(path) == 2
                                ? solved<2>(path, tolerance, sweeps)
                                : solved<3>(path, tolerance, sweeps);
        BOOST_TEST((report.status == talus::SolveStatus::converged),
                   to_string(report.status) << " at " << report.residual);
    });
}

BOOST_AUTO_TEST_SUITE_END()
