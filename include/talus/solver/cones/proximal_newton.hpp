// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/instantiate.hpp>
#include <talus/core/types.hpp>
#include <talus/law/coulomb.hpp>
#include <talus/solver/cones/central_pair.hpp>
#include <talus/solver/cones/cone_engine.hpp>
#include <talus/solver/cones/overlap_certificate.hpp>

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace talus {

struct ProximalNewtonParams {
    /// Newton steps allowed in all, a factorisation each [-], not negative.
    int max_iterations = 300;
    /// On the residual of problem/residual.hpp [-].
    double tolerance = 1e-8;
    /// The first alpha [-], positive, in units where the diagonal of W is of order 1: near 1 the
    /// first inner problems are easy and their solutions near the warm start.
    double proximal = 0.1;
};

/// Proximal point with a semismooth Newton method inside. The outer step [Rockafellar1976] solves
/// the same laws with
///
///   W + alpha 1  instead of  W,   q - alpha r_k  instead of  q   (scaled units),
///
/// which has the solutions of the given problem as fixed points and, however hyperstatic W is, a
/// regular matrix. alpha falls tenfold with every step that comes easily, so that the outer
/// iteration ends superlinearly, and rises where the inner one stops.
///
/// The inner problem is first Alart and Curnier's pair of equations [AlartCurnier1991] at each
/// contact, with rho = 1 / (1 + alpha), and x = r - rho u:
///
///   r_n = max(0, x_n),   r_t = nearest point to x_t of the disc of radius mu max(0, x_n).
///
/// An element (A dr + B du) of their generalised derivative [QiSun1993] leads to
/// (W + alpha 1 + B^-1 A) dr = b, not symmetric, as the law is not; B is made regular by adding
/// 1e-9. Steps are halved until the error is below the largest of the last four
/// [GrippoEtAl1986]. Steps that stop short are kept if the residual fell.
///
/// Where that stops twice, as it does where many contacts are on the border of two statuses, the
/// solver begins anew with the smooth pairs of solver/cones/central_pair.hpp, whose sqrt(eps) is
/// the outer error: u = W r + q alone is left to Newton. Begun where the first equations ended they
/// gain nothing: they must come along the middle of the cones. After six stops more the first
/// equations go on from the best impulses: they are the better ones for a friction of 1e3.
///
/// Proximal point and a semismooth Newton method together are the sturdiest solver of the
/// comparison [AcaryBremondHuber2018]. Here: 4 to 15 factorisations for most of the problems of
/// other codes, masonry and hyperstatic ones included, 40 to 80 for the rest, also at 1e-12.
/// Flowing packings end at some 1e-4, 2e-5 at best, as with all factorising engines: `stalled` or
/// `iteration_limit`, with the best impulses met.
///
/// `no_solution` is reported where impulses grow along normal ones that move nothing and yet meet a
/// velocity: no motion separates all contacts then (Farkas' lemma).
template <int Dim, ConeLaw<Dim> Law>
class ProximalNewton : public ConeEngine<Dim, Law, ProximalNewton<Dim, Law>> {
  public:
    explicit ProximalNewton(ProximalNewtonParams params = {}) : params(params) {}
    ProximalNewtonParams params;

  private:
    using Base = ConeEngine<Dim, Law, ProximalNewton<Dim, Law>>;
    friend Base;
    using Vec = Eigen::VectorXd;
    using Tangent = Eigen::Matrix<double, Dim - 1, 1>;
    using TangentMatrix = Eigen::Matrix<double, Dim - 1, Dim - 1>;

    enum class Inner { solved, stopped, over };

    void iterate(Vec& best);
    Inner solve_inner(Vec& best, int& iteration);
    double evaluate(const Vec& x);
    double evaluate_sharp(const Vec& r);
    double evaluate_smooth(const Vec& x);
    void find_direction();
    void differentiate_sharp();
    void set_smoothness(double residual);
    bool proves_overlap();

    double rho() const { return 1.0 / (1.0 + alpha_); }
    /// Velocity of the inner problem.
    Vector<Dim> inner_velocity(Eigen::Index i) const {
        return u_.template segment<Dim>(i) +
               alpha_ * (r_.template segment<Dim>(i) - centre_.template segment<Dim>(i));
    }

    double alpha_ = 1.0;
    int easy_ = 0;  ///< Newton steps of the last inner problem
    bool smooth_ = false;
    double eps_ = 0.0;       ///< of the smooth pairs
    Vec centre_, begin_;     ///< r_k and r_0
    Vec x_, from_;           ///< unknowns: r, or r - u where smooth
    Vec r_, u_;              ///< impulses at x and W r + q
    Vec error_;              ///< of the inner equations
    Vec right_, dr_, step_;  ///< step_: of the unknowns
    std::vector<Matrix<Dim>> d_;
    std::vector<CentralPair<Dim>> pairs_;
    OverlapCertificate<Dim> certificate_;
};

/// Takes the unknowns; returns the size of the inner equations' error.
template <int Dim, ConeLaw<Dim> Law>
double ProximalNewton<Dim, Law>::evaluate(const Vec& x) {
    return smooth_ ? evaluate_smooth(x) : evaluate_sharp(x);
}

template <int Dim, ConeLaw<Dim> Law>
double ProximalNewton<Dim, Law>::evaluate_smooth(const Vec& x) {
    const auto& system = this->system_;
    r_.resize(x.size());
    error_.resize(x.size());
    pairs_.resize(system.contact_count());
    for (std::size_t c = 0; c < pairs_.size(); ++c) {
        const Eigen::Index i = system.first(c);
        pairs_[c] = central_pair<Dim>(x.template segment<Dim>(i), system.cone(c).mu, eps_);
        r_.template segment<Dim>(i) = pairs_[c].r;
        error_.template segment<Dim>(i) = -pairs_[c].u;
    }
    system.multiply(r_, u_);
    u_ += system.free_velocity();
    error_ += u_ + alpha_ * (r_ - centre_);
    return error_.norm();
}

template <int Dim, ConeLaw<Dim> Law>
double ProximalNewton<Dim, Law>::evaluate_sharp(const Vec& r) {
    const auto& system = this->system_;
    r_ = r;
    system.multiply(r_, u_);
    u_ += system.free_velocity();
    error_.resize(r.size());
    for (std::size_t c = 0; c < system.contact_count(); ++c) {
        const Eigen::Index i = system.first(c);
        const Vector<Dim> x = r_.template segment<Dim>(i) - rho() * inner_velocity(i);
        const double pressure = std::max(x[0], 0.0), radius = system.cone(c).mu * pressure;
        const double length = x.template tail<Dim - 1>().norm();
        error_[i] = r_[i] - pressure;
        error_.template segment<Dim - 1>(i + 1) =
            r_.template segment<Dim - 1>(i + 1) -
            (length > radius ? radius / length : 1.0) * x.template tail<Dim - 1>();
    }
    return error_.norm();
}

/// Newton's step_ from the unknowns evaluated last; not finite if there is none.
template <int Dim, ConeLaw<Dim> Law>
void ProximalNewton<Dim, Law>::find_direction() {
    auto& system = this->system_;
    // The unknown is x = r - u: dx = (1 + D) dr, as in NewtonPolish.
    if (smooth_) {
        d_.resize(pairs_.size());
        for (std::size_t c = 0; c < pairs_.size(); ++c) {
            d_[c] = pairs_[c].d;
            d_[c].diagonal().array() += alpha_;
        }
        right_ = -error_;
    } else {
        differentiate_sharp();
    }
    if (!system.factorize(d_)) {
        step_.setConstant(error_.size(), std::numeric_limits<double>::quiet_NaN());
        return;
    }
    system.solve(right_, dr_);
    step_ = dr_;
    if (!smooth_) return;
    for (std::size_t c = 0; c < pairs_.size(); ++c)
        step_.template segment<Dim>(system.first(c)) +=
            pairs_[c].d * dr_.template segment<Dim>(system.first(c));
}

/// Fills D = alpha + B^-1 A and the right-hand side -B^-1 error.
template <int Dim, ConeLaw<Dim> Law>
void ProximalNewton<Dim, Law>::differentiate_sharp() {
    constexpr double soft = 1e-9;
    const auto& system = this->system_;
    d_.resize(system.contact_count());
    right_.resize(error_.size());
    for (std::size_t c = 0; c < d_.size(); ++c) {
        const Eigen::Index i = system.first(c);
        const double mu = system.cone(c).mu;
        // Open: A = 1, B = 0 (made soft). Stuck: A = 0, B = rho. Sliding: the projection on the
        // disc turns with x_t and its radius grows with x_n.
        const Vector<Dim> x = r_.template segment<Dim>(i) - rho() * inner_velocity(i);
        const Tangent x_t = x.template tail<Dim - 1>();
        const double length = x_t.norm(), radius = mu * std::max(x[0], 0.0);
        Matrix<Dim> a = Matrix<Dim>::Identity(), b = soft * Matrix<Dim>::Identity();
        if (x[0] > 0.0) {
            a(0, 0) = 0.0;
            b(0, 0) = rho();
            TangentMatrix a_t = TangentMatrix::Identity(), b_t = soft * TangentMatrix::Identity();
            if (length < radius) {
                a_t.setZero();
                b_t = rho() * TangentMatrix::Identity();
            } else if (length > 0.0) {
                const Tangent e = x_t / length;
                const TangentMatrix turning =
                    radius / length * (TangentMatrix::Identity() - e * e.transpose());
                a_t -= turning;
                b_t += rho() * turning;
                a.template bottomLeftCorner<Dim - 1, 1>() = -mu * e;
                b.template bottomLeftCorner<Dim - 1, 1>() = rho() * mu * e;
            }
            a.template bottomRightCorner<Dim - 1, Dim - 1>() = a_t;
            b.template bottomRightCorner<Dim - 1, Dim - 1>() = b_t;
        }
        const Matrix<Dim> inverse = b.inverse();
        d_[c] = inverse * a;
        d_[c].diagonal().array() += alpha_;
        right_.template segment<Dim>(i) = -(inverse * error_.template segment<Dim>(i));
    }
}

/// Newton steps from centre_ until the inner error is small beside the outer step.
template <int Dim, ConeLaw<Dim> Law>
typename ProximalNewton<Dim, Law>::Inner ProximalNewton<Dim, Law>::solve_inner(Vec& best,
                                                                               int& iteration) {
    constexpr int most = 20;
    constexpr double share = 0.3;  // of the outer step's term
    constexpr double shortest = 0.007;
    auto& system = this->system_;
    x_ = centre_;
    if (smooth_) {
        system.multiply(centre_, u_);
        x_ -= u_ + system.free_velocity();
    }
    double error = evaluate(x_);
    std::array<double, 4> recent;
    recent.fill(error);
    for (int k = 0; k < most && iteration < params.max_iterations; ++k) {
        ++iteration;
        easy_ = k + 1;
        find_direction();
        if (!step_.allFinite()) return Inner::stopped;
        from_ = x_;
        // Not monotone: statuses flip on the way, and the error with them.
        const double allowed = *std::max_element(recent.begin(), recent.end());
        double step = 1.0;
        x_ += step_;
        while (!((error = evaluate(x_)) <= (1.0 - 0.01 * step) * allowed)) {
            step *= 0.5;
            if (step < shortest) {
                // So that r_ and u_ are those of the last step taken.
                evaluate(from_);
                return Inner::stopped;
            }
            x_ = from_ + step * step_;
        }
        recent[static_cast<std::size_t>(k) % recent.size()] = error;
        if (this->offer(iteration, r_, u_, best)) return Inner::over;
        const double scale = std::max(r_.norm(), system.free_velocity().norm());
        if (error <= std::max(share * alpha_ * (r_ - centre_).norm(), 1e-15 * scale))
            return Inner::solved;
    }
    return Inner::stopped;
}

template <int Dim, ConeLaw<Dim> Law>
void ProximalNewton<Dim, Law>::iterate(Vec& best) {
    require_positive("proximal", params.proximal);
    constexpr double least = 1e-10, most = 1e4;
    constexpr double rise = 5.0, fall = 0.1;
    constexpr int sharp_stops = 2, smooth_stops = 6;
    constexpr double large = 1e3;  // impulses, over the velocities they stop
    alpha_ = params.proximal;
    smooth_ = false;
    centre_ = begin_ = best;
    const double first_residual = this->best_residual();
    double residual = first_residual;
    int iteration = 0, stops = 0;
    bool returned = false;  // from the smooth pairs
    while (iteration < params.max_iterations && (smooth_ || alpha_ <= most)) {
        set_smoothness(residual);
        const Inner inner = solve_inner(best, iteration);
        this->report_.iterations = iteration;  // also where the last step was not offered
        // Impulses that run away: the proximal point of a problem without solution moves on along a
        // proof of it by a constant step.
        if (r_.norm() > large * this->system_.free_velocity().norm() && proves_overlap()) {
            this->report_.status = SolveStatus::no_solution;
            return;
        }
        if (inner == Inner::over) return;
        if (inner == Inner::stopped) ++stops;
        // Where statuses are undecided the sharp equations cycle; smooth ones go between them.
        const bool tired = smooth_ ? stops == smooth_stops || alpha_ > most : stops == sharp_stops;
        if (tired && !returned) {
            returned = smooth_;
            smooth_ = !smooth_;
            stops = 0;
            alpha_ = params.proximal;
            centre_ = smooth_ ? begin_ : best;
            residual = smooth_ ? first_residual : this->best_residual();
            continue;
        }
        const double reached = this->system_.residual(r_, u_);
        if (inner == Inner::solved && reached < 10.0 * residual) {
            constexpr int easily = 4;
            // An inner problem of few steps was too easy: nearer to the given one next time.
            if (easy_ <= 2 * easily) alpha_ *= easy_ <= easily ? fall : std::sqrt(fall);
            alpha_ = std::max(alpha_, least);
        } else {
            alpha_ *= rise;
            if (!(reached < 0.95 * residual)) continue;
        }
        centre_ = r_;
        residual = reached;
    }
}

/// sqrt(eps) of the smooth pairs, from the error at the centre.
template <int Dim, ConeLaw<Dim> Law>
void ProximalNewton<Dim, Law>::set_smoothness(double residual) {
    const auto& system = this->system_;
    const double error = residual * std::max(centre_.norm(), system.free_velocity().norm());
    eps_ = error * error / static_cast<double>(system.contact_count()) + 1e-300;
}

/// Whether the last outer step's normal impulses prove that no solution exists.
template <int Dim, ConeLaw<Dim> Law>
bool ProximalNewton<Dim, Law>::proves_overlap() {
    const auto& system = this->system_;
    right_.setZero(r_.size());
    for (std::size_t c = 0; c < system.contact_count(); ++c) {
        const Eigen::Index i = system.first(c);
        right_[i] = std::max(r_[i] - centre_[i], 0.0);
    }
    return certificate_.holds(right_, system);
}

}  // namespace talus

TALUS_IN_PLANE(
    class talus::ConeEngine<2, talus::Coulomb<2>, talus::ProximalNewton<2, talus::Coulomb<2>>>)
TALUS_IN_SPACE(
    class talus::ConeEngine<3, talus::Coulomb<3>, talus::ProximalNewton<3, talus::Coulomb<3>>>)
TALUS_IN_PLANE(class talus::ProximalNewton<2, talus::Coulomb<2>>)
TALUS_IN_SPACE(class talus::ProximalNewton<3, talus::Coulomb<3>>)
