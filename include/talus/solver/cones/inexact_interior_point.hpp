// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/instantiate.hpp>
#include <talus/law/coulomb.hpp>
#include <talus/solver/cones/interior_point.hpp>
#include <talus/solver/cones/krylov_cone_solver.hpp>

#include <Eigen/Core>

#include <span>

namespace talus {

/// Directions of an interior point by iterations, as exact as a step can use.
template <int Dim>
class KrylovDirections {
  public:
    /// A step costs little without factors: paths may be tried longer.
    static constexpr double hope = 0.9;

    void begin(const ConeSystem<Dim>& system) { krylov_.analyze(system); }
    bool prepare(ConeSystem<Dim>& system, std::span<const Matrix<Dim>> d) {
        return krylov_.prepare(system, d);
    }
    /// Improves x, the predictor for a corrector; false if the error in u [sqrt(J)] stays larger
    /// than allowed.
    bool solve(ConeSystem<Dim>& system, const Eigen::VectorXd& b, Eigen::VectorXd& x,
               double allowed, int max_iterations) {
        return krylov_.solve(system, b, x, allowed, max_iterations);
    }
    /// Inner iterations of the last solve.
    long iteration_count() const { return krylov_.iteration_count(); }

  private:
    KrylovConeSolver<Dim> krylov_;
};

/// InteriorPoint without factors, in memory that grows with the number of contacts alone: inexact
/// directions by KrylovConeSolver, in about as many steps. Cheaper than factors in masonry of 1,000
/// contacts and more, not in houses of cards; sweeps are cheaper again from 100,000 on. Stops where
/// inner iterations do not arrive, with the best impulses met.
template <int Dim, ConeLaw<Dim> Law>
using InexactInteriorPoint = BasicInteriorPoint<Dim, Law, KrylovDirections<Dim>>;

}  // namespace talus

TALUS_IN_PLANE(class talus::ConeEngine<2, talus::Coulomb<2>,
                                       talus::InexactInteriorPoint<2, talus::Coulomb<2>>>)
TALUS_IN_SPACE(class talus::ConeEngine<3, talus::Coulomb<3>,
                                       talus::InexactInteriorPoint<3, talus::Coulomb<3>>>)
TALUS_IN_PLANE(class talus::BasicInteriorPoint<2, talus::Coulomb<2>, talus::KrylovDirections<2>>)
TALUS_IN_SPACE(class talus::BasicInteriorPoint<3, talus::Coulomb<3>, talus::KrylovDirections<3>>)
