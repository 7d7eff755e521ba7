// SPDX-License-Identifier: BSL-1.0
#include <talus/geometry/ball.hpp>
#include <talus/spatial/local_frame.hpp>

#include <map>

#include "measured.hpp"

namespace validation {
namespace G02 {

constexpr double r = 0.5;

/// A close-packed lattice of balls: places are integer combinations of the basis; every direction
/// of contact carries the same force along all of its rows, which keeps every inner ball in
/// equilibrium.
template <int Dim>
struct Lattice {
    std::vector<V<Dim>> directions;  ///< one of each opposite pair, unit
    std::vector<double> force;       ///< along each [N], compressive
    std::vector<V<Dim>> basis;       ///< of the lattice [m]
    double cell;                     ///< volume of a Voronoi cell [m^Dim]

    Lattice() {
        const double s = std::sqrt(0.5), q = std::sqrt(3.0) / 2;
        if constexpr (Dim == 2) {
            directions = {{1, 0}, {0.5, q}, {-0.5, q}};
            basis = {2 * r * directions[0], 2 * r * directions[1]};
        } else {
            directions = {{s, s, 0}, {s, -s, 0}, {s, 0, s}, {s, 0, -s}, {0, s, s}, {0, s, -s}};
            basis = {2 * r * directions[0], 2 * r * directions[2], 2 * r * directions[4]};
        }
        for (std::size_t k = 0; k < directions.size(); ++k)
            force.push_back(1.0 + 0.7 * static_cast<double>(k));
        talus::Matrix<Dim> m;
        for (int k = 0; k < Dim; ++k) m.col(k) = basis[static_cast<std::size_t>(k)];
        cell = std::abs(m.determinant());
    }
    /// Stress that the forces mean: each direction has one contact per ball, of branch 2 r.
    talus::Matrix<Dim> exact() const {
        talus::Matrix<Dim> sum = talus::Matrix<Dim>::Zero();
        for (std::size_t k = 0; k < directions.size(); ++k)
            sum -= force[k] * 2 * r * directions[k] * directions[k].transpose();
        return sum / cell;
    }
    /// Traction on the lattice cut with edges basis[i] (and basis[j]): the contacts that cross one
    /// cell of it, over its length (area). Independent of the volume average.
    V<Dim> cut_traction(const V<Dim>& normal, double cut) const {
        V<Dim> sum = V<Dim>::Zero();
        for (std::size_t k = 0; k < directions.size(); ++k) {
            // Rows of this direction that cross one cell of the cut: its cross-section over what
            // a row has for itself.
            const double row_section = cell / (2 * r);
            const double crossing = directions[k].dot(normal);
            sum -= force[k] * crossing * cut / row_section * directions[k];
        }
        return sum / cut;
    }
};

template <int Dim>
struct Block {
    talus::ContactJacobian<Dim> jacobian;
    std::vector<V<Dim>> impulses;
    std::size_t balls = 0;
    std::vector<bool> inner;  ///< has all its neighbours
};

/// n balls along every basis vector, with contacts and impulses (of a step of 1 s) as prescribed.
template <int Dim>
Block<Dim> block(const Lattice<Dim>& lattice, int n) {
    std::vector<V<Dim>> place;
    const int total = Dim == 2 ? n * n : n * n * n;
    for (int k = 0; k < total; ++k) {
        V<Dim> x = (k % n) * lattice.basis[0] + (k / n % n) * lattice.basis[1];
        if constexpr (Dim == 3) x += (k / n / n) * lattice.basis[2];
        place.push_back(x);
    }
    Block<Dim> result;
    result.balls = place.size();
    std::vector<std::size_t> neighbours(place.size(), 0);
    for (std::size_t i = 0; i < place.size(); ++i)
        for (std::size_t j = i + 1; j < place.size(); ++j) {
            const V<Dim> branch = place[j] - place[i];
            if (branch.norm() > 2 * r * (1 + 1e-9)) continue;
            ++neighbours[i];
            ++neighbours[j];
            const V<Dim> d = branch.normalized();
            double push = 0.0;
            for (std::size_t k = 0; k < lattice.directions.size(); ++k)
                if (std::abs(std::abs(d.dot(lattice.directions[k])) - 1) < 1e-9)
                    push = lattice.force[k];
            auto& g_c = result.jacobian;
            g_c.a.push_back(static_cast<talus::BodyIndex>(i));
            g_c.b.push_back(static_cast<talus::BodyIndex>(j));
            g_c.frame.push_back(talus::local_frame<Dim>(V<Dim>(-d)));
            g_c.arm_a.push_back(r * d);
            g_c.arm_b.push_back(-r * d);
            result.impulses.push_back(push * V<Dim>::Unit(0));
        }
    for (const std::size_t count : neighbours)
        result.inner.push_back(count == 2 * lattice.directions.size());
    return result;
}

template <int Dim>
void run(Trial<Dim>& trial) {
    const Lattice<Dim> lattice;
    const auto sample = block<Dim>(lattice, Dim == 2 ? 20 : 7);
    const auto forces = measured_forces<Dim>(trial, sample.jacobian, sample.impulses, 1.0);
    const auto moments = internal_moments<Dim>(sample.jacobian, forces, sample.balls);

    // Unions of Voronoi cells: single ones, and every third, and all inner ones.
    Worst single;
    talus::Matrix<Dim> all = talus::Matrix<Dim>::Zero(), third = all;
    int count = 0, third_count = 0;
    for (std::size_t i = 0; i < sample.balls; ++i) {
        if (!sample.inner[i]) continue;
        single.see(talus::Matrix<Dim>(moments[i] / lattice.cell), lattice.exact());
        all += moments[i];
        if (++count % 3 == 0) {
            third += moments[i];
            ++third_count;
        }
    }
    const double scale = lattice.exact().norm();
    trial.rounding("stress of one cell [Pa]", single, scale);
    trial.rounding("stress of all inner cells", talus::Matrix<Dim>(all / (count * lattice.cell)),
                   lattice.exact(), scale * count);
    trial.rounding("stress of every third inner cell",
                   talus::Matrix<Dim>(third / (third_count * lattice.cell)), lattice.exact(),
                   scale * count);

    // Forces through the lattice cuts, summed contact by contact over the block.
    for (int axis = 0; axis < Dim; ++axis) {
        // The cut is spanned by the other basis vectors.
        V<Dim> normal;
        double cut = 0.0;
        if constexpr (Dim == 2) {
            const V<2> edge = lattice.basis[static_cast<std::size_t>(1 - axis)];
            normal = V<2>(-edge[1], edge[0]);
            cut = edge.norm();
        } else {
            normal = lattice.basis[static_cast<std::size_t>((axis + 1) % 3)].cross(
                lattice.basis[static_cast<std::size_t>((axis + 2) % 3)]);
            cut = normal.norm();
        }
        normal.normalize();
        const talus::Matrix<Dim> mean = all / (count * lattice.cell);
        trial.rounding("traction on cut " + std::to_string(axis), V<Dim>(mean.transpose() * normal),
                       lattice.cut_traction(normal, cut), scale * count);
    }

    auto world = trial.world({.gravity = V<Dim>::Zero()});
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            world.add(talus::Ball<Dim>{r}, round_inertia<Dim>(1.0, r),
                      {i * lattice.basis[0] + j * lattice.basis[1], {}});
    trial.draw(world);
}

const Register g02(
    {.id = "G02",
     .name = "stress-lattice-vs-cut",
     .title = "Stress of a lattice against cuts",
     .gate = 2,
     .setup = "A block of 20 × 20 discs in a triangular lattice (7 × 7 × 7 spheres, face-centred "
              "cubic) with forces prescribed: every row of contacts carries a constant force, a "
              "different one for each direction.",
     .reference = {"t(n) = force through a lattice cut per length (area) = σ n",
                   "σ = frac{1}{V} Σ_i M_i over any union of Voronoi cells"},
     .compared = "The mean stress over single cells, all inner cells and every third of them with "
                 "the sum over directions; its traction on every lattice cut with the forces that "
                 "cross it.",
     .kind = Class::R,
     .why = "An identity (divergence theorem): both sides are sums of the same forces, some "
            "hundred terms.",
     .source = "Derived; Moreau 1997.",
     .catches = {Fault::forces_in_local_axes}},
    run<2>, run<3>, __FILE__);

}  // namespace G02
}  // namespace validation
