// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/law/prepared.hpp>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <limits>

#include "common/effort.hpp"
#include "common/random_blocks.hpp"

/// Error of r as the answer to the one-contact problem, relative to the largest of the impulse, the
/// one that would stop b, and `own_scale`, an impulse that the law brings along.
template <int Dim, class Law>
double law_error(const Law& law, const talus::LocalProblem<Dim>& p, const talus::Vector<Dim>& r,
                 double own_scale = 0.0) {
    const double rho = p.W.trace() > 0.0 ? Dim / p.W.trace() : 1.0;
    const talus::Vector<Dim> off = r - law.natural_map(p.velocity(r), r, rho);
    const double scale = std::max({r.norm(), rho * p.b.norm(), own_scale});
    return scale > 0.0 ? off.norm() / scale : off.norm();
}

/// What a law under test says of itself besides the concept.
template <int Dim>
struct LawTraits {
    bool unilateral = true;        ///< of prospective type
    double friction = 0.0;         ///< enters the rounding bound: the natural map multiplies |u_t|
    double unique_coupling = 1e9;  ///< unique answer where |W_tn| <= this times W_nn
    bool rolling = false;          ///< the second half of the tangents turns apart from the first
};

/// The impulse that `law` brings along, -n times which is that of an open contact: 0 where the law
/// is homogeneous in (r, b).
template <class Law>
double own_impulse(const Law& law) {
    if constexpr (requires { law.cohesion; })
        return law.cohesion;
    else
        return 0.0;
}
/// `law` for impulses `factor` times as large: the law itself where it is homogeneous.
template <class Law>
Law for_impulses_times(Law law, double factor) {
    if constexpr (requires { law.cohesion; }) law.cohesion *= factor;
    return law;
}

/// Properties that every ContactLaw must have, on random problems. `admissible(r)` tells whether an
/// impulse is of the allowed kind; for a law with an impulse of its own, `admissible(law, r)`.
template <int Dim, class Law, class Admissible>
class LawTester {
  public:
    LawTester(Law law, LawTraits<Dim> traits, Admissible admissible, unsigned seed)
        : law_(law), traits_(traits), admissible_(admissible), random_(seed), seed_(seed) {}

    void run() {
        BOOST_TEST_INFO_SCOPE("seed " << seed_);
        for (int k = 0; k < repetitions(3000, 500); ++k) {
            solves(random_.well_conditioned<Dim>());
            solves(random_.semidefinite<Dim>(Dim));
            const talus::Matrix<Dim> deficient =
                random_.semidefinite<Dim>(random_.integer(1, Dim - 1));
            if (traits_.unilateral && unique(deficient)) solves(deficient);
            const talus::Matrix<Dim> w = random_.well_conditioned<Dim>();
            if (unique(w)) invariances({w, random_.normal<Dim>()});
        }
    }

  private:
    using Problem = talus::LocalProblem<Dim>;
    using Vec = talus::Vector<Dim>;
    static constexpr double epsilon = std::numeric_limits<double>::epsilon();

    /// The answer is exact to some ulps of W r + b, which friction multiplies in the natural map.
    double rounding() const { return 100.0 * epsilon * (1.0 + traits_.friction); }

    bool unique(const talus::Matrix<Dim>& w) const {
        return w.template bottomLeftCorner<Dim - 1, 1>().norm() <=
               traits_.unique_coupling * w(0, 0);
    }

    void solves(const talus::Matrix<Dim>& w) {
        const double mobility = random_.log_uniform(1e-12, 1e12);
        const double speed = random_.log_uniform(1e-12, 1e12);
        const Problem p{w * mobility, random_.normal<Dim>() * speed};
        const Law law = for_impulses_times(law_, speed / mobility);
        const double own = own_impulse(law);
        const Vec r = law.solve(p, Vec::Zero());
        BOOST_TEST_INFO_SCOPE("W = " << p.W << "\nb = " << p.b.transpose()
                                     << "\nr = " << r.transpose());
        BOOST_REQUIRE(r.allFinite());
        BOOST_TEST(law_error<Dim>(law, p, r, own) <= rounding());
        if constexpr (requires { admissible_(law, r); })
            BOOST_TEST(admissible_(law, r));
        else
            BOOST_TEST(admissible_(r));
        const Vec u = p.velocity(r);
        const double u_scale = p.b.norm() + p.W.norm() * (r.norm() + own);
        if (traits_.unilateral) {
            BOOST_TEST(u[0] >= -rounding() * u_scale);
            if (u[0] > rounding() * u_scale) BOOST_TEST((r + own * Vec::Unit(0)).norm() == 0.0);
        }
        BOOST_TEST(r.dot(u) <= rounding() * u_scale * (r.norm() + own));
    }

    talus::Matrix<Dim> change_of_tangents() {
        talus::Matrix<Dim> q = random_.change_of_tangents<Dim>();
        if constexpr (talus::RollingRows<Dim>) {
            if (!traits_.rolling) return q;
            constexpr int half = (Dim - 1) / 2;
            q.setIdentity();
            q.template block<half, half>(1, 1) = random_.orthogonal<half>();
            q.template block<half, half>(1 + half, 1 + half) = random_.orthogonal<half>();
        }
        return q;
    }

    void invariances(const Problem& p) {
        // Answers of well-conditioned problems move by the condition number (10, and the margin of
        // uniqueness) times the rounding.
        const double tolerance = 1e5 * rounding();
        const Vec r = law_.solve(p, Vec::Zero());
        const double scale = r.norm() + p.b.norm() + own_impulse(law_);
        const auto same = [&](const Vec& other) { return (other - r).norm() <= tolerance * scale; };

        const talus::Matrix<Dim> q = change_of_tangents();
        BOOST_TEST(same(q.transpose() * law_.solve({q * p.W * q.transpose(), q * p.b}, r)));
        const double factor = random_.log_uniform(1e-6, 1e6);
        BOOST_TEST(same(for_impulses_times(law_, factor).solve({p.W, factor * p.b}, r) / factor));
        BOOST_TEST(
            same(for_impulses_times(law_, 1.0 / factor).solve({factor * p.W, p.b}, r) * factor));
        const Vec start = random_.normal<Dim>();
        BOOST_TEST(same(law_.solve(p, start)));
        BOOST_TEST(same(
            talus::improved<Dim>(law_, talus::prepare<Dim>(law_, p.W), p.velocity(start), start)));
    }

    Law law_;
    LawTraits<Dim> traits_;
    Admissible admissible_;
    RandomBlocks random_;
    unsigned seed_;
};

template <int Dim, class Law, class Admissible>
void test_law(Law law, LawTraits<Dim> traits, Admissible admissible, unsigned seed) {
    LawTester<Dim, Law, Admissible>(law, traits, admissible, seed).run();
}
