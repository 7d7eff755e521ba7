// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/solver/cone_engine.hpp>
#include <talus/solver/slip_angle.hpp>

#include <Eigen/Core>
#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace talus {

/// What a contact does in a solution. Without friction a closed contact slides.
enum class ContactStatus { open, stuck, sliding };

template <int Dim>
struct EnumeratedSolution {
    std::vector<Vector<Dim>> impulses;  ///< [N s]
    std::vector<ContactStatus> status;
    bool isolated = true;  ///< the impulses are the only ones of these statuses nearby
};

struct EnumerationParams {
    /// Combinations of statuses allowed [-], not negative.
    int max_iterations = 100000;
    /// On the residual of problem/residual.hpp [-].
    double tolerance = 1e-8;
    /// Directions per sliding contact that Newton's method starts from, where several contacts
    /// slide in space [-], in [1, 64].
    int starts = 8;
};

/// All solutions of a tiny problem: every contact is open, stuck or sliding, and every combination
/// is tried by dense linear algebra. An oracle for other solvers, and the only one that finds
/// several solutions, or a proof that there is none, in the range of Painleve's paradox
/// [GenotBrogliato1999].
///
/// Exact: everything in the plane, where a contact slides one way or the other and each of up to
/// 4^n combinations is one linear system; in space each combination in which one contact at most
/// slides with friction: its direction is a root of a trigonometric polynomial of degree two, and
/// all of them are found. Not exact: several contacts sliding in space, where Newton's method in
/// the angles starts from a grid of directions and may miss solutions; combinations with a singular
/// system, where only the impulses of least norm are tried. `complete` says that neither was met.
///
/// As a solver it takes the solution nearest to the warm start, in scaled units, and reports
/// `no_solution` where there is none and the search was complete, `stalled` where it was not.
/// Cost: up to 4^n (plane) or (2 + starts)^n (space) systems of Dim n equations, and some
/// Newton steps for each of the latter. Throws input_error for more than 8 (4) contacts.
template <int Dim, ContactLaw<Dim> Law>
class Enumeration : public ConeEngine<Dim, Law, Enumeration<Dim, Law>> {
  public:
    explicit Enumeration(EnumerationParams params = {}) : params(params) {}
    EnumerationParams params;

    using Solution = EnumeratedSolution<Dim>;
    static constexpr std::size_t max_contacts = SlipAngle<Dim>::max_contacts;

    /// All solutions of a problem; none for laws without a cone.
    const std::vector<Solution>& enumerate(const ContactProblem<Dim, Law>& p) {
        return enumerate(DelassusSparse<Dim>(p.jacobian, p.inverse_mass), p.free_velocity, p.laws);
    }
    const std::vector<Solution>& enumerate(const DelassusSparse<Dim>& w,
                                           std::span<const Vector<Dim>> free_velocity,
                                           std::span<const Law> laws) {
        solutions_.clear();
        complete_ = false;
        auto cones = cones_of<Dim>(laws);
        if (!cones) return solutions_;
        require_in("number of contacts", static_cast<double>(laws.size()), 0,
                   static_cast<double>(max_contacts));
        ResidualMeasure<Dim> measure;
        measure.prepare(w);
        this->system_.assign(w, free_velocity, std::move(*cones), measure);
        find_all();
        return solutions_;
    }
    /// Of the last `enumerate`, or of the last `solve` unless its warm start was a solution.
    const std::vector<Solution>& solutions() const { return solutions_; }
    /// Whether these are all there are, beyond doubt but for rounding.
    bool complete() const { return complete_; }

  private:
    using Base = ConeEngine<Dim, Law, Enumeration<Dim, Law>>;
    friend Base;
    using Vec = Eigen::VectorXd;
    using Mat = Eigen::MatrixXd;
    using Slip = SlipAngle<Dim>;
    using Index = Eigen::Index;

    static constexpr double rounding = 1e-9;  ///< of what inequalities may be missed by, relatively

    void iterate(Vec& best);
    void find_all();
    void try_statuses(std::size_t contact);
    void try_directions(std::size_t slider);
    void assemble();
    bool solve_linear();
    bool follow_directions();
    void try_all_roots();
    std::pair<double, double> turning(double angle);
    void accept();
    bool obeys_inequalities() const;

