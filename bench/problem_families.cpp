// SPDX-License-Identifier: BSL-1.0
#include "problem_families.hpp"

#include <talus/solver/sweeps/gauss_seidel.hpp>
#include <talus/stepping/simulation.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "deposited_pile.hpp"

namespace bench {
namespace {

constexpr double h = step_length;  // [s]
constexpr double gravity = 9.81;   // [m/s^2]

/// A configuration at rest, and which of its contacts a step treats as effective.
template <int Dim>
struct Situation {
    static constexpr int dimension = Dim;
    World<Dim> world;
    talus::StepParams step;
};

/// Of bodies placed exactly in touch, whose size is about `length` [m].
talus::StepParams touching(double length) {
    talus::StepParams step;
    step.contact_tolerance = 1e-9 * length;
    return step;
}

/// The integer closest to x, but at least `least`.
int rounded(double x, int least) { return std::max(least, static_cast<int>(std::lround(x))); }

// --- bodies placed exactly in touch --------------------------------------------------------------

/// Bricks in running bond, half bricks at the ends of every other course; a wall twice as long as
/// high. Two contacts per pair of faces, about six per brick.
Situation<2> brick_wall(std::size_t contacts) {
    constexpr double length = 0.2, height = 0.1;
    Situation<2> s{world_with_floor<2>(0.6), touching(height)};
    const int side = rounded(std::sqrt(static_cast<double>(contacts) / 6.0), 2);
    const auto lay = [&](int course, double begin, double end) {
        const Vec<2> half(0.5 * length * (end - begin), 0.5 * height);
        const Vec<2> centre(0.5 * length * (begin + end), height * (course + 0.5));
        s.world.add(talus::Box<2>(half), 2000.0, at<2>(centre));
    };
    for (int course = 0; course < side; ++course) {
        const double shift = course % 2 == 0 ? 0.0 : 0.5;
        if (shift > 0.0) lay(course, 0.0, shift);
        for (int k = 0; k + shift < side; ++k)
            lay(course, k + shift, std::min<double>(k + shift + 1.0, side));
    }
    return s;
}

/// A triangular heap of equal discs on a hexagonal lattice, about three contacts per disc.
Situation<2> hexagonal_heap(std::size_t contacts) {
    constexpr double radius = 0.01;
    Situation<2> s{world_with_floor<2>(0.5), touching(radius)};
    const int base = rounded(std::sqrt(static_cast<double>(contacts) / 1.5), 2);
    for (int row = 0; row < base; ++row)
        for (int k = 0; k + row < base; ++k)
            s.world.add(talus::Ball<2>{radius}, 2600.0,
                        at<2>(radius * Vec<2>(2 * k + row, 1.0 + std::sqrt(3.0) * row)));
    return s;
}

/// A square pyramid of equal spheres on a face-centred cubic lattice, about six contacts per
/// sphere.
Situation<3> fcc_pyramid(std::size_t contacts) {
    constexpr double radius = 0.01;
    Situation<3> s{world_with_floor<3>(0.5), touching(radius)};
    const int base = rounded(std::cbrt(static_cast<double>(contacts) / 2.0), 2);
    for (int layer = 0; layer < base; ++layer)
        for (int y = 0; y + layer < base; ++y)
            for (int x = 0; x + layer < base; ++x)
                s.world.add(talus::Ball<3>{radius}, 2600.0,
                            at<3>(radius * Vec<3>(2 * x + layer, 2 * y + layer,
                                                  1.0 + std::sqrt(2.0) * layer)));
    return s;
}

/// A tower of equal boxes, whose masses grow from bottom to top, by `ratio` in all.
template <int Dim>
Situation<Dim> tower(std::size_t contacts, double ratio) {
    constexpr double half = 0.05;
    Situation<Dim> s{world_with_floor<Dim>(0.5), touching(half)};
    const int boxes = rounded(static_cast<double>(contacts >> (Dim - 1)), 2);
    for (int k = 0; k < boxes; ++k) {
        const double share = static_cast<double>(k) / (boxes - 1);
        s.world.add(talus::Box<Dim>(Vec<Dim>::Constant(half)), 1000.0 * std::pow(ratio, share),
                    at<Dim>((2 * k + 1) * half * Vec<Dim>::Unit(Dim - 1)));
    }
    return s;
}

/// A semicircular arch of mean radius 1 and thickness 0.15, on the floor.
template <int Dim>
Situation<Dim> arch(std::size_t contacts) {
    constexpr double inner = 0.925, outer = 1.075, half_width = 0.15;
    Situation<Dim> s{world_with_floor<Dim>(0.6), touching(outer - inner)};
    const int voussoirs = rounded(static_cast<double>(contacts >> (Dim - 1)) - 1.0, 3);
    for (int k = 0; k < voussoirs; ++k) {
        const double a = std::numbers::pi * k / voussoirs;
        const double b = std::numbers::pi * (k + 1) / voussoirs;
        std::vector<Vec<Dim>> corners;
        for (const auto& [r, angle] :
             {std::pair{inner, a}, std::pair{outer, a}, std::pair{outer, b}, std::pair{inner, b}}) {
            Vec<Dim> corner = Vec<Dim>::Zero();
            corner[0] = r * std::cos(angle);
            corner[Dim - 1] = r * std::sin(angle);
            corners.push_back(corner);
        }
        if constexpr (Dim == 3) {
            for (std::size_t i = 0; i < 4; ++i) {
                corners.push_back(corners[i] + half_width * Vec<3>::UnitY());
                corners[i] -= half_width * Vec<3>::UnitY();
            }
        }
        s.world.add(talus::ConvexPolytope<Dim>(corners), 2000.0, talus::Pose<Dim>{});
    }
    return s;
}

/// Pairs of leaning cards with round ends, flat cards across their tips, storey upon storey.
Situation<2> card_house(std::size_t contacts) {
    constexpr double length = 0.1, radius = 0.002, lean = 20.0 * std::numbers::pi / 180.0;
    const double foot = radius + length * std::sin(lean);  // from the axis of a pair
    const double pitch = 2.0 * foot + 3.0 * radius;
    const double rise = length * std::cos(lean);
    Situation<2> s{world_with_floor<2>(0.6), touching(radius)};
    const talus::Capsule<2> card(0.5 * length, radius);
    const talus::Box<2> flat(Vec<2>(0.5 * pitch - 0.1 * radius, radius));
    const int storeys = rounded(std::sqrt(static_cast<double>(contacts) / 2.5), 2);
    const double storey_height = rise + 4.0 * radius;
    for (int storey = 0; storey < storeys; ++storey)
        for (int k = 0; k + storey < storeys; ++k) {
            const Vec<2> origin(pitch * (k + 0.5 * storey), storey_height * storey);
            for (const double side : {-1.0, 1.0}) {
                const Vec<2> centre(side * 0.5 * (radius + foot), radius + 0.5 * rise);
                const double angle = 0.5 * std::numbers::pi + side * lean;
                s.world.add(
                    card, 700.0,
                    {origin + centre, talus::Rotation<2>::exp(talus::AngularVector<2>(angle))});
            }
            if (k + storey + 1 < storeys)
                s.world.add(flat, 700.0, at<2>(origin + Vec<2>(0.5 * pitch, rise + 3.0 * radius)));
        }
    return s;
}

// --- deposited piles -----------------------------------------------------------------------------

template <int Dim>
Situation<Dim> resting_pile(std::size_t contacts, std::uint64_t seed) {
    Situation<Dim> s{boxed(resting_scene<Dim>(contacts, seed), true), {}};
    s.step.scheme = talus::Scheme::gap_anticipating;
    return s;
}

template <int Dim>
Situation<Dim> pile(std::size_t contacts, std::uint64_t seed, bool right_wall) {
    Situation<Dim> s{boxed(settled_scene<Dim>(contacts, seed), right_wall), {}};
    s.step.scheme = talus::Scheme::gap_anticipating;
    return s;
}

// --- from a situation to a problem ---------------------------------------------------------------

/// The problem of one step, gravity turned from the vertical by `tilt` [rad] towards the first
/// axis.
template <int Dim>
talus::ContactProblem<Dim, Law<Dim>> problem_of(Situation<Dim> s, double tilt) {
    s.world.gravity =
        gravity * (std::sin(tilt) * Vec<Dim>::Unit(0) - std::cos(tilt) * Vec<Dim>::Unit(Dim - 1));
    talus::MoreauMidpoint<Dim, Law<Dim>, talus::AnyShape<Dim>, talus::HierarchicalGrid<Dim>> step;
    talus::StepData<Dim, Law<Dim>> data;
    step.pose_problem(s.world, 0.0, h, s.step, data);
    return std::move(data.problem);
}

template <int Dim>
BenchProblem<Dim> perturbed(const Situation<Dim>& s) {
    const auto before = problem_of(s, 0.0);
    talus::GaussSeidelParams params;
    params.tolerance = 1e-3;
    params.max_sweeps = 20000;
    std::vector<Vec<Dim>> r(before.contact_count(), Vec<Dim>::Zero());
    talus::GaussSeidel<Dim, Law<Dim>>(params).solve(before, r);
    BenchProblem<Dim> problem(problem_of(s, std::numbers::pi / 180.0));
    problem.start = std::move(r);
    return problem;
}

/// Collects the families: each is its name, its usual sizes and what makes it.
class Catalogue {
  public:
    explicit Catalogue(std::span<const std::size_t> sizes) : sizes_(sizes.begin(), sizes.end()) {}

