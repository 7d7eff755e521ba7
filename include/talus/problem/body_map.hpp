// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/instantiate.hpp>
#include <talus/core/model.hpp>
#include <talus/core/symmetric_eigen.hpp>
#include <talus/problem/assembled_problem.hpp>
#include <talus/problem/contact_problem.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#if TALUS_BODIES
#include <Eigen/Cholesky>
#endif

namespace talus {

namespace detail {

/// Turns a symmetric matrix into its lower Cholesky factor; what is above the diagonal stays. False
/// unless it is positive definite.
TALUS_FUNCTION bool turn_into_cholesky_factor(Eigen::MatrixXd& m);

#if TALUS_BODIES

TALUS_FUNCTION bool turn_into_cholesky_factor(Eigen::MatrixXd& m) {
    return Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>>(m).info() == Eigen::Success;
}

#endif

}  // namespace detail

/// W = B^T B with B = C^T H, M^-1 = C C^T: each contact's block of B, body by body. In these
/// coordinates every body has unit mass, and one that cannot move has no rows. What factorising
/// solvers work on: the matrices of body space, M + H D^-1 H^T, become 1 + B D^-1 B^T.
template <int Dim>
class BodyMap {
  public:
    using Block = Eigen::Matrix<double, Eigen::Dynamic, Dim, Eigen::RowMajor>;

    /// One block of B.
    struct Entry {
        int body;
        std::ptrdiff_t value;  ///< of its first number in `values`, row by row
    };

    BodyMap() = default;
    BodyMap(const ContactJacobian<Dim>& jacobian, const InverseMass<Dim>& inverse_mass) {
        assign(jacobian, inverse_mass);
    }

    void assign(const ContactJacobian<Dim>& jacobian, const InverseMass<Dim>& inverse_mass);
    /// False, and empty, if M does not fall apart into small blocks (or is not positive definite):
    /// then nothing is gained over W itself.
    bool assign(const Eigen::SparseMatrix<double>& mass,
                const Eigen::SparseMatrix<double>& contact_map);

    std::size_t contact_count() const { return entry_begin_.empty() ? 0 : entry_begin_.size() - 1; }
    /// Rows of B of each body.
    std::span<const int> body_sizes() const { return size_; }
    int rows() const { return offset_.empty() ? 0 : offset_.back(); }
    int offset(int body) const { return offset_[static_cast<std::size_t>(body)]; }
    /// The blocks of a contact.
    std::span<const Entry> entries(std::size_t contact) const {
        return std::span(entry_).subspan(entry_begin_[contact],
                                         entry_begin_[contact + 1] - entry_begin_[contact]);
    }
    Eigen::Map<const Block> block(const Entry& e) const {
        return {values_.data() + e.value, size_[static_cast<std::size_t>(e.body)], Dim};
    }

    /// v = B r, with the components of r contact after contact.
    void to_bodies(const Eigen::VectorXd& r, Eigen::VectorXd& v) const {
        v.setZero(rows());
        for (std::size_t c = 0; c < contact_count(); ++c) {
            const double* const x = r.data() + first(c);
            for (const Entry& e : entries(c)) {
                double* const y = v.data() + offset(e.body);
                for_rows(e, [=](int k, const double* row) {
                    double sum = row[0] * x[0];
                    for (int d = 1; d < Dim; ++d) sum += row[d] * x[d];
                    y[k] += sum;
                });
            }
        }
    }
    /// u = B^T v.
    void to_contacts(const Eigen::VectorXd& v, Eigen::VectorXd& u) const {
        u.resize(static_cast<Eigen::Index>(Dim * contact_count()));
        for (std::size_t c = 0; c < contact_count(); ++c) {
            Vector<Dim> sum = Vector<Dim>::Zero();
            for (const Entry& e : entries(c)) {
                const double* const x = v.data() + offset(e.body);
                for_rows(e, [&](int k, const double* row) {
                    for (int d = 0; d < Dim; ++d) sum[d] += x[k] * row[d];
                });
            }
            u.template segment<Dim>(first(c)) = sum;
        }
    }
    /// Multiplies the columns of each contact by its number.
    void scale(std::span<const double> factor) {
        for (std::size_t c = 0; c < contact_count(); ++c)
            for (const Entry& e : entries(c))
                Eigen::Map<Block>(values_.data() + e.value, size_[static_cast<std::size_t>(e.body)],
                                  Dim) *= factor[c];
    }

