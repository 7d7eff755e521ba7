// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/symmetric_eigen.hpp>
#include <talus/measure/stress.hpp>
#include <talus/stepping/simulation.hpp>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <numbers>
#include <vector>

#include "../table.hpp"

namespace lab {

/// The contacts between grains after a step, parted into those whose normal force is below the mean
/// and the others [Radjai, Wolf, Jean, Moreau 1998]: what the weak ones bear of the deviatoric
/// stress, how many of those that slide are weak, and how their directions lie to those of the
/// strong.
template <int Dim>
class Networks {
  public:
    /// The bodies before `grains` are the grains; `mu` is theirs.
    Networks(const talus::Simulation<Dim>& sim, std::size_t grains, double mu) {
        const auto& data = sim.data();
        const auto& jacobian = data.problem.jacobian;
        const auto between = [&](std::size_t c) {
            return static_cast<std::size_t>(data.contacts.key[c].a) < grains &&
                   static_cast<std::size_t>(data.contacts.key[c].b) < grains &&
                   data.impulse[c][0] > 0.0;
        };
        double sum = 0.0;
        for (std::size_t c = 0; c < data.contact_count(); ++c)
            if (between(c)) sum += data.impulse[c][0], ++contacts_;
        const double mean = sum / contacts_;
        M stress[2] = {M::Zero(), M::Zero()}, fabric[2] = {M::Zero(), M::Zero()};
        double sliding[2] = {0.0, 0.0};
        for (std::size_t c = 0; c < data.contact_count(); ++c) {
            if (!between(c)) continue;
            const V& r = data.impulse[c];
            const int strong = r[0] < mean ? 0 : 1;
            const V force = V(jacobian.frame[c].transpose() * r);
            const V branch = jacobian.arm_a[c] - jacobian.arm_b[c];
            const V& n = data.contacts.normal[c];
            stress[strong] += branch * force.transpose();
            fabric[strong] += n * n.transpose();
            if (r.template tail<Dim - 1>().norm() > 0.999 * mu * r[0]) sliding[strong] += 1.0;
            if (strong == 0) weak_ += 1.0;
        }
        const M all = deviator(M(stress[0] + stress[1]));
        weak_stress_ = all.cwiseProduct(deviator(stress[0])).sum() / all.squaredNorm();
        weak_sliding_ = sliding[0] / (sliding[0] + sliding[1]);
        const V w = preferred(fabric[0]), s = preferred(fabric[1]);
        angle_ = std::acos(std::min(1.0, std::abs(w.dot(s)))) * 180.0 / std::numbers::pi;
    }
    void print() const {
        std::printf(
            "%.0f contacts, %.0f %% below the mean force: they bear %.3f of the deviatoric stress "
            "and are %.3f of\n    those that slide; their preferred direction is %.0f degrees from "
            "that of the strong (90)\n",
            contacts_, 100.0 * weak_ / contacts_, weak_stress_, weak_sliding_, angle_);
    }
    std::vector<Finding> findings() const {
        return {{"share of contacts that are weak", "-", weak_ / contacts_},
                {"share of weak contacts in the deviatoric stress", "-", weak_stress_},
                {"share of weak contacts in those that slide", "-", weak_sliding_},
                {"angle between weak and strong fabric", "degrees", angle_}};
    }

  private:
    using V = talus::Vector<Dim>;
    using M = talus::Matrix<Dim>;
    static M deviator(const M& tensor) {
        const M symmetric = M(0.5 * (tensor + M(tensor.transpose())));
        return M(symmetric - symmetric.trace() / Dim * M(M::Identity()));
    }
    static V preferred(const M& fabric) {
        const auto principal = talus::SymmetricEigen<Dim>(fabric);
        int most = 0;
        for (int k = 1; k < Dim; ++k)
            if (principal.values[k] > principal.values[most]) most = k;
        return V(principal.vectors.col(most));
    }
    double contacts_ = 0.0, weak_ = 0.0, weak_stress_ = 0.0, weak_sliding_ = 0.0, angle_ = 0.0;
};

}  // namespace lab
