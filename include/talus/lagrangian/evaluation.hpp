// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/lagrangian/concepts.hpp>

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>

namespace talus {

/// Calls a system's functions and looks at what they give: of the right size, and finite. Keeps its
/// memory.
template <LagrangianSystem System>
class SystemEvaluation {
  public:
    using Types = LagrangianTypes<System>;
    using Coordinates = typename Types::Coordinates;

    /// Each throws input_error naming item, entry, value and time, and lets pass what the system
    /// throws.
    void mass(const System& system, double t, const Coordinates& q,
              typename Types::MassMatrix& a) const {
        const Eigen::Index n = q.size();
        a.setZero(n, n);
        system.mass(t, q, a);
        require_size("rows of the mass matrix", t, a.rows(), n);
        require_size("columns of the mass matrix", t, a.cols(), n);
        for (Eigen::Index j = 0; j < n; ++j)
            for (Eigen::Index i = 0; i < n; ++i)
                if (!std::isfinite(a(i, j)))
                    detail::reject(
                        detail::at_time(
                            "mass matrix[" + std::to_string(i) + "][" + std::to_string(j) + "]", t),
                        a(i, j), "finite");
    }
    void force(const System& system, double t, const Coordinates& q, const Coordinates& u,
               Coordinates& f) const {
        f.setZero(q.size());
        system.force(t, q, u, f);
        require_size("entries of the force", t, f.size(), q.size());
        for (Eigen::Index i = 0; i < f.size(); ++i)
            if (!std::isfinite(f[i]))
                detail::reject(detail::at_time("force[" + std::to_string(i) + "]", t), f[i],
                               "finite");
    }
    void contacts(const System& system, double t, const Coordinates& q,
                  typename Types::Contacts& out) {
        if constexpr (GivesJacobians<System>) {
            out.clear(q.size());
            system.contacts(t, q, out);
        } else {
            derivatives(system, t, q, out);
        }
        for (std::size_t k = 0; k < out.size(); ++k) require_valid(out[k], k, t, q.size());
    }
    /// Throws input_error naming time, contact, value and range unless the law of contact k, `c` at
    /// time t, is valid. Its name is put together only to be told: this is asked in every step.
    static void require_law(const typename Types::Contacts::Contact& c, std::size_t k, double t) {
        if constexpr (requires { c.law.require_valid(std::string_view{}); }) {
            try {
                c.law.require_valid(std::string_view{});
            } catch (const input_error&) {
                c.law.require_valid(detail::at_time("Lagrangian system", t) + ": law of " +
                                    detail::contact_text(k, c.name));
                throw;
            }
        }
    }
    /// The same of all contacts, open ones too.
    static void require_laws(const typename Types::Contacts& contacts, double t) {
        for (std::size_t k = 0; k < contacts.size(); ++k) require_law(contacts[k], k, t);
    }
    /// The contacts by derivatives of their gaps.
    void derivatives(const System& system, double t, const Coordinates& q,
                     typename Types::Contacts& out) requires GivesGaps<System> {
        derivatives_.evaluate(system, t, q, out);
    }

  private:
    static void require_size(std::string_view item, double t, Eigen::Index size,
                             Eigen::Index wanted) {
        if (size != wanted)
            detail::reject(detail::at_time("number of " + std::string(item), t),
                           static_cast<double>(size),
                           "that of coordinates, " + std::to_string(wanted));
    }
    template <class Contact>
    static void require_valid(const Contact& c, std::size_t k, double t, Eigen::Index n) {
        const auto named = [&](std::string_view item) {
            return detail::at_time(std::string(item) + " of " + detail::contact_text(k, c.name), t);
        };
        if (!std::isfinite(c.gap)) detail::reject(named("gap"), c.gap, "finite");
        if (c.rows.cols() != n)
            detail::reject(named("columns of the rows"), static_cast<double>(c.rows.cols()),
                           "that of coordinates, " + std::to_string(n));
        for (int i = 0; i < Types::rows; ++i) {
            if (!std::isfinite(c.prescribed[i]))
                detail::reject(named("prescribed[" + std::to_string(i) + "]"), c.prescribed[i],
                               "finite");
            for (Eigen::Index j = 0; j < n; ++j)
                if (!std::isfinite(c.rows(i, j)))
                    detail::reject(named(detail::row_text(i) + "[" + std::to_string(j) + "]"),
                                   c.rows(i, j), "finite");
        }
    }

    GapDerivatives<Types::rows, Types::dof, typename Types::Law> derivatives_;
};

}  // namespace talus
