// SPDX-License-Identifier: BSL-1.0
#include "common/gallery_tester.hpp"

#include <talus/problem/residual.hpp>

#include <Eigen/SparseCore>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "common/random_problem.hpp"

template <int Dim>
talus::DelassusGlobal<Dim> with_masses(const talus::ContactJacobian<Dim>& jacobian,
                                       const talus::InverseMass<Dim>& inverse_mass) {
    const talus::BodyMap<Dim> map(jacobian, inverse_mass);
    std::vector<Eigen::Triplet<double>> m, h;
    const auto mass = [](Eigen::Index row) { return 0.5 + double(row % 5); };
    for (int i = 0; i < map.rows(); ++i) m.emplace_back(i, i, mass(i));
    for (std::size_t c = 0; c < map.contact_count(); ++c)
        for (const auto& e : map.entries(c)) {
            const auto b = map.block(e);
            const int first = map.offset(e.body);
            for (int i = 0; i < b.rows(); ++i)
                for (int d = 0; d < Dim; ++d)
                    h.emplace_back(first + i, static_cast<int>(Dim * c) + d,
                                   std::sqrt(mass(first + i)) * b(i, d));
        }
    Eigen::SparseMatrix<double> mass_matrix(map.rows(), map.rows());
    mass_matrix.setFromTriplets(m.begin(), m.end());
    Eigen::SparseMatrix<double> contact_map(map.rows(),
                                            static_cast<Eigen::Index>(Dim * map.contact_count()));
    contact_map.setFromTriplets(h.begin(), h.end());
    return {{jacobian, inverse_mass}, mass_matrix, contact_map};
}

namespace {

template <int Dim>
class GalleryTester {
  public:
    GalleryTester(SolverUnderTest<Dim> solver, std::vector<GalleryProblem<Dim>> problems)
        : solver_(std::move(solver)), problems_(std::move(problems)) {}

    void run() {
        for (const auto& entry : problems_) {
            BOOST_TEST_INFO_SCOPE("problem: " << entry.name);
            keeps_its_promise(entry);
            is_true_from_any_start(entry);
        }
        same_input_same_bits();
        nothing_to_do();
        not_finite();
    }

  private:
    using Law = talus::Coulomb<Dim>;
    using Vec = talus::Vector<Dim>;
    using Problem = talus::ContactProblem<Dim, Law>;
    using Impulses = std::vector<Vec>;
    using Solve = typename SolverUnderTest<Dim>::Solve;
    using Status = talus::SolveStatus;

    static Impulses zero(const Problem& p) { return Impulses(p.contact_count(), Vec::Zero()); }
    static bool same_bits(const Impulses& a, const Impulses& b) {
        if (a.size() != b.size()) return false;
        for (std::size_t i = 0; i < a.size(); ++i)
            if (std::memcmp(a[i].data(), b[i].data(), sizeof(double) * Dim) != 0) return false;
        return true;
    }

