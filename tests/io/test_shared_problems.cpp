// SPDX-License-Identifier: BSL-1.0
#include <talus/io/read_problem.hpp>
#include <talus/problem/residual.hpp>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

using talus::Vector;

namespace {

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
    measure.prepare(w);
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

}  // namespace

BOOST_AUTO_TEST_SUITE(io_shared_problems)

BOOST_AUTO_TEST_CASE(the_problems_of_other_codes_are_read) {
    const std::filesystem::path shared = TALUS_SHARED_DATA "/problems";
    if (!std::filesystem::exists(shared)) {
        BOOST_TEST_MESSAGE("skipped, data not found");
        return;
    }
    std::size_t known = 0;
    for (const auto& entry : std::filesystem::directory_iterator(shared)) {
        if (entry.path().extension() != ".hdf5") continue;
        BOOST_TEST_CONTEXT(entry.path().filename()) {
            talus::problem_dimension(entry.path()) == 2 ? check<2>(entry.path())
                                                        : check<3>(entry.path());
        }
        known += known_contacts.count(entry.path().stem().string());
    }
    BOOST_TEST(known == known_contacts.size());
}

BOOST_AUTO_TEST_SUITE_END()
