// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/types.hpp>

/// The vector with these first and last components: a picture in the plane, drawn in both
/// dimensions.
template <int Dim>
talus::Vector<Dim> in_plane(double first, double last) {
    talus::Vector<Dim> v = talus::Vector<Dim>::Zero();
    v[0] = first;
    v[Dim - 1] = last;
    return v;
}
