// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/check.hpp>
#include <talus/core/column.hpp>
#include <talus/core/model.hpp>
#include <talus/problem/concepts.hpp>
#include <talus/problem/contact_problem.hpp>
#include <talus/problem/islands.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>

namespace talus {

namespace detail {

/// x, kept by itself: stops the compiler from storing it as one half of a pair of numbers. The next
/// contact of the same body loads them singly, or in other pairs, and would wait for such a store
/// to reach memory. Worth a tenth of the time of a sweep, or more (bench_kernels).
inline double unpaired(double x) {
#if defined(__GNUC__) && defined(__SSE2__)
    asm("" : "+x"(x));
#endif
    return x;
}

}  // namespace detail

/// W = H^T M^-1 H without W: it carries the body velocities v = M^-1 H r along, so that following
/// one contact's impulse costs the same however many neighbours the contact has.
///
/// `Inertia` is how a body's inverse inertia is stored: AngularMatrix<Dim> for any body, double
/// where has_scalar_inertia; the first is the oracle of the second. Contacts are read where they
/// are, in the arrays of the jacobian (in space 128 bytes each), which must outlive the operator;
/// bodies are packed in one line each (in space 64 bytes with scalar inertia: one cache line, 128
/// with a tensor), so that a sweep reads contacts as a stream. The arithmetic is written out by
/// components: packed in pairs, vectors of three cost more in shuffles and waits than they save.
///
/// `Rows` of a contact: those of space, or the rolling ones as well (rows_with_rolling); the
/// jacobian then has their lengths.
template <int Dim, class Inertia = AngularMatrix<Dim>, int Rows = Dim>
requires(std::same_as<Inertia, AngularMatrix<Dim>> || std::same_as<Inertia, double>) &&
    (Rows == Dim || Rows == rows_with_rolling<Dim>)class DelassusProduct {
    /// A cell that a stress drives comes with tensors in space. In the plane, where they are
    /// numbers as well, there is one operator for all problems.
    static constexpr bool in_plane = rotation_dof<Dim> == 1;
    static constexpr bool takes_cells = in_plane || !std::same_as<Inertia, double>;
    static constexpr bool asks_for_cells = in_plane && std::same_as<Inertia, double>;

  public:
    DelassusProduct() = default;
    DelassusProduct(const ContactJacobian<Dim>& jacobian, const InverseMass<Dim>& inverse_mass) {
        assign(jacobian, inverse_mass);
    }
    DelassusProduct(ContactJacobian<Dim>&&, const InverseMass<Dim>&) = delete;

    /// Takes a new problem in, at zero impulses, keeping a reference to `jacobian`. Allocates only
    /// if there are more bodies than ever before.
    void assign(const ContactJacobian<Dim>& jacobian, const InverseMass<Dim>& inverse_mass) {
        jacobian_ = &jacobian;
        const std::size_t count = inverse_mass.body_count();
        bodies_.resize(count + (jacobian.cell_lever.empty() ? 0 : std::size_t{Dim}));
        for (std::size_t k = 0; k < count; ++k) {
            if constexpr (std::same_as<Mobility, double>)
                bodies_[k].inverse_mass = inverse_mass.linear[k];
            else
                bodies_[k].inverse_mass = inverse_mass.translation(k);
            if constexpr (std::same_as<Inertia, double>)
                bodies_[k].inverse_inertia = inverse_mass.angular[k](0, 0);
            else
                bodies_[k].inverse_inertia = inverse_mass.angular[k];
            bodies_[k].linear.setZero();
            bodies_[k].angular.setZero();
        }
        driven_ = !jacobian.cell_lever.empty();
        TALUS_CHECK(takes_cells || !driven_, "driven cells come with tensors");
        if constexpr (takes_cells)
            if (driven_) assign_cell(inverse_mass);
    }

    std::size_t contact_count() const {
        return jacobian_ == nullptr ? 0 : jacobian_->contact_count();
    }

    /// W_ii, exactly symmetric.
    Matrix<Rows> diagonal_block(std::size_t i) const {
        const Row c = row(i);
        if constexpr (rolls) {
            const Matrix<Rows> w = rolling_block(i, c);
            return 0.5 * (w + w.transpose());
        } else {
            const Matrix<Dim> w = block_of_space(i, c);
            return 0.5 * (w + w.transpose());
        }
    }

    /// u = W r, for impulses that need not be the ones followed. Not for concurrent use of one
    /// operator: the body velocities it needs are kept from call to call.
    void multiply(std::span<const Vector<Rows>> r, std::span<Vector<Rows>> u) const {
        TALUS_CHECK(r.size() == contact_count(), "one impulse per contact");
        TALUS_CHECK(u.size() == contact_count(), "one velocity per contact");
        scratch_ = bodies_;
        accumulate(r, scratch_);
        for (std::size_t i = 0; i < contact_count(); ++i) u[i] = velocity(i, scratch_);
    }

    /// Writes to label[i] a number below contact_count() that contact i shares with the contacts
    /// that chains of free bodies, and a driven cell, connect with it, and with no other. Not for
    /// concurrent use of one operator.
    void islands(std::span<std::uint32_t> label) const {
        const auto free = [&](BodyIndex k) {
            const Body& x = bodies_[static_cast<std::size_t>(k)];
            bool moves = false;
            for (int d = 0; d < Dim; ++d) moves = moves || along(x, d) > 0.0;
            if constexpr (std::same_as<Inertia, double>)
                return moves || x.inverse_inertia > 0.0;
            else
                return moves || !x.inverse_inertia.is_zero();
        };
        islands_.reset(bodies_.size());
        for (std::size_t i = 0; i < contact_count(); ++i)
            if (free(row(i).a) && free(row(i).b))
                islands_.join(static_cast<std::size_t>(row(i).a),
                              static_cast<std::size_t>(row(i).b));
        // What an impulse of contact i moves: one of the bodies or, behind them, the driven cell.
        const std::size_t count = bodies_.size();
        const auto pushes_cell = [&](std::size_t i) {
            return driven_ && !jacobian_->cell_lever[i].isZero(0.0);
        };
        const auto moved = [&](std::size_t i) {
            if (free(row(i).a)) return static_cast<std::size_t>(row(i).a);
            if (free(row(i).b)) return static_cast<std::size_t>(row(i).b);
            return pushes_cell(i) ? count - 1 : count;
        };
        for (std::size_t i = 0; driven_ && i < contact_count(); ++i)
            if (pushes_cell(i)) islands_.join(moved(i), count - 1);
        first_contact_.assign(count, none);
        for (std::size_t i = 0; i < contact_count(); ++i) {
            label[i] = static_cast<std::uint32_t>(i);
            if (moved(i) == count) continue;
            std::uint32_t& first = first_contact_[islands_.root(moved(i))];
            if (first == none) first = label[i];
            label[i] = first;
        }
    }

    /// Velocities of the impulses `r`, computed afresh.
    void start(std::span<const Vector<Rows>> r) {
        TALUS_CHECK(r.size() == contact_count(), "one impulse per contact");
        accumulate(r, bodies_);
    }

    /// Row i of W r for the present impulses [m/s].
    [[gnu::always_inline]] Vector<Rows> velocity(std::size_t i) const {
        return velocity(i, bodies_);
    }

    /// r_i += dr.
    [[gnu::always_inline]] void add(std::size_t i, const Vector<Rows>& dr) { add(i, dr, bodies_); }

    /// What sweeps visit where no stress drives a cell. To ask for one at every visit of a contact
    /// costs a tenth of a sweep.
    class WithoutCell {
      public:
        explicit WithoutCell(DelassusProduct& w) : w_(w) {}
        [[gnu::always_inline]] Vector<Rows> velocity(std::size_t i) const {
            return DelassusProduct::velocity(w_.row(i), w_.bodies_);
        }
        [[gnu::always_inline]] void add(std::size_t i, const Vector<Rows>& dr) const {
            DelassusProduct::add(w_.row(i), dr, w_.bodies_);
        }

      private:
        DelassusProduct& w_;
    };
    WithoutCell without_cell() requires(asks_for_cells) { return WithoutCell(*this); }
    bool has_driven_cell() const { return driven_; }

  private:
    static constexpr bool rolls = Rows != Dim;
    struct Row {
        const Matrix<Dim>& frame;
        const Vector<Dim>&arm_a, &arm_b;
        BodyIndex a, b;
        double rolling_length = 0.0;
    };
    [[gnu::always_inline]] Row row(std::size_t i) const {
        const ContactJacobian<Dim>& j = *jacobian_;
        if constexpr (rolls)
            return {j.frame[i], j.arm_a[i], j.arm_b[i], j.a[i], j.b[i], j.rolling_length[i]};
        else
            return {j.frame[i], j.arm_a[i], j.arm_b[i], j.a[i], j.b[i]};
    }
    /// Axes are locked in the plane, where there is room for it, and beside tensors.
    using Mobility =
        std::conditional_t<std::same_as<Inertia, double> && !in_plane, double, Vector<Dim>>;
    struct Body {
        Vector<Dim> linear;
        AngularVector<Dim> angular;
        Mobility inverse_mass;
        Inertia inverse_inertia;
    };
    /// The columns of the velocity gradient of a driven cell stand behind the bodies.
    template <class List>
    static auto& cell_column(List& bodies, int j) {
        return bodies[bodies.size() - static_cast<std::size_t>(Dim - j)];
    }
    void assign_cell(const InverseMass<Dim>& inverse_mass) {
        for (int j = 0; j < Dim; ++j) {
            Body& x = cell_column(bodies_, j);
            if constexpr (takes_cells)
                for (int d = 0; d < Dim; ++d) x.inverse_mass[d] = inverse_mass.cell(d, j);
            x.inverse_inertia = Inertia{};
            x.linear.setZero();
            x.angular.setZero();
        }
    }
    static double along(const Body& x, int d) {
        if constexpr (std::same_as<Mobility, double>)
            return x.inverse_mass;
        else
            return x.inverse_mass[d];
    }

    /// The rows of space of W_ii.
    Matrix<Dim> block_of_space(std::size_t i, const Row& c) const {
        Matrix<Dim> world = Matrix<Dim>::Zero();
        for (const auto& [body, arm] : {std::pair{c.a, c.arm_a}, std::pair{c.b, c.arm_b}}) {
            const Body& x = bodies_[static_cast<std::size_t>(body)];
            const SmallMatrix<rotation_dof<Dim>, Dim> lever = moment_matrix<Dim>(arm);
            Matrix<Dim> mobility = Matrix<Dim>::Zero();
            for (int d = 0; d < Dim; ++d) mobility(d, d) = along(x, d);
            world += mobility + lever.transpose() * (x.inverse_inertia * lever);
        }
        if (driven_)
            for (int j = 0; j < Dim; ++j)
                for (int d = 0; d < Dim; ++d)
                    world(d, d) += jacobian_->cell_lever[i][j] * jacobian_->cell_lever[i][j] *
                                   along(cell_column(bodies_, j), d);
        return c.frame * world * c.frame.transpose();
    }
    Matrix<Rows> rolling_block(std::size_t i, const Row& c) const {
        const auto axes = (c.rolling_length * rolling_axes<Dim>(c.frame)).eval();
        Matrix<Rows> w;
        w.setZero();
        w.template topLeftCorner<Dim, Dim>() = block_of_space(i, c);
        for (const auto& [body, arm] : {std::pair{c.a, c.arm_a}, std::pair{c.b, c.arm_b}}) {
            const Body& x = bodies_[static_cast<std::size_t>(body)];
            const auto turn = (x.inverse_inertia * axes.transpose()).eval();  // by unit moments
            const auto shift = (c.frame * moment_matrix<Dim>(arm).transpose() * turn).eval();
            w.template topRightCorner<Dim, Dim - 1>() += shift;
            w.template bottomLeftCorner<Dim - 1, Dim>() += shift.transpose();
            w.template bottomRightCorner<Dim - 1, Dim - 1>() += axes * turn;
        }
        return w;
    }

    [[gnu::always_inline]] static Vector<Rows> velocity(const Row& c, const Column<Body>& bodies) {
        const Body& a = bodies[static_cast<std::size_t>(c.a)];
        const Body& b = bodies[static_cast<std::size_t>(c.b)];
        const Vector<Dim> turning_a = cross<Dim>(a.angular, c.arm_a);
        const Vector<Dim> turning_b = cross<Dim>(b.angular, c.arm_b);
        Vector<Dim> world;
        Vector<Rows> u;
        for (int d = 0; d < Dim; ++d)
            world[d] = (a.linear[d] - b.linear[d]) + (turning_a[d] - turning_b[d]);
        for (int k = 0; k < Dim; ++k) {
            u[k] = c.frame(k, 0) * world[0];
            for (int d = 1; d < Dim; ++d) u[k] += c.frame(k, d) * world[d];
        }
        if constexpr (rolls)
            u.template tail<Dim - 1>() =
                c.rolling_length * (rolling_axes<Dim>(c.frame) * (a.angular - b.angular));
        return u;
    }
    [[gnu::always_inline]] static void add(const Row& c, const Vector<Rows>& dr,
                                           Column<Body>& bodies) {
        Vector<Dim> impulse;
        for (int d = 0; d < Dim; ++d) {
            impulse[d] = c.frame(0, d) * dr[0];
            for (int k = 1; k < Dim; ++k) impulse[d] += c.frame(k, d) * dr[k];
        }
        if constexpr (rolls) {
            const AngularVector<Dim> rolling = couple(c, dr);
            push(bodies[static_cast<std::size_t>(c.a)], 1.0, impulse, c.arm_a, &rolling);
            push(bodies[static_cast<std::size_t>(c.b)], -1.0, impulse, c.arm_b, &rolling);
        } else {
            push(bodies[static_cast<std::size_t>(c.a)], 1.0, impulse, c.arm_a);
            push(bodies[static_cast<std::size_t>(c.b)], -1.0, impulse, c.arm_b);
        }
    }
    // A driven cell stands apart and out of line: few have one, and contacts are visited often.
    [[gnu::always_inline]] Vector<Rows> velocity(std::size_t i, const Column<Body>& bodies) const {
        Vector<Rows> u = velocity(row(i), bodies);
        if constexpr (takes_cells)
            if (driven_) subtract_cell(i, bodies, u);
        return u;
    }
    [[gnu::noinline]] void subtract_cell(std::size_t i, const Column<Body>& bodies,
                                         Vector<Rows>& u) const {
        const Vector<Dim>& lever = jacobian_->cell_lever[i];
        Vector<Dim> world = Vector<Dim>::Zero();
        for (int j = 0; j < Dim; ++j) world += lever[j] * cell_column(bodies, j).linear;
        u.template head<Dim>() -= row(i).frame * world;
    }
    [[gnu::always_inline]] void add(std::size_t i, const Vector<Rows>& dr,
                                    Column<Body>& bodies) const {
        add(row(i), dr, bodies);
        if constexpr (takes_cells)
            if (driven_) add_to_cell(i, dr, bodies);
    }
    [[gnu::noinline]] void add_to_cell(std::size_t i, const Vector<Rows>& dr,
                                       Column<Body>& bodies) const {
        const Vector<Dim>& lever = jacobian_->cell_lever[i];
        const Vector<Dim> impulse = row(i).frame.transpose() * Vector<Dim>(dr.template head<Dim>());
        for (int j = 0; j < Dim; ++j) {
            Body& x = cell_column(bodies, j);
            for (int d = 0; d < Dim; ++d) x.linear[d] -= along(x, d) * lever[j] * impulse[d];
        }
    }
    /// The moment impulse of rolling friction, world axes.
    static AngularVector<Dim> couple(const Row& c, const Vector<Rows>& dr) {
        const Vector<Dim - 1> rolling = c.rolling_length * dr.template tail<Dim - 1>();
        return rolling_axes<Dim>(c.frame).transpose() * rolling;
    }
    /// Component d of I^-1 m. By components, for the same reason as `unpaired`.
    static double turned(const Body& x, const AngularVector<Dim>& moment, int d) {
        if constexpr (std::same_as<Inertia, double>) {
            return x.inverse_inertia * moment[d];
        } else {
            double sum = x.inverse_inertia(d, 0) * moment[0];
            for (int k = 1; k < rotation_dof<Dim>; ++k) sum += x.inverse_inertia(d, k) * moment[k];
            return sum;
        }
    }
    [[gnu::always_inline]] static void push(
        Body& x, double sign, const Vector<Dim>& impulse, const Vector<Dim>& arm,
        [[maybe_unused]] const AngularVector<Dim>* rolling = nullptr) {
        AngularVector<Dim> turn = moment<Dim>(arm, impulse);
        if constexpr (rolls) turn += *rolling;
        for (int d = 0; d < Dim; ++d)
            x.linear[d] = detail::unpaired(x.linear[d] + (sign * along(x, d)) * impulse[d]);
        for (int d = 0; d < rotation_dof<Dim>; ++d)
            x.angular[d] = detail::unpaired(x.angular[d] + sign * turned(x, turn, d));
    }
    void accumulate(std::span<const Vector<Rows>> r, Column<Body>& bodies) const {
        for (Body& x : bodies) {
            x.linear.setZero();
            x.angular.setZero();
        }
        for (std::size_t i = 0; i < contact_count(); ++i) add(i, r[i], bodies);
    }

    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    const ContactJacobian<Dim>* jacobian_ = nullptr;
    bool driven_ = false;  // the cell, by a stress
    Column<Body> bodies_;
    mutable Column<Body> scratch_;
    mutable Islands islands_;
    mutable Column<std::uint32_t> first_contact_;
};
TALUS_MODEL(SweepableDelassus<DelassusProduct<2>, 2>);
TALUS_MODEL(SweepableDelassus<DelassusProduct<3>, 3>);
TALUS_MODEL(SweepableDelassus<DelassusProduct<3, double>, 3>);
TALUS_MODEL(SweepableDelassus<DelassusProduct<2, double, 3>, 3>);

}  // namespace talus
