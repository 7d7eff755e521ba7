// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <limits>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "faults.hpp"
#include "world.hpp"

namespace validation {

/// How a bound is justified. R: rounding, 1e-12 of the scale. S: 100 times the solver's tolerance.
/// D1, D2: discretisation of first and second order. X: statistical, four standard errors. T: the
/// tolerance that the catalogue states. E: a statement that holds exactly or not at all.
enum class Class { R, S, D1, D2, X, T, E };
std::string name_of(Class c);

/// Something measured against its reference: passed when |error| <= bound.
struct Check {
    std::string label;
    Class kind = Class::R;
    double measured = std::numeric_limits<double>::quiet_NaN();
    double expected = std::numeric_limits<double>::quiet_NaN();
    double error = 0.0;
    double bound = 0.0;
    double h = 0.0;  ///< step size, 0 where it plays no part [s]
    std::string unit = {};
    std::string note = {};

    bool passed() const { return std::abs(error) <= bound; }  // a NaN fails
    /// How much of the bound is used.
    double ratio() const {
        if (!passed()) return std::numeric_limits<double>::infinity();
        return bound > 0.0 ? std::abs(error) / bound : 0.0;
    }
};

/// Range that an observed order has to lie in.
struct Band {
    double low, high;
};
inline constexpr Band first_order{0.9, 1.1};
/// Where event times fall irregularly on the steps; wants six step sizes or more.
inline constexpr Band first_order_irregular{0.8, 1.2};
inline constexpr Band second_order{1.9, 2.1};

/// Errors over step sizes with the slope fitted to them.
struct OrderStudy {
    std::string label;
    std::vector<double> h, error;
    double slope = 0.0;
    double slope_error = 0.0;  ///< half width of the 95 % confidence interval
    double constant = 0.0;     ///< largest error / h^p, p the nearest whole order
    Band band{0.0, 0.0};

    bool passed() const { return band.low <= slope && slope <= band.high; }
};

/// Step sizes from `first` downwards, each half of the one before.
std::vector<double> halvings(double first, int count);

/// A curve to be drawn in the report.
struct Series {
    std::string name;
    std::vector<double> x, y;
    bool exact = false;
};
struct Curves {
    std::string label, x_label, y_label;
    std::vector<Series> series;
};

/// Thrown out of a case at its first failing check when a fault is to be caught.
struct Caught {
    std::string by;
};

/// Running maximum of the deviation of a quantity over the steps of a run.
class Worst {
  public:
    void see(double measured, double expected) { note(measured, expected, measured - expected); }
    template <class Vec>
    void see(const Vec& measured, const Vec& expected) {
        note(measured.norm(), expected.norm(), largest((measured - expected).eval()));
    }
    double measured() const { return measured_; }
    double expected() const { return expected_; }
    double error() const { return count_ > 0 ? error_ : std::numeric_limits<double>::quiet_NaN(); }

  private:
    void note(double measured, double expected, double error) {
        if (count_++ == 0 || !(std::abs(error) <= std::abs(error_))) {
            measured_ = measured;
            expected_ = expected;
            error_ = error;
        }
    }
    double measured_ = 0.0, expected_ = 0.0, error_ = 0.0;
    long count_ = 0;
};

struct TrialParams {
    Fault fault = Fault::none;
    bool full = false;             ///< the longer ranges of parameters
    bool stop_at_failure = false;  ///< throw Caught
    std::uint64_t seed = 1;
    std::string solver = {};  ///< in place of the one that each case chooses; empty: that one
    std::optional<talus::Scheme> scheme = {};  ///< in place of the one that each case chooses
};

/// What a case records while it runs, without regard to the dimension.
class TrialRecord {
  public:
    explicit TrialRecord(const TrialParams& params) : params_(params) {}

    bool full() const { return params_.full; }
    Fault fault() const { return params_.fault; }
    /// The solver of a case that chooses `own`.
    std::string solver_name(const std::string& own = usual_solver) const {
        return params_.solver.empty() ? own : params_.solver;
    }
    std::optional<talus::Scheme> scheme() const { return params_.scheme; }
    bool faulty(Fault fault) const { return params_.fault == fault; }
    /// A generator for the k-th realisation; the same for the same seed of the run.
    std::mt19937_64 rng(std::uint64_t k = 0) const;

    // --- checks ----------------------------------------------------------------------------------

