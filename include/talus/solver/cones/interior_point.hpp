// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/instantiate.hpp>
#include <talus/core/types.hpp>
#include <talus/law/coulomb.hpp>
#include <talus/solver/cones/cone_engine.hpp>
#include <talus/solver/cones/nesterov_todd.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace talus {

struct InteriorPointParams {
    /// Factorisations allowed [-], not negative. 10 to 30 are usual, nearly whatever the size.
    int max_iterations = 80;
    /// On the residual of problem/residual.hpp [-].
    double tolerance = 1e-8;
    /// How far inside the cones the solver begins, in root mean square free velocities per contact
    /// [-], positive: 1 forgets most of the warm start, 0.01 trusts it. Zero impulses begin at 1.
    double margin = 0.1;
    /// Inner iterations allowed for one direction of InexactInteriorPoint [-], positive. 5 to 100
    /// are usual.
    int max_inner_iterations = 1000;
};

/// How InteriorPoint solves (W + D) x = b for its directions: by factors.
template <int Dim>
class FactoredDirections {
  public:
    /// Progress that shows a path is worth following: the fall of the gap in 12 steps.
    static constexpr double hope = 0.5;

    void begin(const ConeSystem<Dim>& /*system*/) {}
    bool prepare(ConeSystem<Dim>& system, std::span<const Matrix<Dim>> d) {
        return system.factorize(d);
    }
    /// x with an error in u that is far below `allowed` [sqrt(J)].
    bool solve(ConeSystem<Dim>& system, const Eigen::VectorXd& b, Eigen::VectorXd& x,
               double /*allowed*/, int /*max_iterations*/) {
        system.solve(b, x);
        return true;
    }
};

/// Primal-dual interior point for the exact law of Coulomb, without de Saxce's shift. The central
/// path of this solver asks at each contact, with z = (mu r_n, r_t) and a free slack sigma,
///
///   u_n r_n = eps,     (sigma, u_t) o z = eps e      (Jordan product of the second-order cone),
///
/// that is: normal unilaterality on its barrier, and friction on the barrier of the disc |r_t| <=
/// mu r_n with the present r_n, sigma being the multiplier of the disc times mu r_n. For eps -> 0
/// it gives Coulomb's law itself: as sigma enters no other equation, nothing has to open a contact
/// that slides, which is what the shift mu |u_t| of the associated cone repairs. Directions are
/// those of Nesterov and Todd's scaling [NesterovTodd1998] for each disc, with Mehrotra's
/// correction [Mehrotra1992]; elimination leaves (W + D) dr = b, D block-diagonal, lower triangular
/// in (n, t) and not symmetric, as the law is not: for that BlockLu factorises.
///
/// Solves hyperstatic systems and masonry in 5 to 25 factorisations, almost independently of size
/// and tolerance; impulses from some sweeps spare a third of them. The problem is not monotone: the
/// path may turn back in flowing packings with many slow slips (the determinant of W + D changes
/// its sign there), and steps then shrink to nothing. The status is `stalled` and the best impulses
/// met are returned; another `margin` or warm start may lead to a path that goes through.
///
/// `InteriorPoint` is this with factors, `InexactInteriorPoint` (inexact_interior_point.hpp)
/// without.
template <int Dim, ConeLaw<Dim> Law, class Directions>
class BasicInteriorPoint : public ConeEngine<Dim, Law, BasicInteriorPoint<Dim, Law, Directions>> {
  public:
    explicit BasicInteriorPoint(InteriorPointParams params = {}) : params(params) {}
    InteriorPointParams params;

    const Directions& directions() const { return directions_; }

  private:
    using Base = ConeEngine<Dim, Law, BasicInteriorPoint<Dim, Law, Directions>>;
    friend Base;
    using Vec = Eigen::VectorXd;
    using Point = Vector<Dim>;
    using Cone = SecondOrderCone<Dim>;

    struct Contact {
        double mu;
        double u_n;  ///< slack of the normal velocity [sqrt(J)], > 0: equal to it on arrival only
        Point s;     ///< (sigma, slack of u_t) [sqrt(J)], inside the cone
        NesterovTodd<Dim> scaling;
        // Of the direction in hand.
        double du_n, normal_correction;
        Point ds, correction, right;
    };

    void iterate(Vec& r);

    /// z = (mu r_n, r_t), in the second-order cone.
    Point disc(const Vec& r, std::size_t c) const {
        Point z = r.template segment<Dim>(Base::System::first(c));
        z[0] *= contacts_[c].mu;
        return z;
    }

    void start(Vec& r);
    double scale_contacts(const Vec& r);
    double allowed_error(const Vec& r) const;
    bool find_direction(const Vec& r, double target);
    double longest_step(const Vec& r) const;
    double gap_after(const Vec& r, double step) const;
    void correct();
    void drop_corrections();

    std::vector<Contact> contacts_;
    std::vector<Matrix<Dim>> d_;
    Vec u_, right_, dr_;
    double gap_ = 0.0;  ///< mean complementarity where D was taken
    Directions directions_;
};