    double mu(std::size_t c) const { return this->system_.cone(c).mu; }
    bool slides_with_friction(std::size_t c) const {
        return status_[c] == ContactStatus::sliding && mu(c) > 0.0;
    }
    /// Impulse of unit pressure of a sliding contact.
    Vector<Dim> ray(std::size_t c) const {
        Vector<Dim> x = Vector<Dim>::Unit(0);
        if (mu(c) > 0.0) x.template tail<Dim - 1>() = -mu(c) * Slip::direction(angle_[c]);
        return x;
    }

    std::vector<Solution> solutions_;
    std::vector<Vec> found_;  ///< their impulses, scaled
    bool complete_ = false;
    int combinations_ = 0;
    Mat w_;
    // The combination in hand.
    std::vector<ContactStatus> status_;
    std::vector<double> angle_;
    std::vector<std::size_t> sliders_;  ///< with friction
    Mat rows_, rays_, a_;               ///< equations rows_ u = 0 for r = rays_ x: a_ x = b
    Vec x_, r_, u_;
    bool singular_ = false;
};

template <int Dim, ContactLaw<Dim> Law>
void Enumeration<Dim, Law>::iterate(Vec& best) {
    require_in("number of contacts", static_cast<double>(this->system_.contact_count()), 0,
               static_cast<double>(max_contacts));
    find_all();
    const Vec* nearest = nullptr;
    for (const Vec& r : found_)
        if (nearest == nullptr || (r - best).norm() < (*nearest - best).norm()) nearest = &r;
    this->report_.iterations = combinations_;
    if (nearest != nullptr) {
        this->system_.multiply(*nearest, u_);
        u_ += this->system_.free_velocity();
        this->offer(combinations_, *nearest, u_, best);
    } else if (complete_) {
        this->report_.status = SolveStatus::no_solution;
    }
}

template <int Dim, ContactLaw<Dim> Law>
void Enumeration<Dim, Law>::find_all() {
    require_in("starts", params.starts, 1, 64);
    auto& system = this->system_;
    solutions_.clear();
    found_.clear();
    complete_ = true;
    combinations_ = 0;
    const Index size = system.free_velocity().size();
    w_.resize(size, size);
    for (Index j = 0; j < size; ++j) {
        system.multiply(Vec::Unit(size, j), u_);
        w_.col(j) = u_;
    }
    status_.assign(system.contact_count(), ContactStatus::open);
    angle_.assign(system.contact_count(), 0.0);
    try_statuses(0);
}

template <int Dim, ContactLaw<Dim> Law>
void Enumeration<Dim, Law>::try_statuses(std::size_t contact) {
    if (contact < status_.size()) {
        for (const auto s : {ContactStatus::open, ContactStatus::stuck, ContactStatus::sliding}) {
            if (s == ContactStatus::stuck && mu(contact) == 0.0) continue;
            status_[contact] = s;
            try_statuses(contact + 1);
        }
        return;
    }
    if (combinations_ == params.max_iterations) {
        complete_ = false;
        return;
    }
    ++combinations_;
    sliders_.clear();
    for (std::size_t c = 0; c < status_.size(); ++c)
        if (slides_with_friction(c)) sliders_.push_back(c);
    if (Slip::turns && sliders_.size() == 1) {
        try_all_roots();
        return;
    }
    if (Slip::turns && sliders_.size() > 1) complete_ = false;
    try_directions(0);
}

