// SPDX-License-Identifier: BSL-1.0
#include <talus/lagrangian/event_driven/acceleration_choice.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

BOOST_AUTO_TEST_SUITE(lagrangian_acceleration_problem)

using talus::AccelerationProblem;
using talus::ChoiceStatus;
using talus::ContactMode;
using talus::ExcludedMode;
using talus::LemkeStatus;
using talus::ModeSearch;

namespace {

/// The same numbers with every compiler: an additive sequence, in (-1, 1).
class Numbers {
  public:
    explicit Numbers(std::uint64_t seed) : state_(seed) {}
    double next() {
        state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
        return static_cast<double>(state_ >> 11) / 4503599627370496.0 - 1.0;
    }
    bool coin() { return next() > 0.0; }

  private:
    std::uint64_t state_;
};

/// Contacts of a system of as many degrees of freedom as rows, and some more.
AccelerationProblem random_problem(Numbers& numbers, Eigen::Index n, double mu) {
    AccelerationProblem p;
    const Eigen::Index size = 2 * n;
    Eigen::MatrixXd h(size + 2, size);
    for (Eigen::Index j = 0; j < h.cols(); ++j)
        for (Eigen::Index i = 0; i < h.rows(); ++i) h(i, j) = numbers.next();
    p.w = h.transpose() * h;
    p.b.resize(size);
    for (Eigen::Index i = 0; i < size; ++i) p.b[i] = 10.0 * numbers.next();
    p.slip.setZero(1, n);
    for (Eigen::Index k = 0; k < n; ++k) {
        const bool rough = mu > 0.0 && numbers.next() > -0.5;
        p.mu.push_back(rough ? mu * std::abs(numbers.next()) : 0.0);
        if (rough && numbers.coin()) p.slip(0, k) = numbers.coin() ? 1.0 : -1.0;
    }
    return p;
}
/// Painleve's rod, its tip at rest or sliding to the side where friction presses it down.
AccelerationProblem rod(double angle, double mu, double normal, bool slides) {
    const double s = std::sin(angle), c = std::cos(angle);
    AccelerationProblem p;
    p.w.resize(2, 2);
    p.w << 1.0 + 3.0 * c * c, -3.0 * s * c, -3.0 * s * c, 1.0 + 3.0 * s * s;
    p.b.resize(2);
    p.b << normal, 0.0;
    p.mu = {mu};
    p.slip.resize(1, 1);
    p.slip << (slides ? -1.0 : 0.0);
    return p;
}

}  // namespace

BOOST_AUTO_TEST_CASE(lemke_solves_what_has_a_known_solution) {
    Eigen::MatrixXd m(2, 2);
    m << 2.0, 1.0, 1.0, 2.0;
    const auto found = talus::lemke(m, Eigen::Vector2d(-5.0, -6.0));
    BOOST_TEST((found.status == LemkeStatus::solved));
    BOOST_CHECK_SMALL((found.z - Eigen::Vector2d(4.0 / 3.0, 7.0 / 3.0)).norm(), 1e-14);
    const auto none = talus::lemke(-m, Eigen::Vector2d(-5.0, -6.0));
    BOOST_TEST((none.status == LemkeStatus::ray));
    const auto nothing = talus::lemke(m, Eigen::Vector2d(5.0, 0.0));
    BOOST_TEST((nothing.status == LemkeStatus::solved && nothing.pivots == 0));
    BOOST_CHECK_SMALL(nothing.z.norm(), 1e-300);
    // Ties in every pivot: without an order of rows this one may cycle.
    const Eigen::MatrixXd ones = Eigen::MatrixXd::Ones(6, 6);
    const auto tied = talus::lemke(ones, -Eigen::VectorXd::Ones(6));
    BOOST_TEST((tied.status == LemkeStatus::solved));
    BOOST_CHECK_SMALL((ones * tied.z - Eigen::VectorXd::Ones(6)).norm(), 1e-14);
}

