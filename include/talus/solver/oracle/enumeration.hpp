// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/instantiate.hpp>
#include <talus/law/coulomb.hpp>
#include <talus/solver/cones/cone_engine.hpp>
#include <talus/solver/oracle/slip_angle.hpp>
#include <talus/solver/oracle/status_search.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace talus {

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
template <int Dim, ConeLaw<Dim> Law>
class Enumeration : public ConeEngine<Dim, Law, Enumeration<Dim, Law>> {
  public:
    explicit Enumeration(EnumerationParams params = {}) : params(params) {}
    EnumerationParams params;

    using Solution = EnumeratedSolution<Dim>;
    static constexpr std::size_t max_contacts = SlipAngle<Dim>::max_contacts;

    /// All solutions of a problem. Throws input_error where a law has no cone, and for too many
    /// contacts.
    const std::vector<Solution>& enumerate(const ContactProblem<Dim, Law>& p) {
        return enumerate(DelassusSparse<Dim>(p.jacobian, p.inverse_mass), p.free_velocity, p.laws);
    }
    const std::vector<Solution>& enumerate(const DelassusSparse<Dim>& w,
                                           std::span<const Vector<Dim>> free_velocity,
                                           std::span<const Law> laws) {
        solutions_.clear();
        search_ = {};
        std::vector<FrictionCone<Dim>> cones = Base::require_cones(laws);
        require_in("number of contacts", static_cast<double>(laws.size()), 0,
                   static_cast<double>(max_contacts));
        ResidualMeasure<Dim> measure;
        measure.prepare(w);
        this->system_.assign(w, free_velocity, std::move(cones), measure);
        find_all();
        return solutions_;
    }
    /// Of the last `enumerate`, or of the last `solve` unless its warm start was a solution.
    const std::vector<Solution>& solutions() const { return solutions_; }
    /// Whether these are all there are, beyond doubt but for rounding.
    bool complete() const { return search_.complete(); }

  private:
    using Base = ConeEngine<Dim, Law, Enumeration<Dim, Law>>;
    friend Base;

    void iterate(Eigen::VectorXd& best);
    void find_all();

    StatusSearch<Dim> search_;
    std::vector<Solution> solutions_;
};

template <int Dim, ConeLaw<Dim> Law>
void Enumeration<Dim, Law>::iterate(Eigen::VectorXd& best) {
    require_in("number of contacts", static_cast<double>(this->system_.contact_count()), 0,
               static_cast<double>(max_contacts));
    find_all();
    const Eigen::VectorXd* nearest = nullptr;
    for (const auto& found : search_.found())
        if (nearest == nullptr || (found.r - best).norm() < (*nearest - best).norm())
            nearest = &found.r;
    const int combinations = search_.combinations();
    this->report_.iterations = combinations;
    if (nearest != nullptr) {
        Eigen::VectorXd u;
        this->system_.multiply(*nearest, u);
        u += this->system_.free_velocity();
        this->offer(combinations, *nearest, u, best);
    } else if (search_.complete()) {
        this->report_.status = SolveStatus::no_solution;
    }
}

template <int Dim, ConeLaw<Dim> Law>
void Enumeration<Dim, Law>::find_all() {
    require_in("starts", params.starts, 1, 64);
    auto& system = this->system_;
    const Eigen::Index size = system.free_velocity().size();
    Eigen::MatrixXd w(size, size);
    Eigen::VectorXd column;
    for (Eigen::Index j = 0; j < size; ++j) {
        system.multiply(Eigen::VectorXd::Unit(size, j), column);
        w.col(j) = column;
    }
    std::vector<double> mu;
    for (std::size_t c = 0; c < system.contact_count(); ++c) mu.push_back(system.cone(c).mu);
    search_.run(std::move(w), system.free_velocity(), std::move(mu), params.max_iterations,
                params.starts);
    solutions_.clear();
    for (const auto& found : search_.found()) {
        Solution solution{std::vector<Vector<Dim>>(found.status.size()), found.status,
                          found.isolated};
        system.to_impulses(found.r, solution.impulses);
        solutions_.push_back(std::move(solution));
    }
}

}  // namespace talus

TALUS_IN_PLANE(
    class talus::ConeEngine<2, talus::Coulomb<2>, talus::Enumeration<2, talus::Coulomb<2>>>)
TALUS_IN_SPACE(
    class talus::ConeEngine<3, talus::Coulomb<3>, talus::Enumeration<3, talus::Coulomb<3>>>)
TALUS_IN_PLANE(class talus::Enumeration<2, talus::Coulomb<2>>)
TALUS_IN_SPACE(class talus::Enumeration<3, talus::Coulomb<3>>)
