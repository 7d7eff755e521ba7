// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/brute_force.hpp>
#include <talus/core/column.hpp>

#include <boost/test/unit_test.hpp>

#include <limits>
#include <string>
#include <vector>

#include "common/random_blocks.hpp"

/// What every BroadPhase must do: give the pairs of the definition, in scenes of all kinds. One
/// object for all scenes, as its arrays are kept from call to call.
template <int Dim, talus::BroadPhase<Dim> Broad>
class BroadPhaseTester {
  public:
    explicit BroadPhaseTester(unsigned seed) : random_(seed) {}

    void run() {
        for (const double ratio : {1.0, 20.0, 200.0, 1e9})
            for (const int n : {0, 1, 2, 17, 300}) scattered(n, ratio, 0.0);
        for (const double far : {1e3, 1e9, -1e15, 1e150}) scattered(200, 20.0, far);
        clusters();
        special_boxes();
        nan_is_named();
    }

  private:
    using Box = talus::Aabb<Dim>;
    using Vec = talus::Vector<Dim>;

    static talus::Column<talus::CandidatePair> definition(const std::vector<Box>& boxes) {
        talus::Column<talus::CandidatePair> pairs;
        for (std::size_t a = 0; a < boxes.size(); ++a)
            for (std::size_t b = a + 1; b < boxes.size(); ++b) {
                bool overlap = !(is_obstacle(a) && is_obstacle(b));
                for (int d = 0; d < Dim; ++d) {
                    const Box &x = boxes[a], &y = boxes[b];
                    overlap = overlap && x.low[d] <= x.high[d] && y.low[d] <= y.high[d] &&
                              x.low[d] <= y.high[d] && y.low[d] <= x.high[d];
                }
                if (overlap)
                    pairs.push_back(
                        {static_cast<talus::BodyIndex>(a), static_cast<talus::BodyIndex>(b)});
            }
        return pairs;
    }
    static bool is_obstacle(std::size_t body) { return body % 7 == 3; }

    std::size_t check(const std::vector<Box>& boxes) {
        broad_phase_.find_pairs(
            boxes, [](talus::BodyIndex k) { return is_obstacle(static_cast<std::size_t>(k)); },
            pairs_);
        const auto expected = definition(boxes);
        BOOST_TEST((pairs_ == expected));
        return expected.size();
    }
    Box box(const Vec& centre, const Vec& half) { return {centre - half, centre + half}; }
    Vec half_sides(double ratio) {
        const double size = random_.log_uniform(1.0 / ratio, 1.0);
        Vec half;
        for (double& x : half) x = 0.5 * size * random_.uniform(0.5, 1.0);
        return half;
    }

    void scattered(int n, double ratio, double far) {
        BOOST_TEST_INFO_SCOPE(n << " bodies, size ratio " << ratio << ", far by " << far);
        std::vector<Box> boxes;
        const double extent = std::pow(n, 1.0 / Dim) * (ratio > 1.0 ? 0.5 : 0.8);
        for (int k = 0; k < n; ++k) {
            Vec centre;
            for (double& x : centre) x = far + extent * random_.uniform(0.0, 1.0);
            boxes.push_back(box(centre, half_sides(ratio)));
        }
        const std::size_t pairs = check(boxes);
        if (n == 300) BOOST_TEST(pairs > 0U);
    }
    void clusters() {
        std::vector<Box> boxes;
        for (const double at : {0.0, 1.0, -1e6, 1e12})
            for (int k = 0; k < 40; ++k)
                boxes.push_back(
                    box(at * Vec::Ones() + 1.5 * random_.unit<Dim>(), half_sides(20.0)));
        BOOST_TEST(check(boxes) > 10U);
    }
    void special_boxes() {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        constexpr double huge = std::numeric_limits<double>::max();
        std::vector<Box> boxes(20, box(Vec::Ones(), 0.5 * Vec::Ones()));  // coincident
        BOOST_TEST(check(boxes) == 187U);                                 // 190 less 3 of obstacles
        boxes.push_back({Vec::Constant(-infinity), Vec::Constant(infinity)});
        Box half_space = boxes.back();
        half_space.high[Dim - 1] = 0.5;  // touches the others
        boxes.push_back(half_space);
        half_space.high[Dim - 1] = 0.4;
        boxes.push_back(half_space);
        boxes.push_back(Box{});                                            // empty
        boxes.push_back({Vec::Ones(), Vec::Ones() - 0.1 * Vec::Unit(0)});  // empty along one axis
        boxes.push_back({Vec::Ones(), Vec::Ones()});                       // points
        boxes.push_back({1.5 * Vec::Ones(), 1.5 * Vec::Ones()});
        boxes.push_back(box(Vec::Constant(2.0), 0.5 * Vec::Ones()));  // touches at a corner
        check(boxes);
        boxes.push_back({Vec::Constant(-huge), Vec::Constant(huge)});
        boxes.push_back({Vec::Constant(huge), Vec::Constant(huge)});
        boxes.push_back(box(Vec::Zero(), Vec::Constant(5e-324)));
        check(boxes);
        const std::vector<Box> points(5, Box{Vec::Ones(), Vec::Ones()});
        BOOST_TEST(check(points) == 10U);
        const std::vector<Box> nothing(3);
        BOOST_TEST(check(nothing) == 0U);
    }
    void nan_is_named() {
        std::vector<Box> boxes(5, box(Vec::Zero(), Vec::Ones()));
        boxes[3].high[Dim - 1] = std::numeric_limits<double>::quiet_NaN();
        BOOST_CHECK_EXCEPTION(check(boxes), talus::input_error, [](const auto& e) {
            return std::string(e.what()).find("body 3") != std::string::npos;
        });
    }

    Broad broad_phase_;
    talus::Column<talus::CandidatePair> pairs_;
    RandomBlocks random_;
};

template <int Dim, talus::BroadPhase<Dim> Broad>
void test_broad_phase(unsigned seed) {
    BOOST_TEST_INFO_SCOPE("seed " << seed);
    BroadPhaseTester<Dim, Broad>(seed).run();
}