/// Without friction, and with so little that the solution is the only one.
BOOST_AUTO_TEST_CASE(lemke_and_enumeration_find_the_same_motion) {
    Numbers numbers(11);
    int closed = 0;
    for (const double mu : {0.0, 0.02})
        for (Eigen::Index n = 1; n <= 4; ++n)
            for (int trial = 0; trial < 40; ++trial) {
                const AccelerationProblem p = random_problem(numbers, n, mu);
                ModeSearch search;
                search.run(p);
                BOOST_TEST((search.complete() && search.solutions().size() == 1u));
                const auto lemke = talus::solve_by_lemke(p);
                BOOST_REQUIRE(lemke.has_value());
                const auto& s = search.solutions().front();
                const double scale = p.b.norm() + (s.acceleration - p.b).norm();
                BOOST_CHECK_SMALL((lemke->acceleration - s.acceleration).norm() / scale, 1e-9);
                BOOST_CHECK_SMALL((lemke->force - s.force).norm() / (1.0 + s.force.norm()), 1e-6);
                for (std::size_t k = 0; k < p.contact_count(); ++k) closed += s.modes.closed(k);
            }
    BOOST_TEST(closed > 200);
}

/// With much friction there may be several solutions or none: Lemke's is one of them.
BOOST_AUTO_TEST_CASE(what_lemke_finds_is_one_of_all_solutions) {
    Numbers numbers(12);
    int several = 0, none = 0, missed = 0, found_by_both = 0;
    for (Eigen::Index n = 1; n <= 3; ++n)
        for (int trial = 0; trial < 150; ++trial) {
            const AccelerationProblem p = random_problem(numbers, n, 2.0);
            ModeSearch search;
            const auto all = search.run(p);
            const auto lemke = talus::solve_by_lemke(p);
            several += all.size() > 1;
            none += all.empty();
            if (all.empty()) BOOST_TEST(!lemke.has_value());
            if (!lemke) {
                missed += !all.empty();
                continue;
            }
            bool among = false;
            for (const auto& s : all)
                among = among || (s.acceleration - lemke->acceleration).norm() <=
                                     1e-6 * (p.b.norm() + s.acceleration.norm());
            BOOST_TEST(among);
            ++found_by_both;
        }
    BOOST_TEST_MESSAGE("of 450: several " << several << ", none " << none << ", found by both "
                                          << found_by_both << ", missed by Lemke " << missed);
    BOOST_TEST((several > 0 && none > 0 && found_by_both > 200));
}

BOOST_AUTO_TEST_CASE(painleves_rod_has_one_none_or_two_accelerations_and_from_rest_one_at_least) {
    constexpr double angle = 1.0471975511965976, g = 9.81;
    ModeSearch search;
    const auto count = [&](double mu, double normal, bool slides) {
        const auto n = search.run(rod(angle, mu, normal, slides)).size();
        BOOST_TEST(search.complete());
        return n;
    };
    BOOST_TEST(count(1.0, -g, true) == 1u);  // the border is at 1.347
    BOOST_TEST(count(1.0, 25.0, true) == 1u);
    BOOST_TEST(count(2.0, -g, true) == 0u);
    BOOST_TEST(count(2.0, 25.0, true) == 2u);
    BOOST_TEST(count(2.0, -g, false) >= 1u);
    const auto none = talus::choose_accelerations(rod(angle, 2.0, -g, true), {}, 5);
    BOOST_TEST((none.status == ChoiceStatus::none && none.counted));
    const auto by_lemke = talus::choose_accelerations(rod(angle, 2.0, -g, true), {}, 0);
    BOOST_TEST((by_lemke.status == ChoiceStatus::not_found && !by_lemke.counted));
    // N = m g / A with A = W_nn + mu W_nt of this side.
    const auto slip = search.run(rod(angle, 1.0, -g, true)).front();
    BOOST_CHECK_SMALL(slip.force[0] - g / (1.75 - 3.0 * std::sqrt(3.0) / 4.0), 1e-12);
    BOOST_CHECK_SMALL(slip.force[1] - slip.force[0], 1e-12);
}

