// SPDX-License-Identifier: BSL-1.0
#include "peer_siconos.hpp"

#include <Eigen/Core>

#include <FrictionContactProblem.h>
#include <Friction_cst.h>
#include <NonSmoothDrivers.h>
#include <NumericsMatrix.h>
#include <NumericsVerbose.h>
#include <SolverOptions.h>
#include <SparseBlockMatrix.h>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <new>

// Of the BLAS that Siconos uses here; absent in others.
extern "C" __attribute__((weak)) void openblas_set_num_threads(int);

namespace bench {
namespace {

/// An array that Siconos will free.
template <class T>
T* c_array(std::size_t count) {
    void* const memory = std::calloc(count + 1, sizeof(T));
    if (memory == nullptr) throw std::bad_alloc();
    return static_cast<T*>(memory);
}

/// Units of mass and velocity in which a problem is handed over, in those of the problem.
struct Units {
    double mass = 1.0;
    double velocity = 1.0;
};

template <int Dim>
Units units_of(const BenchProblem<Dim>& problem, PeerUnits choice) {
    Units units;
    if (choice == PeerUnits::given || problem.contact_count() == 0) return units;
    double trace = 0.0, square = 0.0;
    for (std::size_t i = 0; i < problem.contact_count(); ++i) {
        trace += problem.assembled().delassus.diagonal_block(i).trace();
        square += problem.free_velocity()[i].squaredNorm();
    }
    const auto count = static_cast<double>(problem.contact_count());
    if (trace > 0.0) units.mass = Dim * count / trace;
    if (square > 0.0) units.velocity = std::sqrt(square / count);
    return units;
}

struct Free {
    void operator()(FrictionContactProblem* p) const { frictionContactProblem_free(p); }
    void operator()(SolverOptions* o) const {
        solver_options_delete(o);
        std::free(o);
    }
};
using ProblemPointer = std::unique_ptr<FrictionContactProblem, Free>;
using OptionsPointer = std::unique_ptr<SolverOptions, Free>;

/// W in compressed rows of blocks, each stored by columns, as Eigen does.
template <int Dim>
NumericsMatrix* matrix_of(const talus::DelassusSparse<Dim>& w, double scale) {
    const std::size_t n = w.contact_count();
    const int size = static_cast<int>(Dim * n);
    NumericsMatrix* const result = NM_create(NM_SPARSE_BLOCK, size, size);
    SparseBlockStructuredMatrix& m = *result->matrix1;
    m.nbblocks = static_cast<unsigned>(w.block_count());
    m.block = c_array<double*>(w.block_count());
    m.blocknumber0 = m.blocknumber1 = static_cast<unsigned>(n);
    m.blocksize0 = c_array<unsigned>(n);
    m.blocksize1 = c_array<unsigned>(n);
    m.filled1 = n + 1;
    m.filled2 = w.block_count();
    m.index1_data = c_array<std::size_t>(n + 1);
    m.index2_data = c_array<std::size_t>(w.block_count());
    std::size_t k = 0;
    for (std::size_t i = 0; i < n; ++i) {
        m.blocksize0[i] = m.blocksize1[i] = static_cast<unsigned>(Dim * (i + 1));
        for (std::size_t j = 0; j < w.columns(i).size(); ++j, ++k) {
            m.index2_data[k] = w.columns(i)[j];
            m.block[k] = c_array<double>(Dim * Dim);
            Eigen::Map<talus::Matrix<Dim>> block(m.block[k]);
            block = scale * w.blocks(i)[j];
        }
        m.index1_data[i + 1] = k;
    }
    return result;
}

template <int Dim>
ProblemPointer converted(const BenchProblem<Dim>& problem, const Units& units) {
    const std::size_t n = problem.contact_count();
    ProblemPointer p(frictionContactProblem_new());
    p->dimension = Dim;
    p->numberOfContacts = static_cast<int>(n);
    p->M = matrix_of(problem.assembled().delassus, units.mass);
    p->q = c_array<double>(Dim * n);
    p->mu = c_array<double>(n);
    for (std::size_t i = 0; i < n; ++i) {
        Eigen::Map<talus::Vector<Dim>> q(p->q + Dim * i);
        q = problem.free_velocity()[i] / units.velocity;
        p->mu[i] = problem.laws()[i].mu;
    }
    return p;
}

/// One solver of Siconos: its number, and the number of its inner solver (0: the usual one).
struct Choice {
    int solver;
    int inner = 0;
};

constexpr int no_limit = 1000000000;

template <int Dim>
SolveFunction<Dim> siconos(const Choice& choice, PeerUnits unit_choice) {
    return [=](const BenchProblem<Dim>& problem, double tolerance, LimitedClock& clock,
               std::span<talus::Vector<Dim>> r) {
        if (openblas_set_num_threads) openblas_set_num_threads(1);
        numerics_set_verbose(0);
        const Units units = units_of(problem, unit_choice);
        const double impulse_unit = units.mass * units.velocity;
        const ProblemPointer p = converted(problem, units);
        const OptionsPointer options(solver_options_create(choice.solver));
        if (choice.inner != 0) solver_options_update_internal(options.get(), 0, choice.inner);
        options->dparam[SICONOS_DPARAM_TOL] = tolerance;
        options->iparam[SICONOS_IPARAM_MAX_ITER] = no_limit;
        std::vector<double> impulse(Dim * r.size()), velocity(Dim * r.size());
        for (std::size_t i = 0; i < r.size(); ++i)
            for (int d = 0; d < Dim; ++d)
                impulse[Dim * i + static_cast<std::size_t>(d)] = r[i][d] / impulse_unit;
        const auto driver = Dim == 2 ? fc2d_driver : fc3d_driver;
        Outcome outcome;
        clock.start();
        const int info = driver(p.get(), impulse.data(), velocity.data(), options.get());
        outcome.seconds = clock.stop();
        for (std::size_t i = 0; i < r.size(); ++i)
            for (int d = 0; d < Dim; ++d)
                r[i][d] = impulse_unit * impulse[Dim * i + static_cast<std::size_t>(d)];
        outcome.iterations = options->iparam[SICONOS_IPARAM_ITER_DONE];
        outcome.converged = info == 0;
        outcome.set_word(info == 0 ? "converged" : "info " + std::to_string(info));
        return outcome;
    };
}

}  // namespace

std::vector<RegisteredSolver> siconos_solvers(PeerUnits units) {
    std::vector<RegisteredSolver> solvers;
    const auto add = [&](const std::string& name, const SolveFunction<2>& plane,
                         const SolveFunction<3>& space, std::size_t most_contacts) {
        solvers.push_back({.name = "siconos_" + name,
                           .plane = plane,
                           .space = space,
                           .in_place = false,
                           .assembles = true,
                           .most_contacts = most_contacts});
    };
    const auto plane = [&](int solver) { return siconos<2>({solver}, units); };
    const auto space = [&](int solver, int inner = 0) {
        return siconos<3>({solver, inner}, units);
    };
    constexpr std::size_t any = std::numeric_limits<std::size_t>::max();
    // Lemke's tableau is full: three rows per contact.
    constexpr std::size_t full_tableau = 1500;
    add("nsgs", plane(SICONOS_FRICTION_2D_NSGS), space(SICONOS_FRICTION_3D_NSGS), any);
    add("nsgs_quartic", {}, space(SICONOS_FRICTION_3D_NSGS, SICONOS_FRICTION_3D_ONECONTACT_QUARTIC),
        any);
    add("lemke", plane(SICONOS_FRICTION_2D_LEMKE), {}, full_tableau);
    add("admm", {}, space(SICONOS_FRICTION_3D_ADMM), any);
    add("nsn_ac", {}, space(SICONOS_FRICTION_3D_NSN_AC), any);
    add("prox", {}, space(SICONOS_FRICTION_3D_PROX, SICONOS_FRICTION_3D_NSN_AC), any);
    add("eg", {}, space(SICONOS_FRICTION_3D_EG), any);
    return solvers;
}

}  // namespace bench