template <int Dim, ContactLaw<Dim> Law>
void Enumeration<Dim, Law>::try_directions(std::size_t slider) {
    if (slider < sliders_.size()) {
        const int starts = Slip::turns ? params.starts : 2;
        for (int k = 0; k < starts; ++k) {
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
template <int Dim, ContactLaw<Dim> Law>
void Enumeration<Dim, Law>::assemble() {
    const Index size = w_.rows();
    Index unknowns = 0;
    for (const auto s : status_)
        unknowns += s == ContactStatus::stuck ? Dim : s == ContactStatus::sliding ? 1 : 0;
    rows_.setZero(unknowns, size);
    rays_.setZero(size, unknowns);
    Index k = 0;
    for (std::size_t c = 0; c < status_.size(); ++c) {
        const Index i = this->system_.first(c);
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
template <int Dim, ContactLaw<Dim> Law>
bool Enumeration<Dim, Law>::solve_linear() {
    assemble();
    const Vec& q = this->system_.free_velocity();
    a_ = rows_ * w_ * rays_;
    const Vec b = -(rows_ * q);
    singular_ = false;
    if (a_.rows() == 0) {
        x_.resize(0);
    } else {
        Eigen::FullPivLU<Mat> lu(a_);
        constexpr double rank = 1e-11;
        lu.setThreshold(rank);
        singular_ = !lu.isInvertible();
        if (singular_) {
            Eigen::CompleteOrthogonalDecomposition<Mat> least(a_);
            least.setThreshold(rank);
            x_ = least.solve(b);
        } else {
            x_ = lu.solve(b);
            x_ += lu.solve(Vec(b - a_ * x_));
        }
    }
    r_ = rays_ * x_;
    u_ = w_ * r_ + q;
    return !singular_ || (a_ * x_ - b).norm() <= rounding * q.norm();
}

/// Turns the angles in hand until every contact slides along its direction.
template <int Dim, ContactLaw<Dim> Law>
bool Enumeration<Dim, Law>::follow_directions() {
    const auto count = static_cast<Index>(sliders_.size());
    constexpr int most = 40;
    for (int step = 0; step < most; ++step) {
        if (!solve_linear()) return false;
        const double speed = std::max(u_.norm(), this->system_.free_velocity().norm());
        Vec f(count);
        Mat change(w_.rows(), count);  // of W r, with the pressures kept
        for (Index s = 0; s < count; ++s) {
            const std::size_t c = sliders_[static_cast<std::size_t>(s)];
            const Index i = this->system_.first(c);
            const auto across = Slip::turned(angle_[c]);
            f[s] = u_.template segment<Dim - 1>(i + 1).dot(across);
            change.col(s) =
                w_.template middleCols<Dim - 1>(i + 1) * (-mu(c) * r_[i] * across).eval();
        }
        if (f.norm() <= 1e-14 * speed) return true;
        if (singular_) return false;
        // u_n of sliding and u of stuck contacts stay zero: the other impulses follow.
        const Mat du = change - w_ * rays_ * a_.fullPivLu().solve(rows_ * change);
        Mat jacobian(count, count);
        for (Index s = 0; s < count; ++s) {
            const std::size_t c = sliders_[static_cast<std::size_t>(s)];
            const Index i = this->system_.first(c);
            jacobian.row(s) =
                Slip::turned(angle_[c]).transpose() * du.template middleRows<Dim - 1>(i + 1);
            jacobian(s, s) -= u_.template segment<Dim - 1>(i + 1).dot(Slip::direction(angle_[c]));
        }
        Vec turn = -jacobian.fullPivLu().solve(f);
        if (!turn.allFinite()) return false;
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
template <int Dim, ContactLaw<Dim> Law>
std::pair<double, double> Enumeration<Dim, Law>::turning(double angle) {
    const std::size_t c = sliders_[0];
    angle_[c] = angle;
    solve_linear();
    const double d = singular_ ? 0.0 : a_.determinant();
    const Index i = this->system_.first(c);
    return {d, d * u_.template segment<Dim - 1>(i + 1).dot(Slip::turned(angle))};
}

/// The one sliding contact: all directions from the roots of its polynomial.
template <int Dim, ContactLaw<Dim> Law>
void Enumeration<Dim, Law>::try_all_roots() {
    constexpr std::size_t samples = 5;
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
        const double size = most * this->system_.free_velocity().norm();
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

template <int Dim, ContactLaw<Dim> Law>
bool Enumeration<Dim, Law>::obeys_inequalities() const {
    const double speed = rounding * std::max(this->system_.free_velocity().norm(), 1e-300);
    const double impulse = rounding * r_.norm();
    for (std::size_t c = 0; c < status_.size(); ++c) {
        const Index i = this->system_.first(c);
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
template <int Dim, ContactLaw<Dim> Law>
void Enumeration<Dim, Law>::accept() {
    if (!r_.allFinite() || !obeys_inequalities()) {
        // Others of the same statuses might do.
        if (singular_) complete_ = false;
        return;
    }
    constexpr double same = 1e-6;
    for (const Vec& other : found_)
        if ((other - r_).norm() <=
            same * std::max(other.norm(), this->system_.free_velocity().norm()))
            return;
    found_.push_back(r_);
    Solution solution;
    solution.impulses.resize(status_.size());
    this->system_.to_impulses(r_, solution.impulses);
    solution.status = status_;
    solution.isolated = !singular_;
    solutions_.push_back(std::move(solution));
}

}  // namespace talus
