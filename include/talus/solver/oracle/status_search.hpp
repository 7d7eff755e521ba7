// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/instantiate.hpp>
#include <talus/core/types.hpp>
#include <talus/linear/dense_solve.hpp>
#include <talus/solver/oracle/slip_angle.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

namespace talus {

/// What a contact does in a solution. Without friction a closed contact slides.
enum class ContactStatus { open, stuck, sliding };

/// The search of Enumeration: which impulses r in friction cones obey u = W r + q, by trying every
/// combination of statuses. Dense, for a few contacts.
template <int Dim>
requires SpaceDimension<Dim>
class StatusSearch {
  public:
    struct Found {
        Eigen::VectorXd r;
        std::vector<ContactStatus> status;
        bool isolated;  ///< r is the only one of these statuses nearby
    };

    /// W, q and the friction coefficients; limits as in EnumerationParams.
    void run(Eigen::MatrixXd w, Eigen::VectorXd q, std::vector<double> mu, int max_combinations,
             int starts);
    const std::vector<Found>& found() const { return found_; }
    /// Whether these are all there are, beyond doubt but for rounding.
    bool complete() const { return complete_; }
    int combinations() const { return combinations_; }  ///< that were tried

  private:
    using Vec = Eigen::VectorXd;
    using Mat = Eigen::MatrixXd;
    using Slip = SlipAngle<Dim>;
    using Index = Eigen::Index;

    static constexpr double rounding = 1e-9;  ///< of what inequalities may be missed by, relatively

    void try_statuses(std::size_t contact);
    void try_directions(std::size_t slider);
    void assemble();
    bool solve_linear();
    bool follow_directions();
    void try_all_roots();
    std::pair<double, double> turning(double angle);
    void accept();
    bool obeys_inequalities() const;

    static Index first(std::size_t c) { return static_cast<Index>(Dim * c); }
    double mu(std::size_t c) const { return mu_[c]; }
    bool slides_with_friction(std::size_t c) const {
        return status_[c] == ContactStatus::sliding && mu(c) > 0.0;
    }
    /// Impulse of unit pressure of a sliding contact.
    Vector<Dim> ray(std::size_t c) const {
        Vector<Dim> x = Vector<Dim>::Unit(0);
        if (mu(c) > 0.0) x.template tail<Dim - 1>() = -mu(c) * Slip::direction(angle_[c]);
        return x;
    }