    /// `make(size)` returns a Situation. The smallest size also comes perturbed.
    template <class Make>
    void add(const std::string& family, std::vector<std::size_t> usual, Make make) {
        const auto& sizes = sizes_.empty() ? usual : sizes_;
        constexpr int dimension = decltype(make(1))::dimension;
        const auto name = [&](std::size_t size) { return family + "-" + std::to_string(size); };
        for (const std::size_t size : sizes)
            entries.push_back(
                {name(size), [=] { return AnyProblem(BenchProblem(problem_of(make(size), 0.0))); },
                 dimension});
        const std::size_t size = sizes.front();
        entries.push_back({name(size) + "-perturbed",
                           [=] { return AnyProblem(perturbed(make(size))); }, dimension});
    }

    std::vector<ProblemEntry> entries;

  private:
    std::vector<std::size_t> sizes_;
};

}  // namespace

std::vector<ProblemEntry> generated_problems(std::span<const std::size_t> sizes,
                                             std::uint64_t seed) {
    Catalogue c(sizes);
    c.add("wall_2d", {1000, 5000}, brick_wall);
    c.add("hexagonal_heap_2d", {1000}, hexagonal_heap);
    c.add("pile_2d", {1000, 5000}, [=](std::size_t n) { return pile<2>(n, seed, true); });
    c.add("rest_2d", {1000, 5000}, [=](std::size_t n) { return resting_pile<2>(n, seed); });
    c.add("collapse_2d", {1000, 5000}, [=](std::size_t n) { return pile<2>(n, seed, false); });
    c.add("card_house_2d", {100, 1000}, card_house);
    c.add("arch_2d", {100}, arch<2>);
    c.add("fcc_pyramid_3d", {1000, 5000}, fcc_pyramid);
    c.add("pile_3d", {3000, 12000}, [=](std::size_t n) { return pile<3>(n, seed, true); });
    c.add("rest_3d", {3000, 12000}, [=](std::size_t n) { return resting_pile<3>(n, seed); });
    c.add("collapse_3d", {3000}, [=](std::size_t n) { return pile<3>(n, seed, false); });
    c.add("arch_3d", {100}, arch<3>);
    for (const auto& [text, ratio] :
         {std::pair{"1", 1.0}, std::pair{"1e3", 1e3}, std::pair{"1e6", 1e6}}) {
        const std::string suffix = std::string("_mass_ratio_") + text;
        c.add("tower_2d" + suffix, {100}, [r = ratio](std::size_t n) { return tower<2>(n, r); });
        c.add("tower_3d" + suffix, {100}, [r = ratio](std::size_t n) { return tower<3>(n, r); });
    }
    return std::move(c.entries);
}

}  // namespace bench
