// SPDX-License-Identifier: BSL-1.0
//
// Watching a solver: two unit masses stacked on a floor, contact 0 is floor-A, contact 1 is A-B,
// both pushed sideways. The contact problem is written down directly, without any body: a solver
// needs the Delassus operator, the free velocities and the laws, and nothing else. The exact
// impulses are (2, -0.7) and (1, -0.4) N s.
//
// Sample run:  examples/run 06_watch_convergence
#include <talus/law/coulomb.hpp>
#include <talus/problem/delassus_sparse.hpp>
#include <talus/solver/sweeps/gauss_seidel.hpp>

#include <cstdio>
#include <vector>

template <int Dim>
void stack() {
    using namespace talus;
    using Law = Coulomb<Dim>;
    const Matrix<Dim> one = Matrix<Dim>::Identity();
    DelassusSparse<Dim> w(2, {{0, 0, one}, {1, 1, 2.0 * one}, {0, 1, -one}, {1, 0, -one}});

    std::vector<Vector<Dim>> u_free(2, Vector<Dim>::Zero()), r(2, Vector<Dim>::Zero());
    u_free[0].template head<2>() << -1.0, 0.3;  // (normal, tangent) [m/s]
    u_free[1].template head<2>() << 0.0, 0.1;
    const std::vector<Law> laws(2, Law{.mu = 0.5});

    GaussSeidel<Dim, Law> solver({.tolerance = 1e-12});
    const auto& report = solver.solve(w, u_free, laws, r, [](int sweep, double residual) {
        if (sweep % 10 == 0) std::printf("  sweep %2d: residual %.1e\n", sweep, residual);
    });
    std::printf("%dD: %d sweeps, r0 = (%.9f, %.9f), r1 = (%.9f, %.9f)\n", Dim, report.iterations,
                r[0][0], r[0][1], r[1][0], r[1][1]);
}

int main() {
    stack<2>();
    stack<3>();
}