    /// Solves and checks that the report tells the truth.
    talus::SolveReport checked(Solve& solve, const GalleryProblem<Dim>& entry, Impulses& r,
                               double tolerance) const {
        const Problem& p = entry.problem;
        const talus::SolveReport report = solve(p, r);
        for (const Vec& x : r) BOOST_TEST(x.allFinite());
        const talus::Residual again = talus::residual(p, std::span<const Vec>(r));
        // Sums in another order, of terms up to the largest of W r; cones are taken of
        // u_N + mu |u_T|, with the rounding of that.
        const double eta = again.relative;
        double mu = 0.0;
        for (const Law& law : p.laws) mu = std::max(mu, law.mu);
        const double rounding = (1.0 + mu) * again.rounding;
        BOOST_TEST(std::abs(report.residual - eta) <= 1e-12 + 1e-6 * eta + rounding,
                   "reported " << report.residual << ", recomputed " << eta);
        BOOST_TEST((report.status == Status::converged) ==
                   (report.residual <= tolerance && report.status != Status::no_solution));
        // The residual is relative to the impulses: where they may grow without an end it falls as
        // they do, and only a solver that looks for a certificate knows.
        if (entry.kind == Kind::infeasible && solver_.promises.knows_infeasible)
            BOOST_TEST((report.status != Status::converged),
                       "converged to " << report.residual << " though nothing solves it");
        if (entry.kind != Kind::infeasible && entry.kind != Kind::unknown)
            BOOST_TEST((report.status != Status::no_solution));
        BOOST_TEST((report.status != Status::not_finite));
        BOOST_TEST((report.status != Status::stopped));
        check_history(report);
        return report;
    }
    void check_history(const talus::SolveReport& report) const {
        BOOST_TEST(report.iterations >= 0);
        BOOST_TEST(report.iterations <= solver_.max_iterations);
        BOOST_REQUIRE(!report.history.empty());
        BOOST_TEST(report.history.front().iteration == 0);
        BOOST_TEST(report.history.back().iteration == report.iterations);
        BOOST_TEST(report.history.back().residual == report.residual);
        int last = 0;
        for (const auto& sample : report.history) {
            BOOST_TEST(sample.iteration >= last);
            BOOST_TEST((std::isfinite(sample.residual) && sample.residual >= 0.0));
            last = sample.iteration;
        }
        int staged = 0;
        for (const auto& stage : report.stages) {
            staged += stage.iterations;
            BOOST_TEST(!stage.engine.empty());
            BOOST_TEST(std::isfinite(stage.residual));
        }
        if (!report.stages.empty()) BOOST_TEST(staged == report.iterations);
    }

    void keeps_its_promise(const GalleryProblem<Dim>& entry) const {
        const double promise = solver_.promises.of(entry.kind);
        const double tolerance = promise > 0.0 ? promise : 1e-8;
        Solve solve = solver_.make(tolerance);
        Impulses r = zero(entry.problem);
        const auto report = checked(solve, entry, r, tolerance);
        if (promise > 0.0)
            BOOST_TEST((report.status == Status::converged), to_string(report.status)
                                                                 << " at " << report.residual);
        if (entry.kind == Kind::infeasible && solver_.promises.knows_infeasible)
            BOOST_TEST((report.status == Status::no_solution), to_string(report.status)
                                                                   << " at " << report.residual);
        if (report.status != Status::converged) return;
        // Solved: left alone.
        Impulses again = r;
        BOOST_TEST(checked(solve, entry, again, tolerance).iterations == 0);
        BOOST_TEST(same_bits(r, again));
    }

    /// Impulses in and out of the cones, large and small.
    void is_true_from_any_start(const GalleryProblem<Dim>& entry) const {
        constexpr double tolerance = 1e-7;
        RandomBlocks random(61);
        for (const double size : {1e-3, 1.0, 1e3}) {
            BOOST_TEST_INFO_SCOPE("started from impulses of size " << size);
            Solve solve = solver_.make(tolerance);
            Impulses r = zero(entry.problem);
            for (Vec& x : r) x = size * random.normal<Dim>();
            const double begin = talus::residual(entry.problem, std::span<const Vec>(r)).relative;
            const auto report = checked(solve, entry, r, tolerance);
            BOOST_TEST(std::abs(report.history.front().residual - begin) <= 1e-6 * begin);
        }
    }

    /// From a new object and from one that has solved other problems.
    void same_input_same_bits() const {
        Solve used = solver_.make(1e-9);
        for (const auto& entry : problems_) {
            BOOST_TEST_INFO_SCOPE("problem: " << entry.name);
            Impulses once = zero(entry.problem), again = once, fresh = once;
            Solve solve = solver_.make(1e-9);
            const auto report = solve(entry.problem, once);
            for (const bool use_old : {false, true}) {
                again = zero(entry.problem);
                const auto other =
                    use_old ? used(entry.problem, again) : solver_.make(1e-9)(entry.problem, again);
                BOOST_TEST(same_bits(once, again));
                BOOST_TEST((other.status == report.status));
                BOOST_TEST(other.iterations == report.iterations);
                BOOST_TEST(other.residual == report.residual);
                BOOST_TEST(other.history.size() == report.history.size());
            }
        }
    }

    void nothing_to_do() const {
        Solve solve = solver_.make(0.0);
        Impulses none;
        const auto report = solve(Problem{}, none);
        BOOST_TEST((report.status == Status::converged));
        BOOST_TEST(report.iterations == 0);
        BOOST_TEST(report.residual == 0.0);
    }