  private:
    /// f(k, row) for the rows of a block, their count known to the compiler where it is that of a
    /// rigid body.
    template <class F>
    void for_rows(const Entry& e, F&& f) const {
        const double* row = values_.data() + e.value;
        const int rows = size_[static_cast<std::size_t>(e.body)];
        if (rows == twist_dof<Dim>)
            for (int k = 0; k < twist_dof<Dim>; ++k, row += Dim) f(k, row);
        else
            for (int k = 0; k < rows; ++k, row += Dim) f(k, row);
    }
    static Eigen::Index first(std::size_t contact) {
        return static_cast<Eigen::Index>(Dim * contact);
    }
    void clear() {
        size_.clear();
        offset_.assign(1, 0);
        entry_.clear();
        entry_begin_.assign(1, 0);
        values_.clear();
    }
    void add_entry(int body, const Block& b) {
        entry_.push_back({body, static_cast<std::ptrdiff_t>(values_.size())});
        values_.insert(values_.end(), b.data(), b.data() + b.size());
    }

    std::vector<int> size_, offset_;
    std::vector<Entry> entry_;
    std::vector<std::size_t> entry_begin_;
    std::vector<double> values_;
};

template <int Dim>
void BodyMap<Dim>::assign(const ContactJacobian<Dim>& jacobian,
                          const InverseMass<Dim>& inverse_mass) {
    clear();
    constexpr int turns = rotation_dof<Dim>;
    // C of each body: the square root of the mobility, its zero columns left out.
    std::vector<int> index(inverse_mass.body_count(), -1);
    std::vector<Eigen::Matrix<double, Eigen::Dynamic, twist_dof<Dim>>> root;
    for (std::size_t k = 0; k < index.size(); ++k) {
        const SymmetricEigen<turns> spin(inverse_mass.angular[k]);
        const Vector<Dim> along = inverse_mass.translation(k);
        const double largest = spin.values.maxCoeff();
        int translations = 0;
        for (int d = 0; d < Dim; ++d) translations += along[d] > 0.0;
        int rows = translations;
        for (int d = 0; d < turns; ++d) rows += spin.values[d] > 1e-15 * largest;
        if (rows == 0) continue;
        Eigen::Matrix<double, Eigen::Dynamic, twist_dof<Dim>> c(rows, twist_dof<Dim>);
        c.setZero();
        for (int d = 0, row = 0; d < Dim; ++d)
            if (along[d] > 0.0) c(row++, d) = std::sqrt(along[d]);
        for (int d = 0, row = translations; d < turns; ++d)
            if (spin.values[d] > 1e-15 * largest)
                c.row(row++).template tail<turns>() =
                    std::sqrt(spin.values[d]) * spin.vectors.col(d).transpose();
        index[k] = static_cast<int>(size_.size());
        size_.push_back(rows);
        offset_.push_back(offset_.back() + rows);
        root.push_back(std::move(c));
    }
    // A cell driven by a stress is one more body, each component that is driven a row.
    const int cell = static_cast<int>(size_.size());
    std::vector<std::pair<int, int>> components;
    for (int i = 0; i < Dim; ++i)
        for (int j = 0; j < Dim; ++j)
            if (inverse_mass.cell(i, j) > 0.0) components.emplace_back(i, j);
    if (jacobian.cell_lever.empty()) components.clear();
    if (!components.empty()) {
        size_.push_back(static_cast<int>(components.size()));
        offset_.push_back(offset_.back() + size_.back());
    }
    for (std::size_t i = 0; i < jacobian.contact_count(); ++i) {
        const auto side = [&](BodyIndex body, const Vector<Dim>& arm, double sign) {
            const int k = index[static_cast<std::size_t>(body)];
            if (k < 0) return;
            Eigen::Matrix<double, twist_dof<Dim>, Dim> h;
            const Matrix<Dim> axes = sign * jacobian.frame[i].transpose();
            h.template topRows<Dim>() = axes;
            h.template bottomRows<turns>() = moment_matrix<Dim>(arm) * axes;
            add_entry(k, root[static_cast<std::size_t>(k)] * h);
        };
        side(jacobian.a[i], jacobian.arm_a[i], 1.0);
        side(jacobian.b[i], jacobian.arm_b[i], -1.0);
        if (!components.empty() && !jacobian.cell_lever[i].isZero(0.0)) {
            Block block(size_.back(), Dim);
            for (int k = 0; k < size_.back(); ++k) {
                const auto [along, of] = components[static_cast<std::size_t>(k)];
                block.row(k) = -std::sqrt(inverse_mass.cell(along, of)) *
                               jacobian.cell_lever[i][of] *
                               jacobian.frame[i].col(along).transpose();
            }
            add_entry(cell, block);
        }
        entry_begin_.push_back(entry_.size());
    }
}

template <int Dim>
bool BodyMap<Dim>::assign(const Eigen::SparseMatrix<double>& mass,
                          const Eigen::SparseMatrix<double>& contact_map) {
    clear();
    constexpr std::size_t small = 12;
    const auto n = static_cast<std::size_t>(mass.rows());
    // The blocks of M: connected parts of its pattern.
    std::vector<std::size_t> leader(n);
    std::iota(leader.begin(), leader.end(), std::size_t{0});
    const auto find = [&](std::size_t i) {
        while (leader[i] != i) i = leader[i] = leader[leader[i]];
        return i;
    };
    for (Eigen::Index j = 0; j < mass.outerSize(); ++j)
        for (Eigen::SparseMatrix<double>::InnerIterator e(mass, j); e; ++e)
            if (e.value() != 0.0) {
                const std::size_t a = find(static_cast<std::size_t>(e.row())),
                                  b = find(static_cast<std::size_t>(j));
                leader[std::max(a, b)] = std::min(a, b);
            }
    std::vector<std::vector<int>> rows;
    std::vector<int> body_of(n), place(n);
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t root = find(i);
        if (root == i) {
            body_of[i] = static_cast<int>(rows.size());
            rows.emplace_back();
        }
        body_of[i] = body_of[root];
        auto& members = rows[static_cast<std::size_t>(body_of[i])];
        place[i] = static_cast<int>(members.size());
        members.push_back(static_cast<int>(i));
        if (members.size() > small) return false;
    }
    std::vector<Eigen::MatrixXd> factors;
    for (const auto& members : rows) {
        const auto size = static_cast<Eigen::Index>(members.size());
        Eigen::MatrixXd m(size, size);
        for (Eigen::Index i = 0; i < size; ++i)
            for (Eigen::Index j = 0; j < size; ++j)
                m(i, j) = mass.coeff(members[static_cast<std::size_t>(i)],
                                     members[static_cast<std::size_t>(j)]);
        if (!detail::turn_into_cholesky_factor(m)) {
            clear();
            return false;
        }
        factors.push_back(std::move(m));
        size_.push_back(static_cast<int>(size));
        offset_.push_back(offset_.back() + static_cast<int>(size));
    }
    std::vector<std::pair<int, Block>> found;
    for (Eigen::Index c = 0; c < contact_map.cols() / Dim; ++c) {
        found.clear();
        for (int d = 0; d < Dim; ++d)
            for (Eigen::SparseMatrix<double>::InnerIterator e(contact_map, Dim * c + d); e; ++e) {
                const auto row = static_cast<std::size_t>(e.row());
                const int body = body_of[row];
                auto at = std::find_if(found.begin(), found.end(),
                                       [&](const auto& f) { return f.first == body; });
                if (at == found.end()) {
                    const int size = size_[static_cast<std::size_t>(body)];
                    found.emplace_back(body, Block::Zero(size, Dim));
                    at = found.end() - 1;
                }
                at->second(place[row], d) = e.value();
            }
        for (const auto& [body, h] : found)
            add_entry(body, factors[static_cast<std::size_t>(body)]
                                .template triangularView<Eigen::Lower>()
                                .solve(h));
        entry_begin_.push_back(entry_.size());
    }
    return true;
}

