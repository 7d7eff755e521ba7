// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/law/local_problem.hpp>

#include <Eigen/LU>

#include <cmath>
#include <numbers>
#include <vector>

/// All impulses that obey Coulomb's law with u = W r + b, W positive definite, by looking at every
/// status in turn and, when slipping in space, at every direction: plain, slow, and without a line
/// in common with talus::CoulombBlock.
template <int Dim>
class CoulombEnumeration {
  public:
    CoulombEnumeration(const talus::LocalProblem<Dim>& p, double mu) : p_(p), mu_(mu) {
        if (p.b[0] >= 0.0) solutions.push_back(Vec::Zero());
        const Vec stick = -p.W.inverse() * p.b;
        if (stick.template tail<Dim - 1>().norm() <= mu * stick[0]) solutions.push_back(stick);
        if constexpr (Dim == 2) {
            for (const double sign : {-1.0, 1.0}) add_slip(Vec(0.0, sign));
        } else {
            scan_directions();
        }
    }
    std::vector<talus::Vector<Dim>> solutions;

    double distance_to(const talus::Vector<Dim>& r) const {
        double best = INFINITY;
        for (const auto& s : solutions) best = std::min(best, (s - r).norm());
        return best;
    }

  private:
    using Vec = talus::Vector<Dim>;

    /// Impulse along the generator n + mu d that makes u_n = 0.
    Vec along(const Vec& d) const {
        Vec generator = mu_ * d;
        generator[0] = 1.0;
        return -p_.b[0] / p_.W.row(0).dot(generator) * generator;
    }
    void add_slip(const Vec& d) {
        const Vec r = along(d);
        if (r[0] > 0.0 && p_.velocity(r).dot(d) < 0.0) solutions.push_back(r);
    }
    static Vec direction(double angle) {
        Vec d = Vec::Zero();
        d[Dim - 2] = std::cos(angle);
        d[Dim - 1] = std::sin(angle);
        return d;
    }
    /// u_t x d, zero where the sliding velocity is along d.
    double misalignment(double angle) const {
        const Vec d = direction(angle);
        const Vec u = p_.velocity(along(d));
        return u[Dim - 2] * d[Dim - 1] - u[Dim - 1] * d[Dim - 2];
    }
    void scan_directions() {
        constexpr int parts = 3600;
        const double part = 2.0 * std::numbers::pi / parts;
        for (int k = 0; k < parts; ++k) {
            double low = k * part, high = (k + 1) * part;
            const bool sign = misalignment(low) > 0.0;
            if (sign == (misalignment(high) > 0.0)) continue;
            for (int i = 0; i < 60; ++i) {
                const double mid = 0.5 * (low + high);
                ((misalignment(mid) > 0.0) == sign ? low : high) = mid;
            }
            // A pole of r_n changes the sign too: there the misalignment is large.
            if (std::abs(misalignment(low)) < 1e-6 * p_.b.norm()) add_slip(direction(low));
        }
    }

    talus::LocalProblem<Dim> p_;
    double mu_;
};
