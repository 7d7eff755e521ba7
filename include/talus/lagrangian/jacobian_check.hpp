// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/lagrangian/concepts.hpp>
#include <talus/lagrangian/evaluation.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <exception>
#include <limits>
#include <new>
#include <string>
#include <vector>

namespace talus {

/// Compares the G and W that a system gives with what its gaps say, and throws input_error naming
/// contact, row, entry, both values and time where they differ. What they are compared with:
///
///   systems that also give `gaps`: the derivatives of these, all rows, to 1e-9;
///   others: differences of the gap by q and t, the normal row alone (a tangential row is the
///   derivative of nothing that is known), to 1e-6, to what two widths differ by and to what is
///   lost in the digits of the gap.
///
/// Differences are over 1e-5 of max(scale, |q|) to both sides, and over 1e-5 s or 1e-5 t ahead, as
/// a motion may begin at t. Where a gap bends too much within that, as in a machine of micrometres,
/// they are over a hundredth of it, and so on three times; they are to one side where a gap is not
/// defined on the other. A gap with a kink at q is refused. Systems that give gaps alone are right
/// by construction. Cost: 4 n + 5 calls of `contacts` or some more, or two.
template <LagrangianSystem System>
class JacobianCheck {
  public:
    using Types = LagrangianTypes<System>;
    using Coordinates = typename Types::Coordinates;

    /// `scale` is what coordinates change by when the system moves (LagrangianParams).
    void require(const System& system, double t, const Coordinates& q, double scale = 1.0) {
        if constexpr (GivesJacobians<System>) {
            evaluation_.contacts(system, t, q, given_);
            if constexpr (GivesGaps<System>)
                compare_with_derivatives(system, t, q);
            else
                compare_with_differences(system, t, q, scale);
        }
    }

  private:
    static constexpr int rows = Types::rows;
    static constexpr double tolerance_of_differences = 1e-6;
    using Contact = typename Types::Contacts::Contact;

    void compare_with_derivatives(const System& system, double t,
                                  const Coordinates& q) requires GivesGaps<System> {
        constexpr double tolerance = 1e-9;
        evaluation_.derivatives(system, t, q, near_);
        require_count("contacts by their gaps", near_.size(), "contacts", given_.size());
        for (std::size_t k = 0; k < given_.size(); ++k) {
            const double allowed = tolerance * scale(given_[k]);
            for (int i = 0; i < rows; ++i) {
                for (Eigen::Index j = 0; j < q.size(); ++j)
                    compare(t, k, entry(i, j), given_[k].rows(i, j), near_[k].rows(i, j), allowed);
                compare(t, k, of_time(i), given_[k].prescribed[i], near_[k].prescribed[i],
                        tolerance * std::max(1.0, std::abs(given_[k].prescribed[i])));
            }
        }
    }
    void compare_with_differences(const System& system, double t, const Coordinates& q,
                                  double scale) {
        for (Eigen::Index j = 0; j < q.size(); ++j)
            compare_column(
                {q[j], std::max(scale, std::abs(q[j])), Side::both},
                [&](double x) {
                    moved_ = q;
                    moved_[j] = x;
                    return Place{&system, t, &moved_};
                },
                t, [&](std::size_t k) { return given_[k].rows(0, j); }, entry(0, j));
        compare_column(
            {t, std::max(1.0, std::abs(t)), Side::ahead},
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
    enum class Side { both, ahead, behind };
    /// By what, from where, over what, and to which side first.
    struct Direction {
        double x, scale;
        Side side;
    };
    /// A derivative of a gap, as it is known so far.
    struct Estimate {
        double slope = 0.0, allowed = std::numeric_limits<double>::infinity();
        bool settled = false;
    };

    /// One column of all contacts: derivatives by x, of the gaps at place(x).
    template <class At, class Given>
    void compare_column(const Direction& by, const At& at, double t, const Given& given,
                        const std::string& what) {
        estimates_.assign(given_.size(), Estimate{});
        undefined_ = nullptr;
        bool defined = false;
        for (const Side side : {by.side, Side::ahead, Side::behind}) {
            if (defined) break;
            bool settled = false;
            for (const double width : {1e-5, 1e-7, 1e-9, 1e-11}) {
                if (settled) break;
                if (!differentiate(at, by.x, width * by.scale, side)) continue;
                defined = settled = true;
                for (std::size_t k = 0; k < given_.size(); ++k) {
                    settle(k, width * by.scale, given(k));
                    settled = settled && estimates_[k].settled;
                }
            }
        }
        if (!defined) std::rethrow_exception(undefined_);
        for (std::size_t k = 0; k < given_.size(); ++k)
            compare(t, k, what, given(k), estimates_[k].slope, estimates_[k].allowed);
    }
    /// Takes in the slopes over a width: settled if they are as good as can be asked for, or good
    /// enough and as given.
    void settle(std::size_t k, double delta, double given) {
        constexpr double fine = 4.0 * tolerance_of_differences, fair = 1e-4;
        constexpr double rounding = 32.0 * std::numeric_limits<double>::epsilon();
        Estimate& best = estimates_[k];
        if (best.settled) return;
        const double size = scale(given_[k]);
        const double allowed = tolerance_of_differences * size +
                               2.0 * std::abs(narrow_[k] - wide_[k]) +
                               rounding * std::abs(given_[k].gap) / delta;
        const bool agrees = std::abs(given - narrow_[k]) <= allowed;
        const bool settled = allowed <= fine * size || (allowed <= fair * size && agrees);
        if (settled || allowed < best.allowed) best = {narrow_[k], allowed, settled};
    }
    /// Slopes over delta and half of it; false where the system has no gaps there.
    template <class At>
    bool differentiate(const At& at, double x, double delta, Side side) {
        return slopes(at, x, delta, side, wide_) && slopes(at, x, 0.5 * delta, side, narrow_);
    }
    template <class At>
    bool slopes(const At& at, double x, double delta, Side side, std::vector<double>& out) {
        const double way = side == Side::behind ? -1.0 : 1.0;
        if (!evaluate(at(x + way * delta), near_) ||
            !evaluate(at(side == Side::both ? x - delta : x + way * 2.0 * delta), far_))
            return false;
        out.resize(given_.size());
        for (std::size_t k = 0; k < given_.size(); ++k)
            out[k] = side == Side::both
                         ? (near_[k].gap - far_[k].gap) / (2.0 * delta)
                         : way * (4.0 * near_[k].gap - far_[k].gap - 3.0 * given_[k].gap) /
                               (2.0 * delta);
        return true;
    }
    bool evaluate(const Place& place, typename Types::Contacts& out) {
        try {
            evaluation_.contacts(*place.system, place.t, *place.q, out);
        } catch (const std::bad_alloc&) {
            throw;
        } catch (...) {  // beyond what the system is defined for
            undefined_ = std::current_exception();
            return false;
        }
        require_count("contacts of the system", out.size(), "another call", given_.size());
        return true;
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
    typename Types::Contacts given_, near_, far_;
    Coordinates moved_;
    std::vector<double> wide_, narrow_;
    std::vector<Estimate> estimates_;
    std::exception_ptr undefined_;
};

/// The check of JacobianCheck at (t, q), once.
template <LagrangianSystem System>
void require_jacobians(const System& system, double t,
                       const typename LagrangianTypes<System>::Coordinates& q, double scale = 1.0) {
    JacobianCheck<System>().require(system, t, q, scale);
}

}  // namespace talus
