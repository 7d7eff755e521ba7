// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/law/coulomb.hpp>
#include <talus/problem/contact_problem.hpp>

#include <string>
#include <vector>

/// What is known of a problem of the gallery.
enum class Kind {
    well_posed,   ///< one solution in u, as many impulses as the bodies can take
    hyperstatic,  ///< solutions exist, velocities are unique or nearly, impulses are not
    stiff,        ///< the same, with condition numbers of 1e6 and more
    rough,        ///< the same as well_posed, with a friction coefficient of 1e3
    solvable,     ///< a solution is known, but no method is known to find it always
    unknown,      ///< perhaps several solutions, perhaps none
    infeasible,   ///< no velocities without overlap exist, whatever the impulses
};

/// A contact problem for all solvers.
template <int Dim>
struct GalleryProblem {
    std::string name;
    Kind kind;
    talus::ContactProblem<Dim, talus::Coulomb<Dim>> problem;
};

/// Small problems of every sort that simulations meet, and of the sorts that they should not, for
/// Dim 2 and 3.
template <int Dim>
std::vector<GalleryProblem<Dim>> gallery_problems(unsigned seed, int rounds);
