// SPDX-License-Identifier: BSL-1.0
#include "world.hpp"

#include <type_traits>

#include "faulty.hpp"
#include "solvers.hpp"

namespace validation {

namespace detail {

/// A simulation, plain or faulty.
template <int Dim>
class Engine {
  public:
    virtual ~Engine() = default;
    virtual System<Dim>& system() = 0;
    virtual const StepData<Dim>& step() = 0;
    virtual const StepData<Dim>& data() const = 0;
    virtual double time() const = 0;
    virtual talus::ImpulseCache<Dim>& cache() = 0;
    virtual Equilibrium<Dim> equilibrium(const talus::EquilibriumParams& params,
                                         const talus::ImpulseCache<Dim>& start) = 0;
};

template <int Dim>
talus::AnySolver<Dim, Law<Dim>> named_solver(const std::string& name,
                                             const talus::GaussSeidelParams& params) {
    return talus::make_solver<Dim, Law<Dim>>(name, {params.tolerance, params.max_sweeps});
}

namespace {

template <int Dim, class SolverType, class HooksType, class Broad>
struct WorldTypes : talus::SimulationTypes<Dim> {
    using Law = validation::Law<Dim>;
    using Shape = ShapeType<Dim>;
    using Solver = SolverType;
    using Hooks = HooksType;
    using BroadPhase = Broad;
};

template <int Dim, class Solver, class Hooks = talus::NoHooks,
          class Broad = talus::HierarchicalGrid<Dim>>
class EngineOf : public Engine<Dim> {
  public:
    EngineOf(System<Dim> system, const talus::SimulationParams& params, Solver solver,
             Hooks hooks = {})
        : sim_(std::move(system), params, std::move(solver)) {
        sim_.hooks() = hooks;
    }
    System<Dim>& system() override { return sim_.system(); }
    const StepData<Dim>& step() override { return sim_.step(); }
    const StepData<Dim>& data() const override { return sim_.data(); }
    double time() const override { return sim_.time(); }
    talus::ImpulseCache<Dim>& cache() override { return sim_.impulse_cache(); }
    Equilibrium<Dim> equilibrium(const talus::EquilibriumParams& params,
                                 const talus::ImpulseCache<Dim>& start) override {
        return talus::equilibrium<Dim>(sim_.system(), params, sim_.solver(), start, sim_.hooks());
    }

