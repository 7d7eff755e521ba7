// SPDX-License-Identifier: BSL-1.0
//
// A law of one's own: a wet contact, unilateral, with a tangential impulse proportional to the end
// slip, r_t = -c u_t while pressed. A block thrown along such a floor loses the same share of its
// speed in each step: v_k = v_0 / (1 + c/m)^k, exactly.
//
// Sample run:  examples/run 04_own_law
#include <talus/talus.hpp>

#include <Eigen/LU>

#include <cmath>
#include <cstdio>
#include <limits>

template <int Dim>
struct WetContact {
    double drag = 0.0;  ///< c, impulse per slip velocity [kg]

    /// One contact: open if it parts by itself, else u_n = 0 and u_t = -r_t / c, a linear system.
    talus::Vector<Dim> solve(const talus::LocalProblem<Dim>& p, const talus::Vector<Dim>&) const {
        if (p.b[0] >= 0.0) return talus::Vector<Dim>::Zero();
        talus::Matrix<Dim> m = p.W;
        for (int k = 1; k < Dim; ++k) m(k, k) += 1.0 / drag;
        return -m.partialPivLu().solve(p.b);
    }
    /// A map whose fixed points are the impulses that obey the law with u.
    talus::Vector<Dim> natural_map(const talus::Vector<Dim>& u, const talus::Vector<Dim>& r,
                                   double rho) const {
        talus::Vector<Dim> image = -drag * u;
        image[0] = std::max(0.0, r[0] - rho * u[0]);
        if (image[0] == 0.0) image.setZero();
        return image;
    }
};
static_assert(talus::ContactLaw<WetContact<2>, 2> && talus::ContactLaw<WetContact<3>, 3>);

template <int Dim>
struct Wet : talus::SimulationTypes<Dim> {
    using Law = WetContact<Dim>;
};

template <int Dim>
void slide() {
    using namespace talus;
    const Vector<Dim> up = Vector<Dim>::Unit(Dim - 1);
    const double mass = 2.0, drag = 0.05, never = std::numeric_limits<double>::infinity();

    Simulation<Dim, Wet<Dim>> sim({drag}, {.h = 1e-2});
    auto& system = sim.system();
    system.gravity = -9.81 * up;
    system.add_obstacle(HalfSpace<Dim>{up, 0.0});
    // Infinite moments of inertia: a block that does not turn.
    system.add(Ball<Dim>{0.1}, Inertia<Dim>{mass, AngularVector<Dim>::Constant(never)},
               {0.1 * up, {}}, {Vector<Dim>::Unit(0)});
    const RunSummary run = sim.run(0.5);
    std::printf("%dD: speed after 50 steps %.12f m/s, exact %.12f, residual %.0e\n", Dim,
                system.bodies.velocity[1][0], std::pow(1 + drag / mass, -50), run.residual.value);
}

int main() {
    slide<2>();
    slide<3>();
}
