// SPDX-License-Identifier: BSL-1.0
//
// A ball is thrown obliquely onto a floor, with friction and without restitution, in the plane and
// in space from one text. It lands, slides, and ends by rolling; a disc keeps 2/3 of its horizontal
// speed, a sphere 5/7, whatever the friction coefficient (Coriolis 1835). The landing falls
// somewhere within a step, which leaves an error of order h.
//
// Sample run:  examples/run 01_ball_drop
#include <talus/talus.hpp>

#include <cstdio>

template <int Dim>
void drop_ball() {
    using namespace talus;
    const double radius = 0.1;  // [m]
    const Vector<Dim> up = Vector<Dim>::Unit(Dim - 1);

    SimulationParams params{.h = 1e-4};
    params.step.scheme = Scheme::gap_anticipating;  // lands without overlap
    Simulation<Dim> sim({Coulomb<Dim>{.mu = 0.3}}, params);
    auto& system = sim.system();
    system.gravity = -9.81 * up;
    system.add_obstacle(HalfSpace<Dim>{up, 0.0});
    const BodyIndex ball = system.add(Ball<Dim>{radius}, 1000.0, {1.0 * up, {}},
                                      {Vector<Dim>(3.0 * Vector<Dim>::Unit(0))});

    EnergyLedger<Dim> ledger(system.bodies, system.gravity);
    const RunSummary run =
        sim.run(2.0, [&](const auto& s) { ledger.record(s.data(), s.system().bodies); });

    const double speed = system.bodies.velocity[ball][0];
    std::printf("%dD: rolls at %.12f m/s (exact %.12f), energy books close to %.0e\n    %s\n", Dim,
                speed, Dim == 2 ? 2.0 : 15.0 / 7.0, ledger.closure(), to_string(run).c_str());
}

int main() {
    drop_ball<2>();
    drop_ball<3>();
}