    void not_finite() const {
        constexpr double nan = std::numeric_limits<double>::quiet_NaN();
        constexpr double infinity = std::numeric_limits<double>::infinity();
        const auto check = [&](const char* name, auto spoil) {
            BOOST_TEST_INFO_SCOPE("spoilt: " << name);
            RandomBlocks random(62);
            Problem p = RandomProblem<Dim, Law>{}.make(random, {0.5});
            Impulses r(p.contact_count(), Vec::Ones());
            spoil(p, r);
            const Impulses before = r;
            Solve solve = solver_.make(1e-8);
            const auto report = solve(p, r);
            BOOST_TEST((report.status == Status::not_finite));
            BOOST_TEST(same_bits(r, before));
            BOOST_TEST(report.iterations == 0);
            // No after-effects.
            const auto& good = problems_.front();
            Impulses cold = zero(good.problem), after = cold;
            solver_.make(1e-8)(good.problem, cold);
            solve(good.problem, after);
            BOOST_TEST(same_bits(cold, after));
        };
        check("free velocity", [](auto& p, auto&) { p.free_velocity[1][0] = nan; });
        check("tangential free velocity", [](auto& p, auto&) { p.free_velocity[1][1] = nan; });
        check("infinite free velocity", [](auto& p, auto&) { p.free_velocity[0][0] = infinity; });
        check("infinite mobility", [](auto& p, auto&) { p.inverse_mass.linear[0] = infinity; });
        check("mobility", [](auto& p, auto&) { p.inverse_mass.linear[0] = nan; });
        check("frame", [](auto& p, auto&) { p.jacobian.frame[2](0, 0) = nan; });
        check("friction", [](auto& p, auto&) { p.laws[2].mu = nan; });
        check("impulse", [](auto&, auto& r) { r[3][1] = nan; });
        check("infinite impulse", [](auto&, auto& r) { r[3][0] = infinity; });
    }

    SolverUnderTest<Dim> solver_;
    std::vector<GalleryProblem<Dim>> problems_;
};

}  // namespace

template <int Dim>
void test_on_problems(const SolverUnderTest<Dim>& solver,
                      const std::vector<GalleryProblem<Dim>>& problems) {
    GalleryTester<Dim>(solver, problems).run();
}

template <int Dim>
void test_forms_agree(const std::vector<SolverUnderTest<Dim>>& solvers, double tolerance,
                      double agreement, unsigned seed) {
    using Vec = talus::Vector<Dim>;
    RandomBlocks random(seed);
    for (int k = 0; k < 20; ++k) {
        BOOST_TEST_INFO_SCOPE("problem " << k);
        auto p =
            RandomProblem<Dim, talus::Coulomb<Dim>>{.bodies = 8, .contacts = 6, .arm = 0.1}.make(
                random, {0.2});
        move_bodies_only<Dim>(p, random);
        talus::DelassusProduct<Dim> w(p.jacobian, p.inverse_mass);
        std::vector<std::vector<Vec>> found;
        for (const auto& solver : solvers) {
            std::vector<Vec> r(p.contact_count(), Vec::Zero()), u = r;
            BOOST_TEST((solver.make(tolerance)(p, r).status == talus::SolveStatus::converged));
            w.multiply(r, u);
            double difference = 0.0;
            found.push_back(u);
            for (std::size_t c = 0; c < u.size(); ++c)
                difference = std::max(difference, (u[c] - found[0][c]).norm());
            BOOST_TEST(difference <= agreement);
        }
    }
}

#define TALUS_INSTANTIATE(Dim)                                                               \
    template talus::DelassusGlobal<Dim> with_masses(const talus::ContactJacobian<Dim>&,      \
                                                    const talus::InverseMass<Dim>&);         \
    template void test_on_problems(const SolverUnderTest<Dim>&,                              \
                                   const std::vector<GalleryProblem<Dim>>&);                 \
    template void test_forms_agree(const std::vector<SolverUnderTest<Dim>>&, double, double, \
                                   unsigned);
TALUS_INSTANTIATE(2)
TALUS_INSTANTIATE(3)