/// The Delassus operator of a global problem: W assembled, for sweeps, beside the body space that
/// it comes from.
template <int Dim>
class DelassusGlobal {
  public:
    DelassusGlobal() = default;
    /// Takes W = H^T M^-1 H as `assembled` gave it, and M and H.
    DelassusGlobal(DelassusSparse<Dim> w, const Eigen::SparseMatrix<double>& mass,
                   const Eigen::SparseMatrix<double>& contact_map)
        : w_(std::move(w)) {
        has_bodies_ = bodies_.assign(mass, contact_map);
    }

    std::size_t contact_count() const { return w_.contact_count(); }
    Matrix<Dim> diagonal_block(std::size_t i) const { return w_.diagonal_block(i); }
    void multiply(std::span<const Vector<Dim>> r, std::span<Vector<Dim>> u) const {
        w_.multiply(r, u);
    }
    void start(std::span<const Vector<Dim>> r) { w_.start(r); }
    Vector<Dim> velocity(std::size_t i) const { return w_.velocity(i); }
    void add(std::size_t i, const Vector<Dim>& dr) { w_.add(i, dr); }
    void islands(std::span<std::uint32_t> label) const { w_.islands(label); }

    const DelassusSparse<Dim>& assembled() const { return w_; }
    DelassusSparse<Dim>& assembled() { return w_; }
    /// Null where M does not fall apart into bodies.
    const BodyMap<Dim>* bodies() const { return has_bodies_ ? &bodies_ : nullptr; }

  private:
    DelassusSparse<Dim> w_;
    BodyMap<Dim> bodies_;
    bool has_bodies_ = false;
};
TALUS_MODEL(SweepableDelassus<DelassusGlobal<2>, 2>);
TALUS_MODEL(SweepableDelassus<DelassusGlobal<3>, 3>);

}  // namespace talus

TALUS_IN_PLANE(class talus::BodyMap<2>)
TALUS_IN_SPACE(class talus::BodyMap<3>)
