// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/lagrangian/concepts.hpp>
#include <talus/lagrangian/evaluation.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace talus {

/// Compares the G and W that a system gives with what its gaps say, and throws input_error naming
/// contact, row, entry, both values and time where they differ. What they are compared with:
///
///   systems that also give `gaps`: the derivatives of these, all rows, to 1e-9;
///   others: central differences of the gap by q and t, the normal row alone (a tangential row is
///   the derivative of nothing that is known), to 1e-6, to what two widths differ by and to what is
///   lost in the digits of the gap.
///
/// Differences are over 1e-5 max(1, |q|): a gap with a kink within that is refused. Systems that
/// give gaps alone are right by construction. Cost: 4 n + 5 calls of `contacts`, or two.
template <LagrangianSystem System>
class JacobianCheck {
  public:
    using Types = LagrangianTypes<System>;
    using Coordinates = typename Types::Coordinates;

    void require(const System& system, double t, const Coordinates& q) {
        if constexpr (GivesJacobians<System>) {
            evaluation_.contacts(system, t, q, given_);
            if constexpr (GivesGaps<System>)
                compare_with_derivatives(system, t, q);
            else
                compare_with_differences(system, t, q);
        }
    }

  private:
    static constexpr int rows = Types::rows;
    static constexpr double width = 1e-5;
    using Contact = typename Types::Contacts::Contact;

    void compare_with_derivatives(const System& system, double t,
                                  const Coordinates& q) requires GivesGaps<System> {
        constexpr double tolerance = 1e-9;
        evaluation_.derivatives(system, t, q, left_);
        require_count("contacts by their gaps", left_.size(), "contacts", given_.size());
        for (std::size_t k = 0; k < given_.size(); ++k) {
            const double allowed = tolerance * scale(given_[k]);
            for (int i = 0; i < rows; ++i) {
                for (Eigen::Index j = 0; j < q.size(); ++j)
                    compare(t, k, entry(i, j), given_[k].rows(i, j), left_[k].rows(i, j), allowed);
                compare(t, k, of_time(i), given_[k].prescribed[i], left_[k].prescribed[i],
                        tolerance * std::max(1.0, std::abs(given_[k].prescribed[i])));
            }
        }
    }
    void compare_with_differences(const System& system, double t, const Coordinates& q) {
        wide_.resize(given_.size());
        for (Eigen::Index j = 0; j < q.size(); ++j)
            compare_column(
                q[j],
                [&](double x) {
                    moved_ = q;
                    moved_[j] = x;
                    return Place{&system, t, &moved_};
                },
                t, [&](std::size_t k) { return given_[k].rows(0, j); }, entry(0, j));
        compare_column(
            t,
            [&](double x) {
                return Place{&system, x, &q};
            },
            t, [&](std::size_t k) { return given_[k].prescribed[0]; }, of_time(0));
    }
    struct Place {
        const System* system;
        double t;
        const Coordinates* q;
    };
    /// One column of all contacts: derivatives by x, of the gaps at place(x).
    template <class At, class Given>
    void compare_column(double x, const At& at, double t, const Given& given,
                        const std::string& what) {
        constexpr double tolerance = 1e-6;
        constexpr double rounding = 16.0 * std::numeric_limits<double>::epsilon();
        const double delta = width * std::max(1.0, std::abs(x));
        difference(at, x, delta);
        for (std::size_t k = 0; k < given_.size(); ++k) wide_[k] = slope(k, delta);
        difference(at, x, 0.5 * delta);
        for (std::size_t k = 0; k < given_.size(); ++k) {
            const double narrow = slope(k, 0.5 * delta);
            compare(t, k, what, given(k), narrow,
                    tolerance * scale(given_[k]) + 2.0 * std::abs(narrow - wide_[k]) +
                        rounding * std::abs(given_[k].gap) / delta);
        }
    }
    template <class At>
    void difference(const At& at, double x, double delta) {
        const auto evaluate = [&](double value, typename Types::Contacts& out) {
            const Place place = at(value);
            evaluation_.contacts(*place.system, place.t, *place.q, out);
            require_count("contacts of the system", out.size(), "another call", given_.size());
        };
        evaluate(x - delta, left_);
        evaluate(x + delta, right_);
    }
    double slope(std::size_t k, double delta) const {
        return (right_[k].gap - left_[k].gap) / (2.0 * delta);
    }
    static double scale(const Contact& c) {
        double largest = 0.0;
        for (int i = 0; i < rows; ++i)
            for (Eigen::Index j = 0; j < c.rows.cols(); ++j)
                largest = std::max(largest, std::abs(c.rows(i, j)));
        return largest > 0.0 ? largest : 1.0;
    }
    static std::string entry(int row, Eigen::Index j) {
        return detail::row_text(row) + "[" + std::to_string(j) + "]";
    }
    static std::string of_time(int row) { return "prescribed[" + std::to_string(row) + "]"; }
    void compare(double t, std::size_t k, const std::string& what, double value, double expected,
                 double allowed) const {
        if (std::abs(value - expected) <= allowed) return;
        detail::reject(detail::at_time(what + " of " + detail::contact_text(k, given_[k].name), t),
                       value, "the derivative of its displacement, " + detail::text_of(expected));
    }

    SystemEvaluation<System> evaluation_;
    typename Types::Contacts given_, left_, right_;
    Coordinates moved_;
    std::vector<double> wide_;
};

/// The check of JacobianCheck at (t, q), once.
template <LagrangianSystem System>
void require_jacobians(const System& system, double t,
                       const typename LagrangianTypes<System>::Coordinates& q) {
    JacobianCheck<System>().require(system, t, q);
}

}  // namespace talus
