// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/assembly/body_image.hpp>
#include <talus/assembly/candidate_boxes.hpp>
#include <talus/assembly/image_pairs.hpp>
#include <talus/core/matrix_functions.hpp>
#include <talus/dynamics/periodic_cell.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>

namespace talus {

/// What contact detection keeps of a periodic cell: which image of the second body each candidate
/// is of, and the cell that they were found in.
template <int Dim>
requires SpaceDimension<Dim>
class CellImages {
  public:
    /// Of the second body of each candidate; empty without a cell.
    std::span<const ImageShift> images() const { return images_; }
    bool has_cell() const { return cell_.has_value(); }
    void forget() {
        cell_.reset();
        images_.clear();
    }

    void find(const PeriodicCell<Dim>& cell, const CandidateBoxes<Dim>& boxes,
              PairSearch<Dim> search, Column<CandidatePair>& candidates);
    bool left(const PeriodicCell<Dim>& cell, const CandidateBoxes<Dim>& boxes,
              const Bodies<Dim>& bodies, std::span<const double> radius,
              std::span<const double> reach) const;
    BodyImage<Dim> image(const PeriodicCell<Dim>& cell, std::size_t candidate,
                         const Matrix<Dim>& strain) const;

  private:
    std::optional<PeriodicCell<Dim>> cell_;
    Matrix<Dim> inverse_lattice_;
    bool unbounded_ = false;  // some box is
    Column<ImageShift> images_;
    ImagePairs<Dim> pairs_;
};

/// How to ask CellImages: through pointers, so that a program without a cell has none of it
/// compiled.
template <int Dim>
requires SpaceDimension<Dim>
struct ImageRoutines {
    decltype(&CellImages<Dim>::find) find;
    decltype(&CellImages<Dim>::left) left;
    decltype(&CellImages<Dim>::image) image;
};
template <int Dim>
inline constexpr ImageRoutines<Dim> image_routines{&CellImages<Dim>::find, &CellImages<Dim>::left,
                                                   &CellImages<Dim>::image};

/// The periodic cell of a step, as contact detection takes it; without one all is null.
template <int Dim>
requires SpaceDimension<Dim>
struct StepCell {
    const PeriodicCell<Dim>* cell = nullptr;
    const ImageRoutines<Dim>* routines = nullptr;
    Matrix<Dim> strain = Matrix<Dim>::Zero();  ///< over the step

    /// Of a cell that lives as long.
    static StepCell of(const PeriodicCell<Dim>& cell,
                       const Matrix<Dim>& strain = Matrix<Dim>::Zero()) {
        return {&cell, &image_routines<Dim>, strain};
    }
    explicit operator bool() const { return cell != nullptr; }
};

template <int Dim>
requires SpaceDimension<Dim>
void CellImages<Dim>::find(const PeriodicCell<Dim>& cell, const CandidateBoxes<Dim>& boxes,
                           PairSearch<Dim> search, Column<CandidatePair>& candidates) {
    cell_ = cell;
    images_.clear();
    inverse_lattice_ = inverted(cell.lattice()).inverse;
    unbounded_ = std::any_of(boxes.box.begin(), boxes.box.end(),
                             [](const Aabb<Dim>& box) { return !box.bounded(); });
    pairs_.find(search, cell, boxes.box, boxes.free, candidates, images_);
}

/// CandidateBoxes::left in a cell. Displacements count from where the deformation of the cell alone
/// would have brought a body: with F what the cell went through since, s' = F s + d_b - d_a for
/// what two bodies are apart. So gaps close by |F - 1| |s| + |d_a| + |d_b| at most; of pairs with
/// |s| up to 2 (R + room) of both that is charged to the two, and with |F - 1| <= 1/2 those farther
/// apart do not touch. What has no bounds has no images, and others move past it.
template <int Dim>
requires SpaceDimension<Dim>
bool CellImages<Dim>::left(const PeriodicCell<Dim>& cell, const CandidateBoxes<Dim>& boxes,
                           const Bodies<Dim>& bodies, std::span<const double> radius,
                           std::span<const double> reach) const {
    if (cell.periodic() != cell_->periodic() || boxes.box.size() != reach.size()) return true;
    const Matrix<Dim> change = (cell.lattice() - cell_->lattice()) * inverse_lattice_;
    constexpr double most_strain = 0.5;
    const double strain = change.norm();
    if (!(strain <= most_strain)) return true;
    if (unbounded_ && boxes.left(bodies, radius, reach)) return true;
    for (std::size_t i = 0; i < reach.size(); ++i) {
        if (boxes.free[i] == bodies.is_obstacle(i)) return true;
        if (!std::isfinite(radius[i])) continue;
        const double turn = bodies.rotation[i].distance(boxes.rotation[i]) * radius[i];
        const Vector<Dim> way =
            (bodies.position[i] - boxes.position[i]) - Vector<Dim>(change * boxes.position[i]);
        const double room = boxes.room[i];
        if (!(way.norm() + turn + reach[i] + 2.0 * strain * (radius[i] + room) <= room))
            return true;
    }
    return false;
}

template <int Dim>
requires SpaceDimension<Dim> BodyImage<Dim> CellImages<Dim>::image(const PeriodicCell<Dim>& cell,
                                                                   std::size_t candidate,
                                                                   const Matrix<Dim>& strain)
const {
    const ImageShift& shift = images_[candidate];
    if (shift.is_zero()) return {};
    const Vector<Dim> offset = cell.offset(shift);
    return {shift, offset, strain * offset};
}

}  // namespace talus
