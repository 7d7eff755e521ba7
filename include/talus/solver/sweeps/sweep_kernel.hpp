// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/column.hpp>
#include <talus/core/input.hpp>
#include <talus/core/room.hpp>
#include <talus/law/prepared.hpp>
#include <talus/problem/residual.hpp>

#include <cstddef>
#include <span>

namespace talus {

/// What solvers by sweeps do again and again: solve one contact with the others as they are. `w`
/// follows the impulses `r`.
template <int Dim, ContactLaw<Dim> Law, class W>
struct SweepTask {
    W& w;
    std::span<const Vector<Dim>> free_velocity;
    std::span<const Law> laws;
    std::span<Vector<Dim>> r;

    /// Throws input_error unless all arrays have one entry per contact.
    void require_sizes() const {
        const std::size_t contacts = w.contact_count();
        require_count("free velocities", free_velocity.size(), "contacts", contacts);
        require_count("laws", laws.size(), "contacts", contacts);
        require_count("impulses", r.size(), "contacts", contacts);
    }
};

/// Calls f(task), where no stress drives a cell with an operator that does not ask for one.
template <int Dim, class Law, class W, class F>
void with_quickest(const SweepTask<Dim, Law, W>& task, F&& f) {
    if constexpr (requires { task.w.without_cell(); }) {
        if (!task.w.has_driven_cell()) {
            auto quick = task.w.without_cell();
            return f(
                SweepTask<Dim, Law, decltype(quick)>{quick, task.free_velocity, task.laws, task.r});
        }
    }
    f(task);
}

/// The part of a sweep that depends on W and the laws alone, and one visit.
template <int Dim, ContactLaw<Dim> Law>
class SweepKernel {
  public:
    template <class W>
    void prepare(const SweepTask<Dim, Law, W>& task) {
        measure_.template prepare<W, Law>(task.w, task.free_velocity, task.laws, task.r);
        prepared_.clear();
        detail::make_room(prepared_, task.r.size());
        for (std::size_t i = 0; i < task.r.size(); ++i)
            prepared_.push_back(talus::prepare<Dim>(task.laws[i], task.w.diagonal_block(i)));
    }

    /// Solves contact i; returns the square of its change, |dr|^2 / rho [J].
    template <class W>
    [[gnu::noinline]] double visit(const SweepTask<Dim, Law, W>& task, std::size_t i) const {
        Vector<Dim> u = task.w.velocity(i);
        for (int d = 0; d < Dim; ++d) u[d] += task.free_velocity[i][d];
        const Vector<Dim> r = talus::improved<Dim>(task.laws[i], prepared_[i], u, task.r[i]);
        Vector<Dim> dr;
        double square = 0.0;
        for (int d = 0; d < Dim; ++d) {
            dr[d] = r[d] - task.r[i][d];
            square += dr[d] * dr[d];
            task.r[i][d] = r[d];
        }
        task.w.add(i, dr);
        return square / measure_.effective_mass(i);
    }

    /// Goes a part of the way to what solves contact i.
    template <class W>
    [[gnu::noinline]] void visit_in_part(const SweepTask<Dim, Law, W>& task, std::size_t i,
                                         double part) const {
        const Vector<Dim> before = task.r[i];
        visit(task, i);
        const Vector<Dim> back = (part - 1.0) * (task.r[i] - before);
        task.r[i] += back;
        task.w.add(i, back);
    }

    /// The residual at the impulses that `w` follows. Costs about half a sweep.
    template <class W>
    Residual evaluate(const SweepTask<Dim, Law, W>& task) {
        velocity_.resize(task.r.size());
        with_quickest(task, [&](const auto& quick) {
            for (std::size_t i = 0; i < velocity_.size(); ++i) velocity_[i] = quick.w.velocity(i);
        });
        return evaluate(task.free_velocity, task.laws, task.r);
    }

    /// Its effective masses are the D of the norms |D^-1/2 dr|.
    const ResidualMeasure<Dim>& measure() const { return measure_; }

  private:
    /// At velocity_; compiled once for all operators.
    Residual evaluate(std::span<const Vector<Dim>> free_velocity, std::span<const Law> laws,
                      std::span<const Vector<Dim>> r) {
        return measure_.template evaluate<Law>(free_velocity, laws, r,
                                               [&](std::size_t i) { return velocity_[i]; });
    }

    ResidualMeasure<Dim> measure_;
    Column<Vector<Dim>> velocity_;  // W r
    // By contact: what its law keeps of W_ii, the inverse of a block for Coulomb, say.
    Column<Prepared<Law, Dim>> prepared_;
};

}  // namespace talus
