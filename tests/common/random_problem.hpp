// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/problem/contact_problem.hpp>
#include <talus/problem/delassus_product.hpp>
#include <talus/spatial/local_frame.hpp>

#include <cmath>
#include <utility>

#include "common/random_blocks.hpp"

/// Random contact problems without any shape behind them.
template <int Dim, class Law>
struct RandomProblem {
    using Problem = talus::ContactProblem<Dim, Law>;

    int bodies = 6;               ///< the last one is an obstacle
    int contacts = 8;             ///< between random pairs; above (bodies - 1) they are hyperstatic
    double mass_ratio = 3.0;      ///< between the heaviest and the lightest
    double arm = 0.3;             ///< length of the lever arms [m]
    bool scalar_inertia = false;  ///< as balls
    bool guided = false;          ///< some axes are locked
    bool driven = false;          ///< a stress drives some components of a cell

    Problem make(RandomBlocks& random, const Law& law) const {
        Problem p;
        p.inverse_mass.resize(static_cast<std::size_t>(bodies));
        for (std::size_t k = 0; k < p.inverse_mass.body_count(); ++k) {
            const bool obstacle = k + 1 == p.inverse_mass.body_count();
            p.inverse_mass.linear[k] = obstacle ? 0.0 : random.log_uniform(1.0 / mass_ratio, 1.0);
            p.inverse_mass.angular[k] = inverse_inertia(random) * p.inverse_mass.linear[k];
        }
        if (guided) {
            p.inverse_mass.free_axes.assign(p.inverse_mass.body_count(),
                                            talus::Vector<Dim>::Ones());
            for (auto& axes : p.inverse_mass.free_axes) axes[random.integer(0, Dim - 1)] = 0.0;
        }
        p.jacobian.resize(static_cast<std::size_t>(contacts));
        for (std::size_t i = 0; i < p.jacobian.contact_count(); ++i) {
            p.jacobian.a[i] = random.integer(0, bodies - 2);
            do p.jacobian.b[i] = random.integer(0, bodies - 1);
            while (p.jacobian.b[i] == p.jacobian.a[i]);
            p.jacobian.frame[i] = talus::local_frame<Dim>(random.unit<Dim>());
            p.jacobian.arm_a[i] = arm * random.unit<Dim>();
            p.jacobian.arm_b[i] = arm * random.unit<Dim>();
            p.free_velocity.push_back(random.normal<Dim>());
            p.laws.push_back(law);
        }
        if (driven) drive(p, random);
        return p;
    }

  private:
    /// Of any two components (i, j), (j, i) one has the other mass; some contacts have no lever.
    static void drive(Problem& p, RandomBlocks& random) {
        for (int i = 0; i < Dim; ++i)
            for (int j = 0; j < Dim; ++j)
                if (i != 1 || j != 0) p.inverse_mass.cell(i, j) = random.log_uniform(0.1, 10.0);
        for (std::size_t c = 0; c < p.jacobian.contact_count(); ++c)
            p.jacobian.cell_lever.push_back(c % 3 == 2 ? talus::Vector<Dim>::Zero()
                                                       : talus::Vector<Dim>(random.normal<Dim>()));
    }
    talus::AngularMatrix<Dim> inverse_inertia(RandomBlocks& random) const {
        constexpr int n = talus::rotation_dof<Dim>;
        if (scalar_inertia) return 2.5 * talus::AngularMatrix<Dim>::Identity();
        const talus::AngularMatrix<Dim> g = random.normal<n, n>();
        return g * g.transpose() + talus::AngularMatrix<Dim>::Identity();
    }
};

/// The same problem with other units: lengths, masses and times multiplied.
template <int Dim, class Law>
talus::ContactProblem<Dim, Law> in_other_units(talus::ContactProblem<Dim, Law> p, double length,
                                               double mass, double time) {
    for (auto& x : p.inverse_mass.linear) x /= mass;
    for (auto& x : p.inverse_mass.angular) x /= mass * length * length;
    for (auto& x : p.jacobian.arm_a) x *= length;
    for (auto& x : p.jacobian.arm_b) x *= length;
    for (auto& x : p.free_velocity) x *= length / time;
    return p;
}

/// The problem and a copy of it on other bodies, side by side.
template <int Dim, class Law>
talus::ContactProblem<Dim, Law> twice(const talus::ContactProblem<Dim, Law>& p) {
    auto q = p;
    const auto append = [](auto& to, const auto& from) { to.append(std::span(from)); };
    append(q.inverse_mass.linear, p.inverse_mass.linear);
    append(q.inverse_mass.angular, p.inverse_mass.angular);
    append(q.jacobian.a, p.jacobian.a);
    append(q.jacobian.b, p.jacobian.b);
    append(q.jacobian.frame, p.jacobian.frame);
    append(q.jacobian.arm_a, p.jacobian.arm_a);
    append(q.jacobian.arm_b, p.jacobian.arm_b);
    append(q.free_velocity, p.free_velocity);
    append(q.laws, p.laws);
    const auto bodies = static_cast<talus::BodyIndex>(p.inverse_mass.body_count());
    for (std::size_t i = p.contact_count(); i < q.contact_count(); ++i) {
        q.jacobian.a[i] += bodies;
        q.jacobian.b[i] += bodies;
    }
    return q;
}

/// A particle per contact stacked on an obstacle, the topmost last: contact i is under body i. The
/// masses are given from below; the obstacle is the last body.
template <int Dim, class Law>
talus::ContactProblem<Dim, Law> stack_of_particles(const std::vector<double>& masses,
                                                   const Law& law) {
    talus::ContactProblem<Dim, Law> p;
    const std::size_t n = masses.size();
    p.inverse_mass.resize(n + 1);
    p.jacobian.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        p.inverse_mass.linear[i] = 1.0 / masses[i];
        p.jacobian.a[i] = static_cast<talus::BodyIndex>(i);
        p.jacobian.b[i] = static_cast<talus::BodyIndex>(i == 0 ? n : i - 1);
        p.jacobian.frame[i] = talus::Matrix<Dim>::Identity();
        p.jacobian.arm_a[i].setZero();
        p.jacobian.arm_b[i].setZero();
        p.free_velocity.push_back(talus::Vector<Dim>::Zero());
        p.laws.push_back(law);
    }
    p.inverse_mass.linear[n] = 0.0;
    for (auto& x : p.inverse_mass.angular) x.setZero();
    return p;
}

/// Makes u_free the relative velocity of some motion of the bodies: then u = 0 is within reach and
/// a solution exists, however many contacts there are [AcaryEtAl2011].
template <int Dim, class Law>
void move_bodies_only(talus::ContactProblem<Dim, Law>& p, RandomBlocks& random) {
    std::vector<talus::Vector<Dim>> s(p.contact_count());
    for (auto& x : s) x = random.normal<Dim>();
    talus::DelassusProduct<Dim>(p.jacobian, p.inverse_mass).multiply(s, p.free_velocity);
}
