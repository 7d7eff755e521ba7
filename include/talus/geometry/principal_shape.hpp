// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/geometry/concepts.hpp>

namespace talus {

/// A shape ready to become a body: seen from its principal frame.
template <int Dim, class S>
struct PrincipalShape {
    S shape;                    ///< centroid at the origin, principal axes along the axes
    PrincipalFrame<Dim> frame;  ///< where that frame stands in the frame the shape came in
    double volume;              ///< [m^Dim]
};

/// Re-expresses `shape` in its principal frame: a body placed at `pose` with the shape as given is
/// one placed at `pose * frame.pose` with the shape as returned.
template <int Dim, SolidShape<Dim> S>
PrincipalShape<Dim, S> in_principal_frame(const S& shape) {
    const MassProperties<Dim> m = shape.mass_properties();
    const PrincipalFrame<Dim> frame = principal_frame(m);
    return {shape.placed(frame.pose.inverse()), frame, m.volume};
}

}  // namespace talus
