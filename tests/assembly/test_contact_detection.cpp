// SPDX-License-Identifier: BSL-1.0
// What a broad phase of one's own may say, and what is refused in its name.
#include <talus/assembly/contact_detection.hpp>
#include <talus/collision/brute_force.hpp>
#include <talus/core/column.hpp>

#include <boost/test/unit_test.hpp>

#include <span>
#include <string>
#include <vector>

#include "common/dimensions.hpp"

BOOST_AUTO_TEST_SUITE(assembly_contact_detection)

/// Says what it is told to say.
struct Told {
    static inline talus::Column<talus::CandidatePair> pairs;
    template <int Dim, class IsObstacle>
    void find_pairs(std::span<const talus::Aabb<Dim>>, const IsObstacle&,
                    talus::Column<talus::CandidatePair>& found) const {
        found = pairs;
    }
};

/// Two obstacles, 0 and 1, and three balls in a row, each in touch with the next.
template <int Dim>
struct Row {
    talus::Bodies<Dim> bodies;
    std::vector<talus::Ball<Dim>> shapes{5, talus::Ball<Dim>(0.5)};
    std::vector<double> radius = std::vector<double>(5, 0.5), reach = std::vector<double>(5, 1e-3);
    talus::ContactDetection<Dim, talus::Ball<Dim>, Told> detection;
    talus::ContactSet<Dim> contacts;

    Row() {
        const talus::Inertia<Dim> inertia{1.0, talus::AngularVector<Dim>::Ones()};
        for (int i = 0; i < 5; ++i) {
            const talus::Pose<Dim> pose{i * talus::Vector<Dim>::Unit(0), {}};
            if (i < 2)
                bodies.add_obstacle(pose);
            else
                bodies.add(inertia, pose);
        }
    }
    /// The complaint about pairs, or nothing.
    std::string said(talus::Column<talus::CandidatePair> pairs) {
        Told::pairs = std::move(pairs);
        try {
            detection.detect(bodies, {shapes, radius, 1}, 0.1, reach, {}, 0.0, {}, contacts);
        } catch (const talus::input_error& error) {
            return error.what();
        }
        return {};
    }
};

BOOST_AUTO_TEST_CASE_TEMPLATE(pairs_that_are_none_are_refused_by_name, D, dimensions) {
    constexpr int Dim = D::value;
    const auto refused = [](talus::Column<talus::CandidatePair> pairs, const std::string& beginning,
                            const std::string& range) {
        Row<D::value> row;
        // Twice: what was refused is not taken for found.
        for (int k = 0; k < 2; ++k) {
            const std::string found = row.said(pairs);
            BOOST_TEST(found.starts_with(beginning + ", but must be "), found);
            BOOST_TEST(found.find(range) != std::string::npos, found);
        }
        BOOST_TEST(row.said({{1, 2}, {2, 3}, {3, 4}}) == "");
        BOOST_TEST(row.contacts.count() == 3u);
    };
    const std::string bodies = "of the bodies from 0 below 5, two different bodies";
    refused({{1, 2}, {2, 5}}, "pair 1 of the broad phase is (2, 5)", bodies);
    refused({{-1, 2}}, "pair 0 of the broad phase is (-1, 2)", bodies);
    refused({{3, 1000000000}}, "pair 0 of the broad phase is (3, 1000000000)", bodies);
    refused({{1000000000, 3}}, "pair 0 of the broad phase is (1000000000, 3)", bodies);
    refused({{3, -1000000000}}, "pair 0 of the broad phase is (3, -1000000000)", bodies);
    refused({{3, 3}}, "pair 0 of the broad phase is (3, 3)", bodies);
    refused({{1, 2}, {3, 2}}, "pair 1 of the broad phase is (3, 2)", "the smaller index first");
    refused({{2, 3}, {2, 3}}, "pair 1 of the broad phase is (2, 3)", "sorted, each pair once");
    refused({{3, 4}, {2, 3}}, "pair 1 of the broad phase is (2, 3)", "sorted, each pair once");
    refused({{0, 1}}, "pair 0 of the broad phase is (0, 1)", "not both obstacles");
    Row<Dim> row;
    BOOST_TEST(row.said({}) == "");
}

BOOST_AUTO_TEST_SUITE_END()