    /// Class R: |measured - expected| <= 1e-12 scale, scale the size of the numbers that went in.
    void rounding(std::string label, double measured, double expected, double scale,
                  double h = 0.0);
    /// Class S: |measured - expected| <= 100 tolerance scale.
    void solver(std::string label, double measured, double expected, double scale, double tolerance,
                double h = 0.0);
    /// A bound of the catalogue, with the reason in a few words.
    void within(std::string label, double measured, double expected, double bound,
                std::string reason, double h = 0.0, Class kind = Class::T);
    /// A statement.
    void holds(std::string label, bool truth, std::string note = {}, double h = 0.0);
    /// Vectors: the error is the largest coordinate of the difference, the norms are shown.
    template <class Vec>
    void rounding(std::string label, const Vec& measured, const Vec& expected, double scale,
                  double h = 0.0) {
        add({std::move(label), Class::R, measured.norm(), expected.norm(),
             largest((measured - expected).eval()), rounding_bound * scale, h});
    }
    template <class Vec>
    void solver(std::string label, const Vec& measured, const Vec& expected, double scale,
                double tolerance, double h = 0.0) {
        add({std::move(label), Class::S, measured.norm(), expected.norm(),
             largest((measured - expected).eval()), 100.0 * tolerance * scale, h});
    }
    template <class Vec>
    requires requires(const Vec& v) { v.norm(); }
    void within(std::string label, const Vec& measured, const Vec& expected, double bound,
                std::string reason, double h = 0.0) {
        add({std::move(label),
             Class::T,
             measured.norm(),
             expected.norm(),
             largest((measured - expected).eval()),
             bound,
             h,
             {},
             std::move(reason)});
    }
    /// The worst of a run.
    void rounding(std::string label, const Worst& worst, double scale, double h = 0.0) {
        add({std::move(label), Class::R, worst.measured(), worst.expected(), worst.error(),
             rounding_bound * scale, h});
    }
    void solver(std::string label, const Worst& worst, double scale, double tolerance,
                double h = 0.0) {
        add({std::move(label), Class::S, worst.measured(), worst.expected(), worst.error(),
             100.0 * tolerance * scale, h});
    }
    void within(std::string label, const Worst& worst, double bound, std::string reason,
                double h = 0.0) {
        add({std::move(label),
             Class::T,
             worst.measured(),
             worst.expected(),
             worst.error(),
             bound,
             h,
             {},
             std::move(reason)});
    }
    /// Class X: the mean over realisations (five or more) lies within four standard errors.
    void statistic(std::string label, std::span<const double> samples, double expected);
    void add(Check check);

    // --- order studies ---------------------------------------------------------------------------

    /// Runs `error_at(h)` for every step size and fits log error against log h; the slope has to
    /// lie in the band. Wants four halvings at least. With `constant` > 0 every error has to be at
    /// most constant h^p too.
    void order(std::string label, std::span<const double> h,
               const std::function<double(double)>& error_at, Band band, double constant = 0.0);

    // --- for the reader --------------------------------------------------------------------------

    /// Keeps at most some hundred points of each series.
    void curves(Curves curves);
    void note(std::string text) { notes_.push_back(std::move(text)); }
    /// The situation, as an SVG; the first one counts. Worlds made by a trial draw themselves.
    void drawing(std::string svg);

    const std::vector<Check>& checks() const { return checks_; }
    const std::vector<OrderStudy>& orders() const { return orders_; }
    const std::vector<Curves>& all_curves() const { return curves_; }
    const std::vector<std::string>& notes() const { return notes_; }
    const std::string& drawing() const { return drawing_; }
    bool passed() const;
    /// Adds what is known only at the end: the worst residual of all steps.
    void close();

    static constexpr double rounding_bound = 1e-12;

    /// Takes in what the solver of one step says: all residuals have to stay below 100 times the
    /// tolerance, or 1e-12. Worlds and machines that a trial makes call it themselves.
    void solved(double residual, double tolerance);

  protected:
    bool draws() const { return drawing_.empty() && !params_.stop_at_failure; }

  private:
    TrialParams params_;
    std::vector<Check> checks_;
    std::vector<OrderStudy> orders_;
    std::vector<Curves> curves_;
    std::vector<std::string> notes_;
    std::string drawing_;
    double worst_residual_ratio_ = 0.0, worst_residual_ = 0.0, its_bound_ = 0.0;
    bool any_solve_ = false;
};

/// The trial of a case in one dimension.
template <int Dim>
class Trial : public TrialRecord {
  public:
    using TrialRecord::TrialRecord;

    /// A world of one law, or of a table of laws. The first one is drawn after its first step. All
    /// residuals of its steps have to stay below 100 times the solver's tolerance, or 1e-12.
    World<Dim> world(const WorldParams<Dim>& params) {
        return world(params, talus::MaterialTable<Law<Dim>>(1, params.contact));
    }
    World<Dim> world(const WorldParams<Dim>& params, talus::MaterialTable<Law<Dim>> laws);

    /// Solves a contact problem (a Problem or a DenseProblem) with the solver of the cases, from r,
    /// into r.
    template <class AnyProblem>
    talus::SolveReport solve(const AnyProblem& problem, std::vector<V<Dim>>& r,
                             const talus::GaussSeidelParams& params) {
        const auto report = validation::solve<Dim>(problem, r, params, fault(), solver_name());
        solved(report.residual, params.tolerance);
        return report;
    }
    V<Dim> solve_contact(const Law<Dim>& law, const talus::LocalProblem<Dim>& problem) const {
        return validation::solve_contact<Dim>(law, problem, fault());
    }
    /// A picture of a world as it is now.
    void draw(const World<Dim>& world);
};

}  // namespace validation