  private:
    talus::Simulation<Dim, WorldTypes<Dim, Solver, Hooks, Broad>> sim_;
};

template <int Dim>
std::unique_ptr<Engine<Dim>> make_engine(const WorldParams<Dim>& params,
                                         talus::MaterialTable<Law<Dim>> laws, Fault fault) {
    System<Dim> system(std::move(laws));
    system.gravity = params.gravity;
    talus::SimulationParams settings;
    settings.h = params.h;
    settings.step = params.step;
    if (fault == Fault::none && params.solver_name != usual_solver) {
        using Solver = talus::AnySolver<Dim, Law<Dim>>;
        return std::make_unique<EngineOf<Dim, Solver>>(
            std::move(system), settings, named_solver<Dim>(params.solver_name, params.solver));
    }
    if (fault == Fault::none) {
        using Solver = talus::GaussSeidel<Dim, Law<Dim>>;
        return std::make_unique<EngineOf<Dim, Solver>>(std::move(system), settings,
                                                       Solver(params.solver));
    }
    if (fault == Fault::loose_contact)
        settings.step.contact_tolerance = settings.step.contact_tolerance.value_or(0.0) + 2e-2;
    const auto faulty = [&]<bool Stale>(std::bool_constant<Stale>) -> std::unique_ptr<Engine<Dim>> {
        using Pairs = FaultyPairs<Dim, Stale>;
        FaultyHooks<Dim> hooks;
        hooks.fault = fault;
        hooks.step = settings.step;
        return std::make_unique<EngineOf<Dim, FaultySolver<Dim>, FaultyHooks<Dim>, Pairs>>(
            std::move(system), settings, FaultySolver<Dim>(params.solver, fault), hooks);
    };
    if (fault == Fault::stale_candidates) return faulty(std::true_type{});
    return faulty(std::false_type{});
}

/// Makes the forces be evaluated half a step too early.
template <int Dim>
void delay_forces(System<Dim>& system, double h) {
    for (auto& force : system.forces)
        force = [force, h](double t, const talus::Bodies<Dim>& bodies,
                           std::span<talus::Wrench<Dim>> wrenches) {
            talus::Bodies<Dim> before = bodies;
            talus::drift(before, -0.5 * h);
            force(t - 0.5 * h, before, wrenches);
        };
}

}  // namespace
}  // namespace detail

template <int Dim>
World<Dim>::World(const WorldParams<Dim>& params, talus::MaterialTable<Law<Dim>> laws, Fault fault,
                  Listener listener)
    : params_(params),
      listener_(std::move(listener)),
      engine_(detail::make_engine<Dim>(params, std::move(laws), fault)),
      late_forces_(fault == Fault::force_at_begin) {}
template <int Dim>
World<Dim>::World(World&&) noexcept = default;
template <int Dim>
World<Dim>::~World() = default;

template <int Dim>
System<Dim>& World<Dim>::system() {
    return engine_->system();
}
template <int Dim>
const System<Dim>& World<Dim>::system() const {
    return engine_->system();
}

template <int Dim>
talus::BodyIndex World<Dim>::add_floor(talus::MaterialIndex material) {
    return add_obstacle(talus::HalfSpace<Dim>{up<Dim>(), 0.0}, {}, material);
}
template <int Dim>
talus::BodyIndex World<Dim>::add_plane(const V<Dim>& point, const V<Dim>& normal,
                                       talus::MaterialIndex material) {
    return add_obstacle(talus::HalfSpace<Dim>{normal, normal.normalized().dot(point)}, {},
                        material);
}
template <int Dim>
talus::BodyIndex World<Dim>::add(const ShapeType<Dim>& shape, const talus::Inertia<Dim>& inertia,
                                 const talus::Pose<Dim>& pose, const talus::Twist<Dim>& twist,
                                 talus::MaterialIndex material) {
    return system().add(shape, inertia, pose, twist, material);
}
template <int Dim>
talus::BodyIndex World<Dim>::add_obstacle(const ShapeType<Dim>& shape,
                                          talus::PrescribedMotion<Dim> motion,
                                          talus::MaterialIndex material) {
    return system().add_obstacle(shape, std::move(motion), material);
}

template <int Dim>
const StepData<Dim>& World<Dim>::step() {
    const bool first = !stepped_;
    if (first && late_forces_) detail::delay_forces<Dim>(system(), params_.h);
    stepped_ = true;
    if (first && listener_.before_first_step) listener_.before_first_step(*this);
    const StepData<Dim>& data = engine_->step();
    if (listener_.solved) listener_.solved(data.report.residual);
    if (first && listener_.after_first_step) listener_.after_first_step(*this);
    return data;
}
template <int Dim>
double World<Dim>::time() const {
    return engine_->time();
}
template <int Dim>
const StepData<Dim>& World<Dim>::data() const {
    return engine_->data();
}
template <int Dim>
talus::ImpulseCache<Dim>& World<Dim>::impulse_cache() {
    return engine_->cache();
}
template <int Dim>
Equilibrium<Dim> World<Dim>::equilibrium(const talus::ImpulseCache<Dim>& start, double rest) const {
    if (!stepped_ && listener_.before_first_step) listener_.before_first_step(*this);
    stepped_ = true;
    Equilibrium<Dim> report = engine_->equilibrium(
        {.h = params_.h, .rest = rest, .contact_tolerance = params_.step.contact_tolerance}, start);
    if (listener_.solved) listener_.solved(report.residual);
    return report;
}

template <int Dim>
talus::SolveReport solve(const Problem<Dim>& problem, std::vector<V<Dim>>& r,
                         const talus::GaussSeidelParams& params, Fault fault,
                         const std::string& solver_name) {
    if (fault == Fault::none && solver_name != usual_solver)
        return detail::named_solver<Dim>(solver_name, params).solve(problem, std::span<V<Dim>>(r));
    if (fault == Fault::none)
        return talus::GaussSeidel<Dim, Law<Dim>>(params).solve(problem, std::span<V<Dim>>(r));
    return FaultySolver<Dim>(params, fault).solve(problem, std::span<V<Dim>>(r));
}

template <int Dim>
talus::SolveReport solve(const DenseProblem<Dim>& problem, std::vector<V<Dim>>& r,
                         const talus::GaussSeidelParams& params, Fault fault,
                         const std::string& solver_name) {
    if (fault != Fault::none) return FaultySolver<Dim>(params, fault).solve(problem, std::span(r));
    if (solver_name != usual_solver) {
        talus::DelassusSparse<Dim> w(problem.contact_count(), problem.blocks());
        return detail::named_solver<Dim>(solver_name, params)
            .solve(w, std::span<const V<Dim>>(problem.free_velocity),
                   std::span<const Law<Dim>>(problem.laws), std::span<V<Dim>>(r));
    }
    DenseDelassus<Dim> w(problem.w);
    return talus::GaussSeidel<Dim, Law<Dim>>(params).solve(
        w, std::span<const V<Dim>>(problem.free_velocity), std::span<const Law<Dim>>(problem.laws),
        std::span<V<Dim>>(r));
}

template <int Dim>
V<Dim> solve_contact(const Law<Dim>& law, const talus::LocalProblem<Dim>& problem, Fault fault) {
    if (fault == Fault::none) return law.solve(problem, V<Dim>::Zero());
    return FaultyLaw<Dim>{law, fault}.solve(problem, V<Dim>::Zero());
}

#define TALUS_VALIDATION_INSTANTIATE(Dim)                                                  \
    template class World<Dim>;                                                             \
    template talus::SolveReport solve<Dim>(const Problem<Dim>&, std::vector<V<Dim>>&,      \
                                           const talus::GaussSeidelParams&, Fault,         \
                                           const std::string&);                            \
    template talus::SolveReport solve<Dim>(const DenseProblem<Dim>&, std::vector<V<Dim>>&, \
                                           const talus::GaussSeidelParams&, Fault,         \
                                           const std::string&);                            \
    template V<Dim> solve_contact<Dim>(const Law<Dim>&, const talus::LocalProblem<Dim>&, Fault);
TALUS_VALIDATION_INSTANTIATE(2)
TALUS_VALIDATION_INSTANTIATE(3)

}  // namespace validation