/// Moves r into the cones, and velocities with it.
template <int Dim, ConeLaw<Dim> Law, class Directions>
void BasicInteriorPoint<Dim, Law, Directions>::start(Vec& r) {
    const auto& system = this->system_;
    const double scale =
        system.free_velocity().norm() / std::sqrt(static_cast<double>(system.contact_count()));
    const double margin = r.squaredNorm() > 0.0 ? params.margin * scale : scale;
    constexpr double inside = 0.9;  // of the cone's radius at most
    for (std::size_t c = 0; c < system.contact_count(); ++c) {
        const Eigen::Index i = system.first(c);
        r[i] = std::max(r[i], margin);
        auto tangential = r.template segment<Dim - 1>(i + 1);
        const double reach = inside * system.cone(c).mu * r[i], length = tangential.norm();
        if (length > reach) tangential *= reach / length;
    }
    system.multiply(r, u_);
    u_ += system.free_velocity();
    contacts_.resize(system.contact_count());
    d_.resize(system.contact_count());
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
        Contact& k = contacts_[c];
        k.mu = system.cone(c).mu;
        k.s = u_.template segment<Dim>(system.first(c));
        k.u_n = std::max(k.s[0], margin);
        k.s[0] = k.s.template tail<Dim - 1>().norm() + margin;
        // Without friction there is no disc, and no pair for it.
        if (k.mu == 0.0) k.s.setZero();
    }
}

/// Scales all contacts, fills D; returns the mean complementarity.
template <int Dim, ConeLaw<Dim> Law, class Directions>
double BasicInteriorPoint<Dim, Law, Directions>::scale_contacts(const Vec& r) {
    constexpr double rigid = 1e30;  // no tangential impulse
    double gap = 0.0;
    std::size_t pairs = 0;
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
        Contact& k = contacts_[c];
        const double r_n = r[Base::System::first(c)];
        gap += k.u_n * r_n;
        ++pairs;
        if (k.mu > 0.0) {
            const Point z = disc(r, c);
            gap += k.s.dot(z);
            ++pairs;
            k.scaling = NesterovTodd<Dim>(k.s, z);
            d_[c] = k.scaling.square();
            d_[c].template leftCols<1>() *= k.mu;
        } else {
            d_[c] = rigid * Matrix<Dim>::Identity();
        }
        // Sigma is eliminated with its row: u_n sees r_n alone. What is left of its column is the
        // coupling of r_n to u_t, by the radius mu r_n.
        d_[c].template topRows<1>().setZero();
        d_[c](0, 0) = k.u_n / r_n;
    }
    return gap / static_cast<double>(pairs);
}

/// In u, for directions that need not be exact [DemboEisenstatSteihaug1982]: a tenth of what the
/// path asks of u where contacts press.
template <int Dim, ConeLaw<Dim> Law, class Directions>
double BasicInteriorPoint<Dim, Law, Directions>::allowed_error(const Vec& r) const {
    // On the path u_n = gap / r_n. Less than the tolerance asks for is of no use.
    constexpr double share = 0.1;
    const double path = gap_ * static_cast<double>(contacts_.size()) / r.norm();
    const auto& system = this->system_;
    const double whole = std::max(r.norm(), system.free_velocity().norm());
    const double enough = params.tolerance * std::min(whole, system.finest_scale());
    return share * std::max(enough, std::min(right_.norm(), path));
}

/// Newton's direction to the point of complementarity `target` of the path, with the corrections
/// stored.
template <int Dim, ConeLaw<Dim> Law, class Directions>
bool BasicInteriorPoint<Dim, Law, Directions>::find_direction(const Vec& r, double target) {
    right_.resize(r.size());
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
        Contact& k = contacts_[c];
        const Eigen::Index i = Base::System::first(c);
        k.right[0] = (target - k.u_n * r[i] - k.normal_correction) / r[i];
        right_[i] = k.right[0] - (u_[i] - k.u_n);
        auto tangential = right_.template segment<Dim - 1>(i + 1);
        tangential.setZero();
        if (k.mu == 0.0) continue;
        Point x = -Cone::product(k.scaling.lambda, k.scaling.lambda) - k.correction;
        x[0] += target;
        const Point h = k.scaling.times(Cone::quotient(k.scaling.lambda, x));
        k.ds = h;
        tangential = h.template tail<Dim - 1>() -
                     (u_.template segment<Dim - 1>(i + 1) - k.s.template tail<Dim - 1>());
    }
    if (!directions_.solve(this->system_, right_, dr_, allowed_error(r),
                           params.max_inner_iterations))
        return false;
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
        Contact& k = contacts_[c];
        const Eigen::Index i = Base::System::first(c);
        k.du_n = k.right[0] - k.u_n / r[i] * dr_[i];
        if (k.mu > 0.0)
            k.ds -= k.scaling.times(k.scaling.times(disc(dr_, c)));
        else
            dr_.template segment<Dim - 1>(i + 1).setZero();
    }
    return dr_.allFinite();
}

