// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/law/cohesive.hpp>

#include "harness/case.hpp"
#include "harness/faulty.hpp"

/// One block that does not turn, on the cohesive half-space x_last <= 0.
namespace validation {

/// A simulation of its own, as the worlds of the other cases know Coulomb's law only; the faults of
/// the stages of a step, of the contact set and of friction come in by the same doors.
template <int Dim>
class CohesiveBlock {
  public:
    static constexpr double mass = 2.0, size = 0.1;  ///< [kg], [m]

    /// `force` is the cohesion [N].
    CohesiveBlock(Fault fault, double h, double mu, double force, const V<Dim>& gravity)
        : simulation_({{fault == Fault::friction_off ? 1.02 * mu : mu}, force * h},
                      settings(h, fault),
                      Solver({.max_iterations = 2000,
                              .tolerance = 1e-14,
                              .acceleration = talus::Acceleration::nesterov})) {
        simulation_.hooks().fault = fault;
        auto& system = simulation_.system();
        system.gravity = gravity;
        system.add_obstacle(talus::HalfSpace<Dim>{up<Dim>(), 0.0});
        system.add(talus::Ball<Dim>(size), point_mass<Dim>(mass), {size * up<Dim>(), {}});
    }
    /// Makes the steps of a duration [s]; `on_step(time, velocity, position)` of the foot.
    template <class OnStep>
    void run(double duration, OnStep on_step) {
        const auto look = [&](const auto& s) {
            const auto& bodies = s.system().bodies;
            on_step(s.time(), bodies.velocity[1], V<Dim>(bodies.position[1] - size * up<Dim>()));
        };
        const talus::RunSummary made = simulation_.run(duration, look);
        worst_residual_ = std::max(worst_residual_, made.residual.value);
    }
    double worst_residual() const { return worst_residual_; }

  private:
    using Contact = talus::CohesiveCoulomb<Dim>;
    using Solver = talus::AcceleratedGaussSeidel<Dim, Contact>;  // with its own defaults

    static talus::SimulationParams settings(double h, Fault fault) {
        talus::SimulationParams result;
        result.h = h;
        result.step.contact_tolerance = touching + (fault == Fault::loose_contact ? 2e-2 : 0.0);
        return result;
    }

    struct Types : talus::SimulationTypes<Dim> {
        using Law = Contact;
        using Shape = ShapeType<Dim>;
        using Hooks = FaultyHooks<Dim>;
    };
    talus::Simulation<Dim, Types> simulation_;
    double worst_residual_ = 0.0;
};

}  // namespace validation