    Mat w_;
    Vec q_;
    std::vector<double> mu_;
    int max_combinations_ = 0, starts_ = 0;
    std::vector<Found> found_;
    bool complete_ = false;
    int combinations_ = 0;
    // The combination in hand.
    std::vector<ContactStatus> status_;
    std::vector<double> angle_;
    std::vector<std::size_t> sliders_;  ///< with friction
    Mat rows_, rays_, a_;               ///< equations rows_ u = 0 for r = rays_ x: a_ x = b
    Vec x_, r_, u_;
    bool singular_ = false;
};

// Not inline: dense products take seconds to compile, which whoever includes this and does not
// search is spared.

template <int Dim>
requires SpaceDimension<Dim>
void StatusSearch<Dim>::run(Mat w, Vec q, std::vector<double> mu, int max_combinations,
                            int starts) {
    w_ = std::move(w);
    q_ = std::move(q);
    mu_ = std::move(mu);
    max_combinations_ = max_combinations;
    starts_ = starts;
    found_.clear();
    complete_ = true;
    combinations_ = 0;
    status_.assign(mu_.size(), ContactStatus::open);
    angle_.assign(mu_.size(), 0.0);
    try_statuses(0);
}

template <int Dim>
requires SpaceDimension<Dim>
void StatusSearch<Dim>::try_statuses(std::size_t contact) {
    if (contact < status_.size()) {
        for (const auto s : {ContactStatus::open, ContactStatus::stuck, ContactStatus::sliding}) {
            // Without friction stuck and sliding have the same normal equation: one is enough.
            if (s == ContactStatus::stuck && mu(contact) == 0.0) continue;
            status_[contact] = s;
            try_statuses(contact + 1);
        }
        return;
    }
    if (combinations_ == max_combinations_) {
        complete_ = false;
        return;
    }
    ++combinations_;
    sliders_.clear();
    for (std::size_t c = 0; c < status_.size(); ++c)
        if (slides_with_friction(c)) sliders_.push_back(c);
    // One slider: its directions are roots of a polynomial, and all are found.
    if constexpr (Slip::turns) {
        if (sliders_.size() == 1) return try_all_roots();
        if (sliders_.size() > 1) complete_ = false;
    }
    try_directions(0);
}

template <int Dim>
requires SpaceDimension<Dim>
void StatusSearch<Dim>::try_directions(std::size_t slider) {
    if (slider < sliders_.size()) {
        const int starts = Slip::turns ? starts_ : 2;
        for (int k = 0; k < starts; ++k) {
            // All directions, slider by slider: starts^n of them.
            // Newton's method moves the angles: they are set anew each time.
            const auto before = angle_;
            angle_[sliders_[slider]] = Slip::start(k, starts);
            try_directions(slider + 1);
            angle_ = before;
        }
        return;
    }
    if (follow_directions()) accept();
}

/// Rows of the equations and rays of the impulses for the statuses and angles in hand.
template <int Dim>
requires SpaceDimension<Dim>
void StatusSearch<Dim>::assemble() {
    // Stuck: u = 0 for any r. Sliding: u_n = 0 for a pressure along the ray. Open: nothing.
    const Index size = w_.rows();
    Index unknowns = 0;
    for (const auto s : status_)
        unknowns += s == ContactStatus::stuck ? Dim : s == ContactStatus::sliding ? 1 : 0;
    rows_.setZero(unknowns, size);
    rays_.setZero(size, unknowns);
    Index k = 0;
    for (std::size_t c = 0; c < status_.size(); ++c) {
        const Index i = first(c);
        if (status_[c] == ContactStatus::stuck) {
            rows_.template block<Dim, Dim>(k, i).setIdentity();
            rays_.template block<Dim, Dim>(i, k).setIdentity();
            k += Dim;
        } else if (status_[c] == ContactStatus::sliding) {
            rows_(k, i) = 1.0;
            rays_.template block<Dim, 1>(i, k) = ray(c);
            ++k;
        }
    }
}

/// Impulses of the statuses and angles in hand; false if the equations contradict each other.
template <int Dim>
requires SpaceDimension<Dim>
bool StatusSearch<Dim>::solve_linear() {
    assemble();
    a_ = rows_ * w_ * rays_;
    const Vec b = -(rows_ * q_);
    // Singular systems are those of hyperstatic statuses: of their solutions, one is tried.
    singular_ = !solve_dense(a_, b, x_);
    r_ = rays_ * x_;
    u_ = w_ * r_ + q_;
    return !singular_ || (a_ * x_ - b).norm() <= rounding * q_.norm();
}

/// Turns the angles in hand until every contact slides along its direction.
template <int Dim>
requires SpaceDimension<Dim>
bool StatusSearch<Dim>::follow_directions() {
    const auto count = static_cast<Index>(sliders_.size());
    constexpr int most = 40;
    for (int step = 0; step < most; ++step) {
        // Angles given, the pressures are linear; what is left is f_s = u_t . across = 0 for each
        // slider, on which Newton's method turns the angles.
        if (!solve_linear()) return false;
        const double speed = std::max(u_.norm(), q_.norm());
        Vec f(count);
        Mat change(w_.rows(), count);  // of W r, with the pressures kept
        for (Index s = 0; s < count; ++s) {
            const std::size_t c = sliders_[static_cast<std::size_t>(s)];
            const Index i = first(c);
            const auto across = Slip::turned(angle_[c]);
            f[s] = u_.template segment<Dim - 1>(i + 1).dot(across);
            change.col(s) =
                w_.template middleCols<Dim - 1>(i + 1) * (-mu(c) * r_[i] * across).eval();
        }
        if (f.norm() <= 1e-14 * speed) return true;
        if (singular_) return false;
        // u_n of sliding and u of stuck contacts stay zero: the other impulses follow.
        const Mat du = change - w_ * rays_ * solved_dense(a_, rows_ * change);
        Mat jacobian(count, count);
        for (Index s = 0; s < count; ++s) {
            const std::size_t c = sliders_[static_cast<std::size_t>(s)];
            const Index i = first(c);
            const auto across = Slip::turned(angle_[c]);
            for (Index t = 0; t < count; ++t)
                jacobian(s, t) = du.col(t).template segment<Dim - 1>(i + 1).dot(across);
            // The direction across turns as well.
            jacobian(s, s) -= u_.template segment<Dim - 1>(i + 1).dot(Slip::direction(angle_[c]));
        }
        Vec turn = -solved_dense(jacobian, f);
        if (!turn.allFinite()) return false;
        // Beyond that the trigonometric functions are not near to linear.
        constexpr double longest = 0.5;  // [rad]
        const double largest = turn.template lpNorm<Eigen::Infinity>();
        if (largest > longest) turn *= longest / largest;
        if (largest <= 1e-15) return f.norm() <= rounding * speed;
        for (Index s = 0; s < count; ++s) angle_[sliders_[static_cast<std::size_t>(s)]] += turn[s];
    }
    return false;
}

/// (D, D u_t . turned) at an angle of the one sliding contact, D the determinant of its equations:
/// trigonometric polynomials of degree one and two.
template <int Dim>
requires SpaceDimension<Dim> std::pair<double, double> StatusSearch<Dim>::turning(double angle) {
    const std::size_t c = sliders_[0];
    angle_[c] = angle;
    solve_linear();
    const double d = singular_ ? 0.0 : dense_determinant(a_);
    const Index i = first(c);
    return {d, d * u_.template segment<Dim - 1>(i + 1).dot(Slip::turned(angle))};
}

/// The one sliding contact: all directions from the roots of its polynomial.
template <int Dim>
requires SpaceDimension<Dim>
void StatusSearch<Dim>::try_all_roots() {
    constexpr std::size_t samples = 5;
    // Samples where D is small carry no digits: other angles are tried. By Cramer's rule u is a
    // polynomial in the direction over D.
    for (const double offset : {0.1, 0.4, 0.8}) {
        std::array<double, samples> f;
        double least = std::numeric_limits<double>::infinity(), most = 0.0;
        for (std::size_t k = 0; k < samples; ++k) {
            const double part = static_cast<double>(k) / samples;
            const auto [d, value] = turning(offset + 2.0 * std::numbers::pi * part);
            f[k] = value;
            least = std::min(least, std::abs(d));
            most = std::max(most, std::abs(d));
        }
        if (!(least > 1e-6 * most)) continue;
        const double size = most * q_.norm();
        const auto roots = trigonometric_roots(f, rounding * size);
        if (!roots) break;
        for (const double angle : *roots) {
            angle_[sliders_[0]] = offset + angle;
            if (follow_directions()) accept();
        }
        return;
    }
    complete_ = false;
    try_directions(0);
}

template <int Dim>
requires SpaceDimension<Dim>
bool StatusSearch<Dim>::obeys_inequalities() const {
    // Equations hold by construction: what is left of the law are its inequalities.
    const double speed = rounding * std::max(q_.norm(), 1e-300);
    const double impulse = rounding * r_.norm();
    for (std::size_t c = 0; c < status_.size(); ++c) {
        const Index i = first(c);
        const auto r_t = r_.template segment<Dim - 1>(i + 1);
        const auto u_t = u_.template segment<Dim - 1>(i + 1);
        if (status_[c] == ContactStatus::open) {
            if (u_[i] < -speed) return false;
            continue;
        }
        if (r_[i] < -impulse) return false;
        const bool stuck = status_[c] == ContactStatus::stuck;
        if (stuck && r_t.norm() > mu(c) * (r_[i] + impulse)) return false;
        if (slides_with_friction(c) && u_t.dot(Slip::direction(angle_[c])) < -speed) return false;
    }
    return true;
}

/// Takes the impulses in hand if they obey the law and are new.
template <int Dim>
requires SpaceDimension<Dim>
void StatusSearch<Dim>::accept() {
    if (!r_.allFinite() || !obeys_inequalities()) {
        // Others of the same statuses might do.
        if (singular_) complete_ = false;
        return;
    }
    // Neighbouring statuses share their border: a solution on it is found by both.
    constexpr double same = 1e-6;
    for (const Found& other : found_)
        if ((other.r - r_).norm() <= same * std::max(other.r.norm(), q_.norm())) return;
    found_.push_back({r_, status_, !singular_});
}

}  // namespace talus

TALUS_IN_PLANE(class talus::StatusSearch<2>)
TALUS_IN_SPACE(class talus::StatusSearch<3>)
