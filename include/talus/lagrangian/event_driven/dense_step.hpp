// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace talus {

/// A step of the Runge-Kutta method of order 5 [DormandPrince1980] with its error and its dense
/// output of order 4, by Boost.Odeint. Keeps its memory. What the derivative throws is let pass.
class DenseStep {
  public:
    using State = std::vector<double>;
    using Derivative = std::function<void(const State& x, State& dx, double t)>;

    DenseStep() = default;
    /// Of x' = derivative(x, t).
    explicit DenseStep(Derivative derivative) : derivative_(std::move(derivative)) {}

    /// Where the steps that are tried begin.
    void begin(double t, const State& x) {
        t_begin_ = t_end_ = t;
        x_begin_ = x_end_ = x;
        slope_begin_.resize(x.size());
        derivative_(x_begin_, slope_begin_, t);
    }
    /// Tries a step of this length [s]; returns its largest error over what is allowed of it,
    /// absolute + relative max(|x_begin|, |x_end|).
    double attempt(double length, double absolute, double relative) {
        t_end_ = t_begin_ + length;
        make_room();
        stepper_.do_step(std::ref(derivative_), x_begin_, slope_begin_, t_begin_, x_end_,
                         slope_end_, length, error_);
        double worst = 0.0;
        for (std::size_t i = 0; i < error_.size(); ++i) {
            const double allowed =
                absolute + relative * std::max(std::abs(x_begin_[i]), std::abs(x_end_[i]));
            worst = std::max(worst, std::abs(error_[i]) / allowed);
            if (!std::isfinite(error_[i]) || !std::isfinite(x_end_[i])) return refused;
        }
        return worst;
    }
    /// What the next length should be, in terms of one with this error.
    static double next_length(double length, double error) {
        constexpr double safety = 0.9, least = 0.2, most = 5.0, order = 5.0;
        if (error == 0.0) return most * length;
        return length * std::clamp(safety * std::pow(error, -1.0 / order), least, most);
    }
    /// The error of a step that leads to what is not a number.
    static constexpr double refused = 1e9;

    double t_begin() const { return t_begin_; }
    double t_end() const { return t_end_; }
    const State& x_begin() const { return x_begin_; }
    const State& x_end() const { return x_end_; }

    /// Dense output of the last step tried, at a time within it.
    void interpolate(double t, State& x) const {
        x.resize(x_begin_.size());
        if (t == t_begin_ || t_end_ == t_begin_)
            x = x_begin_;
        else if (t == t_end_)
            x = x_end_;
        else
            stepper_.calc_state(t, x, x_begin_, slope_begin_, t_begin_, x_end_, slope_end_, t_end_);
    }
    /// The state at a time within it by a step of its own, as exact as the ends.
    void step_to(double t, State& x) {
        x = x_begin_;
        if (t == t_begin_) return;
        make_room();
        other_.do_step(std::ref(derivative_), x_begin_, slope_begin_, t_begin_, x, other_slope_,
                       t - t_begin_);
    }

  private:
    using Stepper = boost::numeric::odeint::runge_kutta_dopri5<State>;

    void make_room() {
        for (State* x : {&x_end_, &slope_end_, &error_, &other_slope_}) x->resize(x_begin_.size());
    }

    Derivative derivative_;
    Stepper stepper_, other_;  // the other one leaves the dense output as it is
    double t_begin_ = 0.0, t_end_ = 0.0;
    State x_begin_, x_end_, slope_begin_, slope_end_, error_, other_slope_;
};

}  // namespace talus
