// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/io/problem_content.hpp>
#include <talus/law/coulomb.hpp>
#include <talus/problem/assembled_problem.hpp>

#include <cmath>
#include <cstddef>
#include <vector>

namespace solve_problem {

/// || r - P_K(r - (u + mu |u_t| n)) || / max(|| q ||, || r ||, || u ||) over all contacts; 0 / 0 is
/// 0, and not a number if anything is not.
template <int Dim>
double residual_in_file_units(const talus::AssembledProblem<Dim, talus::Coulomb<Dim>>& p,
                              const std::vector<talus::Vector<Dim>>& r) {
    const auto u = talus::solution_of<Dim>(p, r).relative_velocity;
    double error = 0.0, q2 = 0.0, r2 = 0.0, u2 = 0.0;
    for (std::size_t c = 0; c < r.size(); ++c) {
        error += (r[c] - p.laws[c].natural_map(u[c], r[c], 1.0)).squaredNorm();
        q2 += p.free_velocity[c].squaredNorm();
        r2 += r[c].squaredNorm();
        u2 += u[c].squaredNorm();
    }
    // A projection may map what is not finite to zero: the sums of squares still show it.
    error += 0.0 * (q2 + r2 + u2);
    if (error == 0.0) return 0.0;
    return std::sqrt(error / std::fmax(q2, std::fmax(r2, u2)));
}

}  // namespace solve_problem