BOOST_AUTO_TEST_CASE(a_mode_that_is_excluded_is_taken_only_if_nothing_else_is_left) {
    // At the limit of friction: sticking and sliding are as good.
    AccelerationProblem p = rod(0.0, 0.5, -4.0, false);
    p.w.setIdentity();
    p.b[1] = 2.0;
    const std::optional<ExcludedMode> no_stick = ExcludedMode::sticking;
    const auto choice = talus::choose_accelerations(p, {&*no_stick, 1}, 5);
    BOOST_TEST((choice.status == ChoiceStatus::one));
    BOOST_TEST((choice.solution.modes.mode[0] == ContactMode::sliding));
    BOOST_TEST(choice.solution.modes.slip(0, 0) == 1.0);
    BOOST_TEST(
        (talus::choose_accelerations(p, {}, 5).solution.modes.mode[0] == ContactMode::sticking));
    p.b[1] = 0.5;
    BOOST_TEST((talus::choose_accelerations(p, {&*no_stick, 1}, 5).solution.modes.mode[0] ==
                ContactMode::sticking));
}

/// A block on two feet: one equation more than the body has degrees of freedom.
BOOST_AUTO_TEST_CASE(redundant_contacts_have_one_motion_and_the_doubt_is_told) {
    Eigen::MatrixXd h(3, 4);  // by foot: normal, tangent; feet at -0.2 and 0.5, height 0.3
    h << 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0, 0.0, -0.2, 0.3, 0.5, 0.3;
    AccelerationProblem p;
    p.w = h.transpose() * h;
    p.mu = {0.4, 0.4};
    p.slip.setZero(1, 2);
    const auto pushed = [&](double across) {
        p.b = h.transpose() * Eigen::Vector3d(across, -9.81, 0.0);
        return talus::choose_accelerations(p, {}, 5);
    };
    const auto rests = pushed(0.1), holds = pushed(3.9), slips = pushed(4.0);
    for (const auto* choice : {&rests, &holds}) {
        BOOST_TEST((choice->status == ChoiceStatus::one));
        BOOST_CHECK_SMALL(choice->solution.acceleration.norm(), 1e-8);
    }
    BOOST_TEST((slips.status == ChoiceStatus::one));
    BOOST_CHECK_SMALL(slips.solution.acceleration[1] - (4.0 - 0.4 * 9.81), 1e-9);
    BOOST_CHECK_SMALL(slips.solution.acceleration[0], 1e-9);
    BOOST_TEST((slips.solution.modes.mode[0] == ContactMode::sliding));
}

/// In space a contact that slides has the form of a pair, one at rest with friction has none.
BOOST_AUTO_TEST_CASE(in_space_what_sticks_is_found_and_what_begins_to_slide_is_not) {
    AccelerationProblem p;
    p.rows = 3;
    p.w = Eigen::MatrixXd::Identity(3, 3);
    p.mu = {0.5};
    p.slip.setZero(2, 1);
    p.b = Eigen::Vector3d(-10.0, 3.0, 3.0);
    const auto sticks = talus::choose_accelerations(p, {}, 5);
    BOOST_TEST((sticks.status == ChoiceStatus::one && !sticks.counted));
    BOOST_TEST((sticks.solution.modes.mode[0] == ContactMode::sticking));
    p.b = Eigen::Vector3d(-10.0, 4.0, 4.0);
    BOOST_TEST((talus::choose_accelerations(p, {}, 5).status == ChoiceStatus::not_found));
    p.slip << 0.6, 0.8;
    const auto slides = talus::choose_accelerations(p, {}, 5);
    BOOST_TEST((slides.status == ChoiceStatus::one && slides.counted));
    BOOST_CHECK_SMALL((slides.solution.force - Eigen::Vector3d(10.0, -3.0, -4.0)).norm(), 1e-12);
    const auto lemke = talus::solve_by_lemke(p);
    BOOST_REQUIRE(lemke.has_value());
    BOOST_CHECK_SMALL((lemke->force - slides.solution.force).norm(), 1e-12);
}

BOOST_AUTO_TEST_SUITE_END()
