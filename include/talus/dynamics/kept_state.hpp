// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/column.hpp>
#include <talus/dynamics/bodies.hpp>

#include <algorithm>
#include <cstddef>

namespace talus {

/// A copy of the state q, u of all bodies, to go back to when something fails on the way, and their
/// number: bodies that were added since are taken off again. Allocates only for more bodies than
/// ever before.
template <int Dim>
requires SpaceDimension<Dim>
class KeptState {
  public:
    void keep(const Bodies<Dim>& bodies) {
        position_ = bodies.position;
        rotation_ = bodies.rotation;
        velocity_ = bodies.velocity;
        spin_ = bodies.spin;
    }
    /// Gives the kept state to the bodies, bit for bit; what is kept is lost.
    void restore(Bodies<Dim>& bodies) noexcept {
        bodies.position.swap(position_);
        bodies.rotation.swap(rotation_);
        bodies.velocity.swap(velocity_);
        bodies.spin.swap(spin_);
        const std::size_t n = bodies.count();
        bodies.inverse_mass.resize(std::min(n, bodies.inverse_mass.size()));
        bodies.inverse_inertia.resize(std::min(n, bodies.inverse_inertia.size()));
        bodies.material.resize(std::min(n, bodies.material.size()));
        bodies.id.resize(std::min(n, bodies.id.size()));
        bodies.locked.resize(std::min(n, bodies.locked.size()));
        bodies.groups.resize(std::min(n, bodies.groups.size()));
    }

  private:
    Column<Vector<Dim>> position_;
    Column<Rotation<Dim>> rotation_;
    Column<Vector<Dim>> velocity_;
    Column<AngularVector<Dim>> spin_;
};

}  // namespace talus
