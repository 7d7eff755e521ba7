// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <string>
#include <vector>

/// All solutions of a small planar contact problem by brute force: every combination of statuses is
/// tried, by dense linear algebra alone. The oracle of cases with several contacts.
namespace validation {

/// u = W r + b in local axes, (normal, tangent) contact by contact; Coulomb's law with mu between u
/// and r. For restitution put the shifts into b, so that u is e u_begin + u_end.
struct PlanarProblem {
    Eigen::MatrixXd w;       ///< 2n x 2n [1/kg]
    Eigen::VectorXd b;       ///< 2n [m/s]
    std::vector<double> mu;  ///< n; without friction the tangential rows of W play no part

    std::size_t contact_count() const { return mu.size(); }
};

/// A problem without friction from its normal part alone.
PlanarProblem frictionless(const Eigen::MatrixXd& w_nn, const Eigen::VectorXd& b_n);
/// The normal parts of impulses or velocities.
Eigen::VectorXd normal_part(const Eigen::VectorXd& x);

/// A combination of statuses that the law admits.
struct PlanarSolution {
    /// A letter for each contact: o open, s stuck, + and - slipping that way, c closed (without
    /// friction).
    std::string status;
    Eigen::VectorXd u;  ///< [m/s]
    /// [N s]; where they are not unique, the mean of the extreme ones of this combination.
    Eigen::VectorXd r;
    bool unique_impulses = true;  ///< among those of this combination of statuses
    bool unique_velocities = true;
};

/// Tries all combinations of statuses. The inequalities are taken with equality, so that a solution
/// on the border of several statuses is found once for each of them.
class Enumeration {
  public:
    /// `tolerance` is relative to the largest of b, and of W^-1 b for impulses.
    explicit Enumeration(const PlanarProblem& problem, double tolerance = 1e-10);
    const std::vector<PlanarSolution>& solutions() const { return solutions_; }

    /// The velocities among them that differ by more than rounding.
    std::vector<Eigen::VectorXd> velocities() const;

  private:
    using Matrix = Eigen::MatrixXd;
    using Vector = Eigen::VectorXd;

    void try_all(const std::string& status);
    /// r = Q x with one unknown (two if stuck) for each contact that is not open; as many
    /// equations E u = 0; the inequalities C_u u + C_r r >= 0.
    void attempt(const std::string& status);
    void solve(const std::string& status, const Matrix& q, const Matrix& e, const Matrix& cu,
               const Matrix& cr);
    /// Corners of the polyhedron a0 + a z >= 0. Friction cones being pointed, it has one unless it
    /// is empty.
    void collect_corners(const Vector& a0, const Matrix& a, std::vector<Eigen::Index> active,
                         Eigen::Index next, std::vector<Vector>& corners) const;

    PlanarProblem p_;
    double speed_, impulse_ = 1.0, tolerance_;
    std::vector<PlanarSolution> solutions_;
};

/// Contacts of one planar rigid body with obstacles: W = G A^-1 G^T, G by the rows (direction, arm
/// x direction), and A = diag(m, m, I).
class PlanarBody {
  public:
    PlanarBody(double mass, double inertia) : inverse_{1.0 / mass, 1.0 / mass, 1.0 / inertia} {}

    /// A contact with the normal towards the body; its tangent is the normal turned clockwise.
    void touch(const Eigen::Vector2d& arm, const Eigen::Vector2d& normal, double mu);
    Eigen::MatrixXd g() const;
    /// The problem of a step from u_begin = (v, spin), `load` the change of velocity by forces,
    /// restitution e_n and e_t.
    PlanarProblem problem(const Eigen::Vector3d& begin, const Eigen::Vector3d& load = {0, 0, 0},
                          double e_n = 0.0, double e_t = 0.0) const;
    /// (v, spin) at the end.
    Eigen::Vector3d end(const Eigen::Vector3d& begin, const Eigen::Vector3d& load,
                        const Eigen::VectorXd& r) const;

  private:
    Eigen::Vector3d inverse_;
    std::vector<Eigen::Vector3d> rows_;
    std::vector<double> mu_;
};

}  // namespace validation