template <int Dim, ConeLaw<Dim> Law, class Directions>
double BasicInteriorPoint<Dim, Law, Directions>::longest_step(const Vec& r) const {
    double step = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
        const Contact& k = contacts_[c];
        const Eigen::Index i = Base::System::first(c);
        if (k.du_n < 0.0) step = std::min(step, -k.u_n / k.du_n);
        if (dr_[i] < 0.0) step = std::min(step, -r[i] / dr_[i]);
        if (k.mu > 0.0)
            step = std::min({step, Cone::longest_step(disc(r, c), disc(dr_, c)),
                             Cone::longest_step(k.s, k.ds)});
    }
    return step;
}

/// Mean complementarity after a step.
template <int Dim, ConeLaw<Dim> Law, class Directions>
double BasicInteriorPoint<Dim, Law, Directions>::gap_after(const Vec& r, double step) const {
    double gap = 0.0;
    std::size_t pairs = 0;
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
        const Contact& k = contacts_[c];
        const Eigen::Index i = Base::System::first(c);
        gap += (k.u_n + step * k.du_n) * (r[i] + step * dr_[i]);
        ++pairs;
        if (k.mu == 0.0) continue;
        gap += (k.s + step * k.ds).dot(disc(r, c) + step * disc(dr_, c));
        ++pairs;
    }
    return gap / static_cast<double>(pairs);
}

/// Mehrotra's second-order terms of the direction in hand.
template <int Dim, ConeLaw<Dim> Law, class Directions>
void BasicInteriorPoint<Dim, Law, Directions>::correct() {
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
        Contact& k = contacts_[c];
        k.normal_correction = k.du_n * dr_[Base::System::first(c)];
        if (k.mu > 0.0)
            k.correction = Cone::product(k.scaling.divided(k.ds), k.scaling.times(disc(dr_, c)));
    }
}

template <int Dim, ConeLaw<Dim> Law, class Directions>
void BasicInteriorPoint<Dim, Law, Directions>::drop_corrections() {
    for (Contact& k : contacts_) {
        k.normal_correction = 0.0;
        k.correction.setZero();
    }
}

template <int Dim, ConeLaw<Dim> Law, class Directions>
void BasicInteriorPoint<Dim, Law, Directions>::iterate(Vec& best) {
    require_positive("margin", params.margin);
    require_positive("max_inner_iterations", params.max_inner_iterations);
    directions_.begin(this->system_);
    Vec r = best;  // inside the cones always; `best` is the one of least residual
    start(r);
    double gap_before = std::numeric_limits<double>::infinity();
    for (int k = 1; k <= params.max_iterations; ++k) {
        const double gap = gap_ = scale_contacts(r);
        if (!std::isfinite(gap) || !directions_.prepare(this->system_, d_)) break;
        dr_.setZero(r.size());
        drop_corrections();
        if (!find_direction(r, 0.0)) break;
        const double affine = std::min(1.0, longest_step(r));
        // Mehrotra's rule for how far to go down, and none of it near the edge.
        constexpr double edge = 0.1;
        double centring = 0.8;
        if (affine >= edge) {
            centring = std::pow(std::max(gap_after(r, affine), 0.0) / gap, 3);
            centring = std::clamp(centring, 1e-8, 1.0);
            correct();
        }
        if (!find_direction(r, centring * gap)) break;
        // 0.995 of the way to the boundary, where the barrier is infinite.
        double step = std::min(1.0, 0.995 * longest_step(r));
        // The correction is for a full step: where that is out of reach it points astray.
        if (step < edge) {
            drop_corrections();
            if (!find_direction(r, 0.8 * gap)) break;
            step = std::min(1.0, 0.9 * longest_step(r));
        }
        r += step * dr_;
        for (Contact& c : contacts_) {
            c.u_n += step * c.du_n;
            if (c.mu > 0.0) c.s += step * c.ds;
        }
        this->system_.multiply(r, u_);
        u_ += this->system_.free_velocity();
        if (this->offer(k, r, u_, best)) return;
        // A path that turned back: complementarity does not fall any more.
        constexpr int patience = 12;
        if (k % patience != 0) continue;
        if (gap > Directions::hope * gap_before) break;
        gap_before = gap;
    }
}

template <int Dim, ConeLaw<Dim> Law>
using InteriorPoint = BasicInteriorPoint<Dim, Law, FactoredDirections<Dim>>;

}  // namespace talus

TALUS_IN_PLANE(
    class talus::ConeEngine<2, talus::Coulomb<2>, talus::InteriorPoint<2, talus::Coulomb<2>>>)
TALUS_IN_SPACE(
    class talus::ConeEngine<3, talus::Coulomb<3>, talus::InteriorPoint<3, talus::Coulomb<3>>>)
TALUS_IN_PLANE(class talus::BasicInteriorPoint<2, talus::Coulomb<2>, talus::FactoredDirections<2>>)
TALUS_IN_SPACE(class talus::BasicInteriorPoint<3, talus::Coulomb<3>, talus::FactoredDirections<3>>)
