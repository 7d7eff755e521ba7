// SPDX-License-Identifier: BSL-1.0
#include "trial.hpp"

#include <stdexcept>

#include "gsl.hpp"
#include "sketch.hpp"

namespace validation {

std::string name_of(Class c) {
    switch (c) {
        case Class::R:
            return "R";
        case Class::S:
            return "S";
        case Class::D1:
            return "D1";
        case Class::D2:
            return "D2";
        case Class::X:
            return "X";
        case Class::T:
            return "T";
        case Class::E:
            return "E";
    }
    return "?";
}

std::vector<double> halvings(double first, int count) {
    std::vector<double> h;
    for (int k = 0; k < count; ++k) h.push_back(std::ldexp(first, -k));
    return h;
}

std::mt19937_64 TrialRecord::rng(std::uint64_t k) const {
    std::seed_seq seeds{params_.seed, k};
    return std::mt19937_64(seeds);
}

void TrialRecord::rounding(std::string label, double measured, double expected, double scale,
                           double h) {
    add({std::move(label), Class::R, measured, expected, measured - expected,
         rounding_bound * scale, h});
}
void TrialRecord::solver(std::string label, double measured, double expected, double scale,
                         double tolerance, double h) {
    add({std::move(label), Class::S, measured, expected, measured - expected,
         100.0 * tolerance * scale, h});
}
void TrialRecord::within(std::string label, double measured, double expected, double bound,
                         std::string reason, double h, Class kind) {
    add({std::move(label),
         kind,
         measured,
         expected,
         measured - expected,
         bound,
         h,
         {},
         std::move(reason)});
}
void TrialRecord::holds(std::string label, bool truth, std::string note, double h) {
    Check check;
    check.label = std::move(label);
    check.kind = Class::E;
    check.error = truth ? 0.0 : 1.0;
    check.h = h;
    check.note = std::move(note);
    add(std::move(check));
}

void TrialRecord::statistic(std::string label, std::span<const double> samples, double expected) {
    if (samples.size() < 5) throw std::logic_error(label + ": fewer than five realisations");
    const auto n = static_cast<double>(samples.size());
    double mean = 0.0, squares = 0.0;
    for (const double x : samples) mean += x / n;
    for (const double x : samples) squares += (x - mean) * (x - mean);
    const double standard_error = std::sqrt(squares / (n - 1.0) / n);
    add({std::move(label),
         Class::X,
         mean,
         expected,
         mean - expected,
         4.0 * standard_error,
         0.0,
         {},
         std::to_string(samples.size()) + " realisations, 4 standard errors"});
}

void TrialRecord::add(Check check) {
    const bool passed = check.passed();
    checks_.push_back(std::move(check));
    if (!passed && params_.stop_at_failure) throw Caught{checks_.back().label};
}

void TrialRecord::order(std::string label, std::span<const double> h,
                        const std::function<double(double)>& error_at, Band band, double constant) {
    if (h.size() < 5) throw std::logic_error(label + ": an order study wants four halvings");
    OrderStudy study;
    study.label = label;
    study.band = band;
    const double p = std::round(0.5 * (band.low + band.high));
    std::vector<double> log_h, log_error;
    for (const double step : h) {
        const double error = std::abs(error_at(step));
        study.h.push_back(step);
        study.error.push_back(error);
        log_h.push_back(std::log(step));
        log_error.push_back(std::log(error));
        study.constant = std::max(study.constant, error / std::pow(step, p));
        if (constant > 0.0)
            add({label, p > 1.5 ? Class::D2 : Class::D1, std::numeric_limits<double>::quiet_NaN(),
                 std::numeric_limits<double>::quiet_NaN(), error, constant * std::pow(step, p),
                 step});
    }
    const gsl::Line line = gsl::fit_line(log_h, log_error);
    study.slope = line.slope;
    study.slope_error =
        line.slope_error * gsl::student_quantile(0.95, static_cast<double>(h.size()) - 2.0);
    orders_.push_back(study);
    if (!study.passed() && params_.stop_at_failure) throw Caught{"order of " + label};
}

void TrialRecord::curves(Curves curves) {
    constexpr std::size_t most = 240;
    for (Series& s : curves.series) {
        if (s.x.size() <= most) continue;
        Series thin{s.name, {}, {}, s.exact};
        for (std::size_t k = 0; k < most; ++k) {
            const std::size_t i = k * (s.x.size() - 1) / (most - 1);
            thin.x.push_back(s.x[i]);
            thin.y.push_back(s.y[i]);
        }
        s = std::move(thin);
    }
    curves_.push_back(std::move(curves));
}

void TrialRecord::drawing(std::string svg) {
    if (drawing_.empty()) drawing_ = std::move(svg);
}

bool TrialRecord::passed() const {
    const auto good = [](const auto& x) { return x.passed(); };
    return !(checks_.empty() && orders_.empty()) &&
           std::all_of(checks_.begin(), checks_.end(), good) &&
           std::all_of(orders_.begin(), orders_.end(), good);
}

void TrialRecord::solved(double residual, double tolerance) {
    // A residual of 1e-12 is near the rounding of its own evaluation.
    const double bound = std::max(100.0 * tolerance, 1e-12);
    const double ratio = residual / bound;
    any_solve_ = true;
    if (worst_residual_ratio_ <= ratio || std::isnan(ratio)) {
        worst_residual_ratio_ = ratio;
        worst_residual_ = residual;
        its_bound_ = bound;
    }
}

void TrialRecord::close() {
    if (!any_solve_) return;
    add({"solver residual, worst of all steps", Class::S, worst_residual_, 0.0, worst_residual_,
         its_bound_});
}

template <int Dim>
World<Dim> Trial<Dim>::world(const WorldParams<Dim>& params, talus::MaterialTable<Law<Dim>> laws) {
    typename World<Dim>::Listener listener;
    if (!params.prepares)
        listener.solved = [this, tolerance = params.solver.tolerance](double residual) {
            solved(residual, tolerance);
        };
    if (draws())
        listener.after_first_step = [this](const World<Dim>& w) {
            if (draws()) draw(w);
        };
    WorldParams<Dim> chosen = params;
    chosen.solver_name = solver_name(params.solver_name);
    chosen.step.scheme = this->scheme().value_or(params.step.scheme);
    return World<Dim>(chosen, std::move(laws), fault(), std::move(listener));
}

template <int Dim>
void Trial<Dim>::draw(const World<Dim>& world) {
    drawing(sketch<Dim>(world));
}

template class Trial<2>;
template class Trial<3>;

}  // namespace validation
