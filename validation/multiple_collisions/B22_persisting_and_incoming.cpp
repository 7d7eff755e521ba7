// SPDX-License-Identifier: BSL-1.0
#include <Eigen/Core>

#include "harness/gsl.hpp"
#include "multiple_collisions.hpp"

namespace validation {
namespace B22 {

constexpr double radius = 0.1, v = 1.0;

/// `n` balls at rest upon each other on the floor (body 0), and one more that arrives on top.
template <int Dim>
World<Dim> column(Trial<Dim>& trial, std::size_t n, double e, double tolerance = 1e-14) {
    auto params = collision_params<Dim>(law<Dim>(0.0, e));
    // Sweeps are counted in one fixed order: no shuffling.
    params.solver = {.max_sweeps = 1000000, .tolerance = tolerance, .shuffle_after = 1000000};
    auto world = trial.world(params);
    world.add_floor();
    for (std::size_t i = 0; i <= n; ++i)
        add_ball<Dim>(world, 1.0, radius, (2 * static_cast<double>(i) + 1) * radius * up<Dim>(),
                      i == n ? V<Dim>(-v * up<Dim>()) : V<Dim>::Zero());
    return world;
}

/// Reference: sweeps that plain Gauss-Seidel needs for the soft column, from the floor upwards and
/// from zero, until the residual in the documented measure is `asked`:
/// |(r - max(0, r - rho u)) / sqrt(rho)| over the larger of |r / sqrt(rho)| and |sqrt(rho) u_free|.
template <int Dim>
int plain_sweeps(std::size_t n, double asked) {
    const auto contacts = static_cast<Eigen::Index>(n + 1);
    Eigen::MatrixXd w = 2.0 * Eigen::MatrixXd::Identity(contacts, contacts);
    w(0, 0) = 1.0;  // with the floor
    for (Eigen::Index i = 0; i + 1 < contacts; ++i) w(i, i + 1) = w(i + 1, i) = -1.0;
    Eigen::VectorXd free = Eigen::VectorXd::Zero(contacts), r = free;
    free[contacts - 1] = -v;
    // rho = Dim / trace of a contact's block, whose tangential parts know of the balls' rotation.
    const double tangential = 1.0 + 1.0 / kap<Dim>;
    const Eigen::VectorXd rho =
        (Dim / (1.0 + (Dim - 1) * tangential)) * w.diagonal().cwiseInverse();
    const Eigen::VectorXd root = rho.cwiseSqrt();
    for (int sweep = 1;; ++sweep) {
        for (Eigen::Index i = 0; i < contacts; ++i)
            r[i] = std::max(0.0, r[i] - (w.row(i).dot(r) + free[i]) / w(i, i));
        const Eigen::VectorXd u = w * r + free;
        const Eigen::VectorXd error = r - (r - rho.cwiseProduct(u)).cwiseMax(0.0);
        const double scale = std::max(r.cwiseQuotient(root).norm(), free.cwiseProduct(root).norm());
        if (error.cwiseQuotient(root).norm() <= asked * scale) return sweep;
    }
}

template <int Dim>
void run(Trial<Dim>& trial) {
    constexpr std::size_t n = 3;
    for (const double e : {0.0, 1.0}) {
        const std::string name = e == 0.0 ? "e = 0" : "e = 1";
        PointCollision<Dim> collision;
        collision.mass.assign(n + 1, 1.0);
        collision.velocity.assign(n + 1, V<Dim>::Zero());
        collision.velocity[n] = -v * up<Dim>();
        for (int i = 0; i <= static_cast<int>(n); ++i)
            collision.contacts.push_back(
                {i, i == 0 ? PointCollision<Dim>::wall : i - 1, up<Dim>(), e});
        const auto enumerated = collision.moreau();

        auto world = column<Dim>(trial, n, e);
        const auto& data = world.step();
        const double tolerance = world.params().solver.tolerance;
        trial.holds("contacts, " + name, data.contact_count() == n + 1);
        trial.holds("reference, impulses are unique, " + name, enumerated.unique_impulses);
        for (std::size_t i = 0; i <= n; ++i) {
            const std::string who = "ball " + std::to_string(i + 1) + ", " + name;
            const V<Dim> exact = i == n ? V<Dim>(e * v * up<Dim>()) : V<Dim>::Zero();
            trial.rounding("reference, enumeration, " + who, enumerated.velocity[i], exact, 10 * v);
            trial.rounding("reference, impulse below " + who,
                           enumerated.impulse[static_cast<Eigen::Index>(i)], (1 + e) * v, 10 * v);
            trial.solver("velocity of " + who, world.bodies().velocity[i + 1], exact, v, tolerance);
            // Contact i of the sorted keys lies below ball i.
            trial.solver("impulse below " + who + " [N s]", data.impulse[i][0], (1 + e) * v, 2 * v,
                         tolerance);
        }
    }

    // The work of the solver, a statement on Gauss-Seidel: others take fewer iterations.
    const bool sweeps_only = trial.solver_name() == usual_solver;
    constexpr double asked = 1e-10;
    Series sweeps{"computed", {}, {}}, predicted{"plain Gauss-Seidel", {}, {}, true};
    std::vector<double> log_n, log_sweeps;
    std::vector<std::size_t> sizes{3, 7, 15, 31};
    if (trial.full()) sizes.insert(sizes.end(), {63, 127});
    for (const std::size_t size : sizes) {
        auto world = column<Dim>(trial, size, 0.0, asked);
        const auto& data = world.step();
        const double contacts = static_cast<double>(size + 1);
        const double expected = plain_sweeps<Dim>(size, asked);
        trial.holds("the solver arrives, " + std::to_string(size + 1) + " contacts",
                    data.report.status == talus::SolveStatus::converged);
        sweeps.x.push_back(contacts);
        sweeps.y.push_back(data.report.iterations);
        predicted.x.push_back(contacts);
        predicted.y.push_back(expected);
        log_n.push_back(std::log(contacts));
        log_sweeps.push_back(std::log(static_cast<double>(data.report.iterations)));
        if (sweeps_only)
            trial.within("sweeps to 1e-10, " + std::to_string(size + 1) + " contacts",
                         data.report.iterations, expected, 2.0,
                         "the solver looks at the residual only now and then");
    }
    const auto line = gsl::fit_line(log_n, log_sweeps);
    if (sweeps_only)
        trial.within("exponent of sweeps over contacts", line.slope, 2.0, 0.2,
                     "n^2 up to a logarithm: the residual is smaller than the error by n^2");
    trial.curves({"work of the solver", "contacts", "sweeps", {sweeps, predicted}});
}

const Register b22(
    {.id = "B22",
     .name = "persisting-and-incoming",
     .title = "A ball dropped on a resting column",
     .gate = 2,
     .setup =
         "Three equal balls of 1 kg rest upon each other on the floor, a fourth arrives on the "
         "axis at 1 m/s; no gravity, no friction, restitution 0 or 1. For the work of the "
         "solver, soft columns of up to 31 balls (127 with --full).",
     .reference = {"u_{end} = −e u_{begin}: all stop, or the last one returns alone",
                   "P = (1 + e) m v in every contact",
                   "sweeps of Gauss-Seidel: those of a plain one, written here; ∝ n^2"},
     .compared = "All velocities and impulses, which are unique here; the number of sweeps with "
                 "that of a plain Gauss-Seidel, and its growth with the square of the number of "
                 "contacts.",
     .kind = Class::S,
     .why = "The floor takes part in the impact through the whole column within one step. The "
            "chain amplifies the solver's residual by less than ten.",
     .source = "Moreau 1988.",
     .catches = {Fault::restitution_weight, Fault::reaction_lost, Fault::residual_ignored}},
    run<2>, run<3>, __FILE__);

}  // namespace B22
}  // namespace validation
