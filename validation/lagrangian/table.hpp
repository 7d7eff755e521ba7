// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "harness/machine.hpp"

namespace validation {

/// A ball of 1 kg above a table at a sin(w t), by heights alone.
struct BallOnTable {
    static constexpr int dof = 1;
    double a, w, e;

    /// By the largest acceleration of the table over g.
    static BallOnTable of(double gamma, double frequency, double e) {
        const double w = 2 * pi * frequency;
        return {gamma * g / (w * w), w, e};
    }
    void mass(double, const auto&, auto& m) const { m << 1.0; }
    void force(double, const auto&, const auto&, auto& f) const { f << -g; }
    void gaps(const auto& t, const auto& q, auto& contacts) const {
        contacts.add(q[0] - a * sin(w * t), law<2>(0.0, e), "table");
    }
    double height(double t) const { return a * std::sin(w * t); }
    double speed(double t) const { return a * w * std::cos(w * t); }
};

}  // namespace validation
