// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/ids.hpp>
#include <talus/core/input.hpp>
#include <talus/core/matrix_functions.hpp>
#include <talus/core/number_record.hpp>
#include <talus/core/types.hpp>
#include <talus/dynamics/reduced_lattice.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

namespace talus {

/// A periodic cell: every body of a system has images, shifted by whole numbers of the lattice
/// vectors, and touches the images of others. The cell deforms at the rate L, its velocity
/// gradient: lattice vectors move as dH/dt = L H, and an image shifted by s moves by L s faster
/// than its body. Of all images of a body the one at home, in the cell at the origin, moves as
/// bodies do, by what pushes it alone; the others follow, accelerated by (dL/dt + L^2) s. Positions
/// are never wrapped: a body that has left the home is itself an image of the one there and is
/// moved so (cell_home.hpp), and it makes no difference which image of it is the body. In simple
/// shear L^2 = 0, and no step changes the velocity of those who touch nobody ([LeesEdwards1972] say
/// the same with wrapped positions).
///
///     sim.system().set_cell(PeriodicCell<3>::box({0.1, 0.1, 0.1}));
///     Matrix<3> simple_shear = Matrix<3>::Zero();
///     simple_shear(0, 2) = 0.5;                          // [1/s]
///     sim.system().set_velocity_gradient(simple_shear);  // from now on
template <int Dim>
requires SpaceDimension<Dim>
class PeriodicCell {
  public:
    using Directions = typename ReducedLattice<Dim>::Directions;
    using Steps = typename ReducedLattice<Dim>::Steps;
    static constexpr Directions all_directions() {
        Directions all{};
        for (bool& one : all) one = true;
        return all;
    }
    /// Of the unit parallelepiped the cell must have so much volume, over the product of its sides:
    /// a shear of up to a million [-].
    static constexpr double least_volume = 1e-6;

    /// Columns of `lattice` are the lattice vectors [m]. Along those that are not periodic there
    /// are no images; they count for the volume alone. Throws input_error unless lattice vectors
    /// are finite, right-handed and span a volume, and the velocity gradient [1/s] is finite.
    explicit PeriodicCell(const Matrix<Dim>& lattice,
                          const Matrix<Dim>& velocity_gradient = Matrix<Dim>::Zero(),
                          const Directions& periodic = all_directions())
        : periodic_(periodic) {
        set_lattice(lattice);
        set_velocity_gradient(velocity_gradient);
    }
    /// A box of these sides [m] along the axes.
    static PeriodicCell box(const Vector<Dim>& sides,
                            const Directions& periodic = all_directions()) {
        Matrix<Dim> lattice = Matrix<Dim>::Zero();
        for (int k = 0; k < Dim; ++k)
            lattice(k, k) = require_positive("side of the cell", sides[k]);
        return PeriodicCell(lattice, Matrix<Dim>::Zero(), periodic);
    }

    const Matrix<Dim>& lattice() const { return lattice_; }         ///< H, columns [m]
    const Matrix<Dim>& velocity_gradient() const { return rate_; }  ///< L [1/s]
    const Directions& periodic() const { return periodic_; }
    double volume() const { return inverted(lattice_).determinant; }  ///< [m^Dim]

    void set_lattice(const Matrix<Dim>& lattice) {
        require_finite("lattice vectors of the cell", lattice);
        double sides = 1.0;
        for (int k = 0; k < Dim; ++k)
            sides *= require_positive(detail::numbered("length of the cell's lattice vector",
                                                       static_cast<std::size_t>(k)),
                                      lattice.col(k).norm());
        const double share = inverted(lattice).determinant / sides;
        if (!(share >= least_volume))
            detail::reject("volume of the cell over the product of its sides", share,
                           "at least " + detail::text_of(least_volume) +
                               ": lattice vectors right-handed, and not all but parallel");
        lattice_ = lattice;
    }
    void set_velocity_gradient(const Matrix<Dim>& rate) {
        rate_ = require_finite("velocity gradient of the cell", rate);
    }

    /// From a body to that image of it [m].
    Vector<Dim> offset(const ImageShift& image) const {
        Steps steps{};
        std::copy_n(image.n.begin(), steps.size(), steps.begin());
        return offset(steps);
    }
    Vector<Dim> offset(const Steps& steps) const {
        Vector<Dim> sum = Vector<Dim>::Zero();
        for (int k = 0; k < Dim; ++k)
            sum += static_cast<double>(steps[static_cast<std::size_t>(k)]) *
                   Vector<Dim>(lattice_.col(k));
        return sum;
    }
    /// Of a place that moves with the cell, the origin at rest: L x [m/s].
    Vector<Dim> velocity_at(const Vector<Dim>& x) const { return rate_ * x; }
    /// The image of x [m] in the cell at the origin, lattice coordinates in [0, 1): for pictures,
    /// and to measure where things are.
    Vector<Dim> wrapped(const Vector<Dim>& x) const {
        const Vector<Dim> s = inverted(lattice_).inverse * x;
        Vector<Dim> home = x;
        for (int k = 0; k < Dim; ++k)
            if (periodic_[static_cast<std::size_t>(k)])
                home -= std::floor(s[k]) * Vector<Dim>(lattice_.col(k));
        return home;
    }
    ReducedLattice<Dim> reduced() const { return {lattice_, periodic_}; }

    /// Deforms the cell for a time [s]: H becomes exp(L t) H. Throws input_error if that is no cell
    /// any more.
    void advance(double duration) {
        if (rate_ == Matrix<Dim>::Zero()) return;
        set_lattice(
            Matrix<Dim>(lattice_ + exponential_less_one(Matrix<Dim>(duration * rate_)) * lattice_));
    }

    friend bool operator==(const PeriodicCell& x, const PeriodicCell& y) {
        return x.lattice_ == y.lattice_ && x.rate_ == y.rate_ && x.periodic_ == y.periodic_;
    }
    void write(NumberRecord& out) const {
        out.array(lattice_);
        out.array(rate_);
        for (const bool along : periodic_) out.integer(along);
    }
    static PeriodicCell read(NumberRecordReader& in) {
        const auto lattice = in.array<Matrix<Dim>>();
        const auto rate = in.array<Matrix<Dim>>();
        Directions periodic{};
        for (bool& along : periodic) along = in.integer(0, 1) == 1;
        return PeriodicCell(lattice, rate, periodic);
    }

  private:
    Matrix<Dim> lattice_, rate_;
    Directions periodic_;
};

}  // namespace talus
