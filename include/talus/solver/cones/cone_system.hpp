// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/instantiate.hpp>
#include <talus/law/friction_cone.hpp>
#include <talus/linear/block_lu.hpp>
#include <talus/problem/body_map.hpp>
#include <talus/problem/residual.hpp>

#include <Eigen/Core>
#include <Eigen/LU>

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace talus {

/// Cost of a sweep over an assembled W, in visits of a contact by a sweep over the contacts of two
/// bodies: five blocks make one.
template <int Dim>
double sweep_visits(const DelassusSparse<Dim>& w) {
    return 0.5 * static_cast<double>(w.contact_count()) +
           0.2 * static_cast<double>(w.block_count());
}

/// A contact problem as the solvers see it that treat all contacts at once:  u = W r + q  with a
/// friction cone at each contact, in scaled units: impulses are divided and velocities multiplied
/// by sqrt(rho_c), rho_c the effective mass of ResidualMeasure. Both become square roots of
/// energies, each W_cc has the trace Dim, cones stay what they are, and the residual is the plain
/// distance to the natural map of step 1.
///
/// It can also solve (W + D) x = b for any block-diagonal D with a positive definite symmetric
/// part: in contact space from the blocks of W, or, where W = B^T B is known, in body space,
///   x = D^-1 (b - B^T y),  (1 + B D^-1 B^T) y = B D^-1 b,
/// where the matrix has a block per body, however many contacts it has.
template <int Dim>
class ConeSystem {
  public:
    using Vec = Eigen::VectorXd;

    /// Takes a problem in. `measure` must have been prepared with the same W.
    void assign(const DelassusSparse<Dim>& w, std::span<const Vector<Dim>> free_velocity,
                std::vector<FrictionCone<Dim>> cones, const ResidualMeasure<Dim>& measure);
    void assign(BodyMap<Dim> bodies, std::span<const Vector<Dim>> free_velocity,
                std::vector<FrictionCone<Dim>> cones, const ResidualMeasure<Dim>& measure);

    std::size_t contact_count() const { return cones_.size(); }
    const FrictionCone<Dim>& cone(std::size_t c) const { return cones_[c]; }
    const Vec& free_velocity() const { return q_; }  ///< q, scaled [sqrt(J)]
    static Eigen::Index first(std::size_t c) { return static_cast<Eigen::Index>(Dim * c); }

    /// u = W r.
    void multiply(const Vec& r, Vec& u) const;

    /// What W is made of: B, or null where only the blocks of W are known; then these, row by row.
    const BodyMap<Dim>* bodies() const { return in_body_space_ ? &bodies_ : nullptr; }
    std::span<const std::size_t> columns(std::size_t i) const {
        return std::span(column_).subspan(row_begin_[i], row_begin_[i + 1] - row_begin_[i]);
    }
    /// The block of column number k of `columns(i)`.
    Eigen::Map<const Matrix<Dim>> row_block(std::size_t i, std::size_t k) const {
        return block(row_begin_[i] + k);
    }

    void to_scaled(std::span<const Vector<Dim>> r, Vec& scaled) const {
        scaled.resize(q_.size());
        for (std::size_t c = 0; c < r.size(); ++c)
            scaled.template segment<Dim>(first(c)) = r[c] / scale_[c];
    }
    void to_impulses(const Vec& scaled, std::span<Vector<Dim>> r) const {
        for (std::size_t c = 0; c < r.size(); ++c)
            r[c] = scaled.template segment<Dim>(first(c)) * scale_[c];
    }

    /// The residual of ResidualMeasure at r, with u = W r + q. Of the whole alone if the measure
    /// was given W alone.
    double residual(const Vec& r, const Vec& u) const;

    /// What a component of u may be off at a residual of 1, at the contact where that is least
    /// [sqrt(J)].
    double finest_scale() const { return finest_scale_; }

    /// What one factorisation and its solves cost, in visits of a contact by a sweep over the
    /// contacts of two bodies (some 30 ns): an estimate from the factor's structure, the same on
    /// any machine.
    double factorization_cost() {
        analyze();
        return lu_.operations() / 120.0 + 10.0 * static_cast<double>(lu_.front_count()) +
               static_cast<double>(slots_.size());
    }
    /// Memory that a factorisation takes [bytes].
    double factorization_bytes() {
        analyze();
        return lu_.bytes();
    }
    /// Factorises W + D. False if that fails.
    bool factorize(std::span<const Matrix<Dim>> d);
    /// x with (W + D) x = b, refined until the error is rounding (at most `refinements` times).
    void solve(const Vec& b, Vec& x, int refinements = 2);

  private:
    using Small = Matrix<Dim>;
    void set_common(std::span<const Vector<Dim>> free_velocity,
                    std::vector<FrictionCone<Dim>> cones, const ResidualMeasure<Dim>& measure);
    void analyze();
    void solve_once(const Vec& b, Vec& x);
    void apply_inverse(const Vec& b, Vec& x) const;

    std::vector<FrictionCone<Dim>> cones_;
    std::vector<double> scale_;      ///< sqrt(rho_c)
    mutable ContactScales islands_;  ///< of the measure; written by every look at it
    double finest_scale_ = 0.0;
    Vec q_;
    bool in_body_space_ = false;
    bool analyzed_ = false;
    // Contact space: blocks of W by rows.
    std::vector<std::size_t> row_begin_, column_;
    std::vector<double> value_;  ///< column by column, and one number more
    Eigen::Map<const Small> block(std::size_t k) const {
        return Eigen::Map<const Small>(value_.data() + Dim * Dim * k);
    }
    // Products with blocks, four numbers at a time. In the plane these are two columns, to be added
    // up at the end; in space a column and a number of the next one, which is dropped.
    using Four = Eigen::Vector4d;
    static void add_product(const double* block, Eigen::Map<const Vector<2>> x, Four& sum) {
        sum += Eigen::Map<const Four>(block).cwiseProduct(Four(x[0], x[0], x[1], x[1]));
    }
    static void add_product(const double* block, Eigen::Map<const Vector<3>> x, Four& sum) {
        for (int column = 0; column < 3; ++column)
            sum += x[column] * Eigen::Map<const Four>(block + 3 * column);
    }
    static void fold(const Four& sum, Eigen::Map<Vector<2>> u) {
        u = sum.head<2>() + sum.tail<2>();
    }
    static void fold(const Four& sum, Eigen::Map<Vector<3>> u) { u = sum.head<3>(); }
    // Body space.
    BodyMap<Dim> bodies_;
    mutable Vec v_;  ///< velocities of bodies, of the product in hand

    BlockLu lu_;  ///< of W + D, or of 1 + B D^-1 B^T
    std::vector<std::pair<int, int>> edges_, last_edges_;
    std::vector<int> sizes_, last_sizes_;
    std::vector<int> slots_;            ///< of lu_, in the order in which `factorize` adds to them
    std::vector<Small> d_, d_inverse_;  ///< of the matrix factorised
    Vec left_, correction_, error_, body_right_;
};

template <int Dim>
void ConeSystem<Dim>::set_common(std::span<const Vector<Dim>> free_velocity,
                                 std::vector<FrictionCone<Dim>> cones,
                                 const ResidualMeasure<Dim>& measure) {
    cones_ = std::move(cones);
    islands_ = measure.scales();
    scale_.resize(cones_.size());
    q_.resize(static_cast<Eigen::Index>(Dim * cones_.size()));
    for (std::size_t c = 0; c < cones_.size(); ++c) {
        scale_[c] = std::sqrt(measure.effective_mass(c));
        q_.template segment<Dim>(first(c)) = scale_[c] * free_velocity[c];
    }
    finest_scale_ = std::numeric_limits<double>::infinity();
    if (islands_.contact_count() == contact_count())
        for (std::size_t c = 0; c < cones_.size(); ++c)
            finest_scale_ = std::min(finest_scale_,
                                     scale_[c] * islands_.velocity(c) / Residual::share_of_contact);
    analyzed_ = false;
}

template <int Dim>
void ConeSystem<Dim>::assign(const DelassusSparse<Dim>& w,
                             std::span<const Vector<Dim>> free_velocity,
                             std::vector<FrictionCone<Dim>> cones,
                             const ResidualMeasure<Dim>& measure) {
    set_common(free_velocity, std::move(cones), measure);
    in_body_space_ = false;
    row_begin_.assign(1, 0);
    column_.clear();
    value_.clear();
    column_.reserve(w.block_count());
    value_.reserve(Dim * Dim * w.block_count() + 1);
    for (std::size_t i = 0; i < contact_count(); ++i) {
        const auto columns = w.columns(i);
        const auto blocks = w.blocks(i);
        for (std::size_t k = 0; k < columns.size(); ++k) {
            column_.push_back(columns[k]);
            // S W S, with S the square roots of the effective masses.
            const Small block = scale_[i] * scale_[columns[k]] * blocks[k];
            value_.insert(value_.end(), block.data(), block.data() + block.size());
        }
        row_begin_.push_back(column_.size());
    }
    // Products read four numbers at a time, one beyond the last block in space.
    value_.push_back(0.0);
}

template <int Dim>
void ConeSystem<Dim>::assign(BodyMap<Dim> bodies, std::span<const Vector<Dim>> free_velocity,
                             std::vector<FrictionCone<Dim>> cones,
                             const ResidualMeasure<Dim>& measure) {
    set_common(free_velocity, std::move(cones), measure);
    in_body_space_ = true;
    bodies_ = std::move(bodies);
    bodies_.scale(scale_);
}

template <int Dim>
void ConeSystem<Dim>::multiply(const Vec& r, Vec& u) const {
    if (in_body_space_) {
        bodies_.to_bodies(r, v_);
        bodies_.to_contacts(v_, u);
        return;
    }
    u.resize(q_.size());
    for (std::size_t i = 0; i < contact_count(); ++i) {
        Four sum = Four::Zero();
        for (std::size_t k = row_begin_[i]; k < row_begin_[i + 1]; ++k)
            add_product(value_.data() + Dim * Dim * k,
                        Eigen::Map<const Vector<Dim>>(r.data() + Dim * column_[k]), sum);
        fold(sum, Eigen::Map<Vector<Dim>>(u.data() + Dim * i));
    }
}

template <int Dim>
double ConeSystem<Dim>::residual(const Vec& r, const Vec& u) const {
    const bool by_contacts = islands_.contact_count() == contact_count();
    double sum = 0.0;
    islands_.begin();
    for (std::size_t c = 0; c < contact_count(); ++c) {
        const Vector<Dim> rc = r.template segment<Dim>(first(c));
        const Vector<Dim> corrected =
            de_saxce_corrected<Dim>(u.template segment<Dim>(first(c)), cones_[c].mu);
        const double error = (rc - cones_[c].project(rc - corrected)).squaredNorm();
        sum += error;
        const double mass = scale_[c] * scale_[c];
        if (!by_contacts) continue;
        const double steep = cones_[c].steep_error(u.template segment<Dim>(first(c)), rc, 1.0);
        islands_.see(c, std::max(error, steep * steep) / mass, rc.squaredNorm() / mass);
    }
    // 0 / 0 is solved; a problem at rest without impulses has no scale to be wrong by.
    const double scale = std::max(r.norm(), q_.norm());
    Residual result;
    if (sum != 0.0) result.whole = scale == 0.0 ? 1.0 : std::sqrt(sum) / scale;
    if (by_contacts) islands_.judge(result);
    result.combine();
    return result.relative;
}

template <int Dim>
bool ConeSystem<Dim>::factorize(std::span<const Matrix<Dim>> d) {
    d_.assign(d.begin(), d.end());
    analyze();
    lu_.set_zero();
    if (!in_body_space_) {
        for (std::size_t i = 0; i < contact_count(); ++i)
            for (std::size_t k = row_begin_[i]; k < row_begin_[i + 1]; ++k) {
                auto to = lu_.block(slots_[k]);
                to += block(k);
                if (column_[k] == i) to += d_[i];
            }
        return lu_.factorize();
    }
    for (int k = 0; k < static_cast<int>(bodies_.body_sizes().size()); ++k)
        lu_.block(lu_.slot(k, k)).diagonal().setOnes();
    // 1 + sum over contacts of B_c D_c^-1 B_c^T. D is regular: its symmetric part is positive.
    d_inverse_.resize(contact_count());
    std::size_t slot = 0;
    for (std::size_t c = 0; c < contact_count(); ++c) {
        d_inverse_[c] = d_[c].inverse();
        for (const auto& a : bodies_.entries(c)) {
            const Eigen::Matrix<double, Eigen::Dynamic, Dim> left =
                bodies_.block(a) * d_inverse_[c];
            for (const auto& b : bodies_.entries(c))
                lu_.block(slots_[slot++]).noalias() += left * bodies_.block(b).transpose();
        }
    }
    return lu_.factorize();
}

/// Orders and places what factorize fills, when first needed. The order is kept as long as problems
/// of the same pattern follow each other.
template <int Dim>
void ConeSystem<Dim>::analyze() {
    if (analyzed_) return;
    analyzed_ = true;
    const auto index = [](std::size_t i) { return static_cast<int>(i); };
    edges_.clear();
    if (in_body_space_) {
        for (std::size_t c = 0; c < contact_count(); ++c)
            for (const auto& a : bodies_.entries(c))
                for (const auto& b : bodies_.entries(c))
                    if (a.body != b.body) edges_.emplace_back(a.body, b.body);
        sizes_.assign(bodies_.body_sizes().begin(), bodies_.body_sizes().end());
    } else {
        for (std::size_t i = 0; i < contact_count(); ++i)
            for (std::size_t k = row_begin_[i]; k < row_begin_[i + 1]; ++k)
                if (column_[k] != i) edges_.emplace_back(index(i), index(column_[k]));
        sizes_.assign(contact_count(), Dim);
    }
    // The order costs as much as some factorisations, and patterns change seldom.
    if (lu_.size() == 0 || edges_ != last_edges_ || sizes_ != last_sizes_) {
        lu_.analyze(sizes_, edges_);
        last_edges_ = edges_;
        last_sizes_ = sizes_;
    }
    slots_.clear();
    if (in_body_space_) {
        for (std::size_t c = 0; c < contact_count(); ++c)
            for (const auto& a : bodies_.entries(c))
                for (const auto& b : bodies_.entries(c)) slots_.push_back(lu_.slot(a.body, b.body));
        return;
    }
    for (std::size_t i = 0; i < contact_count(); ++i)
        for (std::size_t k = row_begin_[i]; k < row_begin_[i + 1]; ++k)
            slots_.push_back(lu_.slot(index(i), index(column_[k])));
}

template <int Dim>
void ConeSystem<Dim>::apply_inverse(const Vec& b, Vec& x) const {
    x.resize(b.size());
    for (std::size_t c = 0; c < contact_count(); ++c)
        x.template segment<Dim>(first(c)).noalias() =
            d_inverse_[c] * b.template segment<Dim>(first(c));
}

template <int Dim>
void ConeSystem<Dim>::solve_once(const Vec& b, Vec& x) {
    if (!in_body_space_) {
        x = b;
        lu_.solve(x);
        return;
    }
    apply_inverse(b, x);
    bodies_.to_bodies(x, body_right_);
    lu_.solve(body_right_);
    bodies_.to_contacts(body_right_, left_);
    left_ = b - left_;
    apply_inverse(left_, x);
}

template <int Dim>
void ConeSystem<Dim>::solve(const Vec& b, Vec& x, int refinements) {
    solve_once(b, x);
    if (refinements == 0) return;
    Vec& error = error_;
    double last = std::numeric_limits<double>::infinity();
    for (int k = 0; k < refinements; ++k) {
        multiply(x, error);
        for (std::size_t c = 0; c < contact_count(); ++c)
            error.template segment<Dim>(first(c)).noalias() +=
                d_[c] * x.template segment<Dim>(first(c));
        error = b - error;
        // Stops where an error did not halve: what is left is rounding in the error itself.
        const double size = error.norm();
        if (!(size < 0.5 * last) || size <= 1e-15 * b.norm()) return;
        last = size;
        solve_once(error, correction_);
        x += correction_;
    }
}

}  // namespace talus

TALUS_IN_PLANE(class talus::ConeSystem<2>)
TALUS_IN_SPACE(class talus::ConeSystem<3>)
