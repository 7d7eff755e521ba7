// SPDX-License-Identifier: BSL-1.0
#include "enumeration.hpp"

#include <Eigen/Dense>

#include <cmath>

namespace validation {
namespace {

Eigen::MatrixXd columns(const std::vector<Eigen::VectorXd>& list, Eigen::Index rows) {
    Eigen::MatrixXd m(rows, static_cast<Eigen::Index>(list.size()));
    for (std::size_t i = 0; i < list.size(); ++i) m.col(static_cast<Eigen::Index>(i)) = list[i];
    return m;
}

}  // namespace

PlanarProblem frictionless(const Eigen::MatrixXd& w_nn, const Eigen::VectorXd& b_n) {
    const Eigen::Index n = b_n.size();
    PlanarProblem p{Eigen::MatrixXd::Zero(2 * n, 2 * n), Eigen::VectorXd::Zero(2 * n),
                    std::vector<double>(static_cast<std::size_t>(n), 0.0)};
    for (Eigen::Index i = 0; i < n; ++i) {
        p.b[2 * i] = b_n[i];
        for (Eigen::Index j = 0; j < n; ++j) p.w(2 * i, 2 * j) = w_nn(i, j);
    }
    return p;
}

Eigen::VectorXd normal_part(const Eigen::VectorXd& x) {
    Eigen::VectorXd result(x.size() / 2);
    for (Eigen::Index i = 0; i < result.size(); ++i) result[i] = x[2 * i];
    return result;
}

Enumeration::Enumeration(const PlanarProblem& problem, double tolerance)
    : p_(problem), speed_(problem.b.cwiseAbs().maxCoeff()), tolerance_(tolerance) {
    const double w = p_.w.diagonal().cwiseAbs().maxCoeff();
    impulse_ = speed_ / w;
    if (speed_ == 0.0) speed_ = impulse_ = 1.0;
    try_all("");
}

std::vector<Eigen::VectorXd> Enumeration::velocities() const {
    std::vector<Eigen::VectorXd> distinct;
    for (const PlanarSolution& s : solutions_) {
        bool known = false;
        for (const auto& u : distinct)
            known = known || (u - s.u).cwiseAbs().maxCoeff() <= 100 * tolerance_ * speed_;
        if (!known) distinct.push_back(s.u);
    }
    return distinct;
}

void Enumeration::try_all(const std::string& status) {
    const std::size_t k = status.size();
    if (k == p_.contact_count()) return attempt(status);
    for (const char s : std::string(p_.mu[k] > 0.0 ? "os+-" : "oc")) try_all(status + s);
}

void Enumeration::attempt(const std::string& status) {
    const Eigen::Index n = static_cast<Eigen::Index>(status.size());
    std::vector<Vector> q, e, c_u, c_r;
    const auto unit = [&](Eigen::Index i, double sign = 1.0) {
        return Vector(sign * Vector::Unit(2 * n, i));
    };
    for (Eigen::Index i = 0; i < n; ++i) {
        const char s = status[static_cast<std::size_t>(i)];
        const double mu = p_.mu[static_cast<std::size_t>(i)];
        if (s == 'o') {
            c_u.push_back(unit(2 * i));
            continue;
        }
        c_r.push_back(unit(2 * i));
        e.push_back(unit(2 * i));
        if (s == 's') {
            q.push_back(unit(2 * i));
            q.push_back(unit(2 * i + 1));
            e.push_back(unit(2 * i + 1));
            for (const double sign : {-1.0, 1.0})
                c_r.push_back(mu * unit(2 * i) + unit(2 * i + 1, sign));
        } else {
            const double sign = s == '+' ? 1.0 : -1.0;
            q.push_back(unit(2 * i) + (s == 'c' ? 0.0 : -sign * mu) * unit(2 * i + 1));
            if (s != 'c') c_u.push_back(unit(2 * i + 1, sign));
        }
    }
    const Matrix qm = columns(q, 2 * n), em = columns(e, 2 * n).transpose();
    const Matrix cu = columns(c_u, 2 * n).transpose(), cr = columns(c_r, 2 * n).transpose();
    solve(status, qm, em, cu, cr);
}

void Enumeration::solve(const std::string& status, const Matrix& q, const Matrix& e,
                        const Matrix& cu, const Matrix& cr) {
    const Eigen::Index unknowns = q.cols();
    Vector x = Vector::Zero(unknowns);
    Matrix null = Matrix::Zero(unknowns, 0);
    if (unknowns > 0) {
        Eigen::JacobiSVD<Matrix> svd(e * p_.w * q, Eigen::ComputeFullU | Eigen::ComputeFullV);
        svd.setThreshold(1e-11);
        x = svd.solve(-e * p_.b);
        if ((e * (p_.w * q * x + p_.b)).cwiseAbs().maxCoeff() > tolerance_ * speed_) return;
        null = svd.matrixV().rightCols(unknowns - svd.rank());
    }
    // Inequalities a0 + a z >= 0 for the free part z of the impulses.
    const Eigen::Index count = cu.rows() + cr.rows();
    Vector a0(count);
    Matrix a(count, null.cols());
    a0 << cu * (p_.w * q * x + p_.b) / speed_, cr * q * x / impulse_;
    a << cu * p_.w * q * null / speed_, cr * q * null / impulse_;
    std::vector<Vector> corners;
    collect_corners(a0, a, {}, 0, corners);
    if (corners.empty()) return;
    Vector z = Vector::Zero(null.cols());
    for (const Vector& corner : corners) z += corner / static_cast<double>(corners.size());
    const Vector r = q * (x + null * z);
    const bool still = null.cols() == 0 || (p_.w * q * null).norm() <= 1e-9 * p_.w.norm();
    solutions_.push_back({status, p_.w * r + p_.b, r, null.cols() == 0, still});
}

void Enumeration::collect_corners(const Vector& a0, const Matrix& a,
                                  std::vector<Eigen::Index> active, Eigen::Index next,
                                  std::vector<Vector>& corners) const {
    const Eigen::Index k = a.cols();
    if (static_cast<Eigen::Index>(active.size()) < k) {
        for (Eigen::Index i = next; i < a.rows(); ++i) {
            active.push_back(i);
            collect_corners(a0, a, active, i + 1, corners);
            active.pop_back();
        }
        return;
    }
    Vector z = Vector::Zero(k);
    if (k > 0) {
        Matrix m(k, k);
        Vector m0(k);
        for (Eigen::Index i = 0; i < k; ++i) {
            m.row(i) = a.row(active[static_cast<std::size_t>(i)]);
            m0[i] = a0[active[static_cast<std::size_t>(i)]];
        }
        const Eigen::FullPivLU<Matrix> lu(m);
        if (!lu.isInvertible()) return;
        z = lu.solve(-m0);
    }
    const double size = 1.0 + (k > 0 ? z.cwiseAbs().maxCoeff() / impulse_ : 0.0);
    if (a0.size() == 0 || (a0 + a * z).minCoeff() >= -tolerance_ * size) corners.push_back(z);
}

void PlanarBody::touch(const Eigen::Vector2d& arm, const Eigen::Vector2d& normal, double mu) {
    const Eigen::Vector2d tangent(normal[1], -normal[0]);
    for (const auto& d : {normal, tangent})
        rows_.emplace_back(d[0], d[1], arm[0] * d[1] - arm[1] * d[0]);
    mu_.push_back(mu);
}

Eigen::MatrixXd PlanarBody::g() const {
    Eigen::MatrixXd result(static_cast<Eigen::Index>(rows_.size()), 3);
    for (std::size_t i = 0; i < rows_.size(); ++i)
        result.row(static_cast<Eigen::Index>(i)) = rows_[i].transpose();
    return result;
}

PlanarProblem PlanarBody::problem(const Eigen::Vector3d& begin, const Eigen::Vector3d& load,
                                  double e_n, double e_t) const {
    const Eigen::MatrixXd rows = g();
    const Eigen::VectorXd u = rows * begin;
    Eigen::VectorXd b = rows * (begin + load);
    for (Eigen::Index i = 0; i < b.size(); ++i) b[i] += (i % 2 == 0 ? e_n : e_t) * u[i];
    return {rows * inverse_.asDiagonal() * rows.transpose(), b, mu_};
}

Eigen::Vector3d PlanarBody::end(const Eigen::Vector3d& begin, const Eigen::Vector3d& load,
                                const Eigen::VectorXd& r) const {
    return begin + load + inverse_.asDiagonal() * (g().transpose() * r);
}

}  // namespace validation
