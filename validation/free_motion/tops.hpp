// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string>

#include "harness/case.hpp"
#include "harness/gsl.hpp"

/// Bodies that turn freely in space.
namespace validation {

/// A body of given principal moments that turns freely, its axes along those of the world at first.
inline World<3> free_top(Trial<3>& trial, const V<3>& moments, const V<3>& spin, double h,
                         talus::Gyroscopic option) {
    auto world = trial.world({.h = h,
                              .gravity = V<3>::Zero(),
                              .step = {.contact_tolerance = touching, .gyroscopic = option}});
    world.add(talus::Box<3>(V<3>(0.5, 0.4, 0.3)), talus::Inertia<3>{1.0, moments}, {},
              {V<3>::Zero(), spin});
    return world;
}

inline std::string name_of(talus::Gyroscopic option) {
    return option == talus::Gyroscopic::explicit_term ? "explicit term" : "momentum kept";
}

/// Euler's equations in closed form for moments I1 < I2 < I3 (Landau and Lifshitz, section 37),
/// with the energy and momentum of `start`.
class FreeTop {
  public:
    FreeTop(const V<3>& moments, const V<3>& start) {
        const double i1 = moments[0], i2 = moments[1], i3 = moments[2];
        const double energy2 = start.cwiseProduct(start).dot(moments);       // 2 T
        const double momentum2 = moments.cwiseProduct(start).squaredNorm();  // L^2
        const double low = momentum2 - energy2 * i1, high = energy2 * i3 - momentum2;
        about_third_ = momentum2 > energy2 * i2;
        a_[0] = std::sqrt(high / (i1 * (i3 - i1)));
        a_[2] = std::sqrt(low / (i3 * (i3 - i1)));
        m_ = (i2 - i1) * high / ((i3 - i2) * low);
        if (about_third_) {
            a_[1] = std::sqrt(high / (i2 * (i3 - i2)));
            rate_ = std::sqrt((i3 - i2) * low / (i1 * i2 * i3));
        } else {
            a_[1] = std::sqrt(low / (i2 * (i2 - i1)));
            rate_ = std::sqrt((i2 - i1) * high / (i1 * i2 * i3));
            m_ = 1 / m_;
        }
    }
    double m() const { return m_; }
    double rate() const { return rate_; }
    double quarter() const { return gsl::ellint_K(std::sqrt(m_)) / rate_; }  ///< of the period [s]
    /// Body axes, at a time after w2 passed zero upwards with w1, w3 > 0 [rad/s].
    V<3> spin(double t) const {
        const gsl::Jacobi j = gsl::jacobi(rate_ * t, m_);
        return {a_[0] * (about_third_ ? j.cn : j.dn), a_[1] * j.sn,
                a_[2] * (about_third_ ? j.dn : j.cn)};
    }

  private:
    bool about_third_ = false;
    double m_ = 0.0, rate_ = 0.0;
    V<3> a_;
};

/// Angular momentum in space [kg m^2/s].
inline V<3> angular_momentum(const World<3>& world, const V<3>& moments) {
    return world.bodies().rotation[0] * V<3>(moments.cwiseProduct(world.bodies().spin[0]));
}

}  // namespace validation
