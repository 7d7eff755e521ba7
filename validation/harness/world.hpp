// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/observer.hpp>
#include <talus/solver/sweeps/gauss_seidel.hpp>
#include <talus/stepping/equilibrium.hpp>
#include <talus/stepping/simulation.hpp>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "dense_problem.hpp"
#include "faults.hpp"
#include "setting.hpp"
#include "shapes.hpp"

namespace validation {

template <int Dim>
using System = talus::System<Dim, Law<Dim>, ShapeType<Dim>>;
template <int Dim>
using StepData = talus::StepData<Dim, Law<Dim>>;
template <int Dim>
using Equilibrium = talus::EquilibriumReport<Dim, Law<Dim>>;
template <int Dim>
using Problem = talus::ContactProblem<Dim, Law<Dim>>;

/// The solver of a case that names no other, with all its parameters; others, by their names in
/// the library's registry, take its tolerance and its limit of iterations. Faults are
/// always put into this one.
inline constexpr const char* usual_solver = "gauss_seidel";
/// All names.
std::vector<std::string> solver_names();

/// How a world steps. The law given is that of every contact; several go into `laws`.
template <int Dim>
struct WorldParams {
    double h = 1e-3;  ///< step size [s]
    Law<Dim> contact = law<Dim>(0.0);
    V<Dim> gravity = -g * up<Dim>();  ///< [m/s^2]
    talus::StepParams step = {.contact_tolerance = touching};
    talus::GaussSeidelParams solver = {.max_sweeps = 2000, .tolerance = 1e-14};
    std::string solver_name = usual_solver;  ///< unless the run names one
    bool prepares = false;  ///< makes a state for another world: its residuals are not judged
};

namespace detail {
template <int Dim>
class Engine;
}

/// A talus::Simulation behind a wall, so that a file of cases does not compile the library again,
/// and so that a fault can be put into it. Without a fault it is the library's own Simulation with
/// nothing added.
template <int Dim>
class World {
  public:
    /// What else wants to know of the steps: the sketch of a case, its worst residual.
    struct Listener {
        std::function<void(const World&)> before_first_step;
        std::function<void(const World&)> after_first_step;
        std::function<void(double residual)> solved;
    };

    World(const WorldParams<Dim>& params, talus::MaterialTable<Law<Dim>> laws, Fault fault,
          Listener listener);
    World(World&&) noexcept;
    ~World();

    const WorldParams<Dim>& params() const { return params_; }
    System<Dim>& system();
    const System<Dim>& system() const;
    talus::Bodies<Dim>& bodies() { return system().bodies; }
    const talus::Bodies<Dim>& bodies() const { return system().bodies; }

    /// The half-space x_last <= 0.
    talus::BodyIndex add_floor(talus::MaterialIndex material = 0);
    /// The solid behind a plane through `point` with the given outward normal.
    talus::BodyIndex add_plane(const V<Dim>& point, const V<Dim>& normal,
                               talus::MaterialIndex material = 0);
    /// A body of any shape and inertia.
    talus::BodyIndex add(const ShapeType<Dim>& shape, const talus::Inertia<Dim>& inertia,
                         const talus::Pose<Dim>& pose, const talus::Twist<Dim>& twist = {},
                         talus::MaterialIndex material = 0);
    talus::BodyIndex add_obstacle(const ShapeType<Dim>& shape,
                                  talus::PrescribedMotion<Dim> motion = {},
                                  talus::MaterialIndex material = 0);

    const StepData<Dim>& step();
    /// Makes the steps of a duration [s]; `on_step(const World&)` may return false to stop.
    template <class OnStep = talus::Ignore>
    void run(double duration, OnStep on_step = {}) {
        const auto steps = std::llround(duration / params_.h);
        for (long long k = 0; k < steps; ++k) {
            step();
            if (!talus::notify(on_step, std::as_const(*this))) return;
        }
    }

    double time() const;  ///< [s]
    const StepData<Dim>& data() const;
    /// Impulses remembered for the next step.
    talus::ImpulseCache<Dim>& impulse_cache();

    /// The one-step equilibrium test on the present configuration, which stays as it is.
    Equilibrium<Dim> equilibrium(const talus::ImpulseCache<Dim>& start = {},
                                 double rest = 1e-9) const;

  private:
    WorldParams<Dim> params_;
    Listener listener_;
    std::unique_ptr<detail::Engine<Dim>> engine_;
    bool late_forces_ = false;  // a fault
    mutable bool stepped_ = false;
};

/// Solves a contact problem from `r`, into `r`, with the solver of all cases (or a faulty one).
template <int Dim>
talus::SolveReport solve(const Problem<Dim>& problem, std::vector<V<Dim>>& r,
                         const talus::GaussSeidelParams& params, Fault fault,
                         const std::string& solver_name = usual_solver);
template <int Dim>
talus::SolveReport solve(const DenseProblem<Dim>& problem, std::vector<V<Dim>>& r,
                         const talus::GaussSeidelParams& params, Fault fault,
                         const std::string& solver_name = usual_solver);

/// Solves one contact: the law's own local solution (or that of a faulty law).
template <int Dim>
V<Dim> solve_contact(const Law<Dim>& law, const talus::LocalProblem<Dim>& problem, Fault fault);

/// Velocity of contact c at the end of the step, local axes [m/s].
template <int Dim>
V<Dim> end_velocity(const StepData<Dim>& data, std::size_t c = 0) {
    return talus::relative_velocity<Dim>(data.problem.jacobian, c, data.end);
}
template <int Dim>
V<Dim> begin_velocity(const StepData<Dim>& data, std::size_t c = 0) {
    return talus::relative_velocity<Dim>(data.problem.jacobian, c, data.begin);
}
/// Impulse that `body` received at contact c, world axes [N s]; zero if it is not part of it.
template <int Dim>
V<Dim> impulse_on(const StepData<Dim>& data, talus::BodyIndex body, std::size_t c) {
    const auto& j = data.problem.jacobian;
    const V<Dim> on_a = j.frame[c].transpose() * data.impulse[c];
    if (j.a[c] == body) return on_a;
    if (j.b[c] == body) return -on_a;
    return V<Dim>::Zero();
}
/// Sum over the contacts of `body` [N s].
template <int Dim>
V<Dim> impulse_on(const StepData<Dim>& data, talus::BodyIndex body) {
    V<Dim> sum = V<Dim>::Zero();
    for (std::size_t c = 0; c < data.contact_count(); ++c) sum += impulse_on(data, body, c);
    return sum;
}

}  // namespace validation
