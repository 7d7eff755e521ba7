// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/assembly/candidate_boxes.hpp>
#include <talus/collision/concepts.hpp>
#include <talus/core/column.hpp>
#include <talus/core/ids.hpp>
#include <talus/core/input.hpp>
#include <talus/core/matrix_functions.hpp>
#include <talus/dynamics/periodic_cell.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace talus {

/// The candidates of a periodic cell: pairs of bodies a < b and of which image of b, whose boxes
/// overlap. Every box is brought home into the cell of the shortest lattice vectors; its images
/// that come near that cell are boxes of their own for the broad phase, which pair with those at
/// home alone. No body pairs with its own images, and what has no bounds has none: it meets each
/// body where that is, which is compared one by one.
template <int Dim>
requires SpaceDimension<Dim>
class ImagePairs {
  public:
    /// Replaces `pairs` and `images`, sorted by a, b and image. `is_free` is false of obstacles, of
    /// which two are no pair. Throws input_error for shifts beyond 2^31 lattice vectors, for bodies
    /// so large that 10^4 images come near, and names a pair of the broad phase that is none.
    void find(PairSearch<Dim> search, const PeriodicCell<Dim>& cell,
              std::span<const Aabb<Dim>> boxes, std::span<const bool> is_free,
              Column<CandidatePair>& pairs, Column<ImageShift>& images);

  private:
    using Steps = typename ReducedLattice<Dim>::Steps;
    static constexpr std::int64_t most_steps = std::numeric_limits<std::int32_t>::max();
    static constexpr double most_images = 1e4;

    struct Pair {
        CandidatePair bodies;
        ImageShift image;
        friend auto operator<=>(const Pair&, const Pair&) = default;
    };
    struct Image {
        BodyIndex body;
        Steps steps;
    };

    void bring_home(const PeriodicCell<Dim>& cell, std::span<const Aabb<Dim>> boxes);
    void add_images(const PeriodicCell<Dim>& cell, std::size_t count);
    void collect(const PeriodicCell<Dim>& cell, std::size_t count,
                 const Column<CandidatePair>& pairs);
    void add_unbounded(std::span<const Aabb<Dim>> boxes, std::span<const bool> is_free);
    static Vector<Dim> shift(const Matrix<Dim>& vectors, const Steps& steps) {
        Vector<Dim> sum = Vector<Dim>::Zero();
        for (int k = 0; k < Dim; ++k)
            sum += static_cast<double>(steps[static_cast<std::size_t>(k)]) *
                   Vector<Dim>(vectors.col(k));
        return sum;
    }
    static ImageShift checked(const Steps& steps, BodyIndex a, BodyIndex b);

    Column<Aabb<Dim>> box_;               // those at home, then the images
    Column<Steps> home_;                  // from each body to its home
    Column<Vector<Dim>> place_, extent_;  // of each box, in lattice coordinates [-]
    Column<Image> image_;
    Column<bool> is_free_, bounded_;
    std::vector<Pair> found_;
};

template <int Dim>
requires SpaceDimension<Dim>
void ImagePairs<Dim>::find(PairSearch<Dim> search, const PeriodicCell<Dim>& cell,
                           std::span<const Aabb<Dim>> boxes, std::span<const bool> is_free,
                           Column<CandidatePair>& pairs, Column<ImageShift>& images) {
    bring_home(cell, boxes);
    add_images(cell, boxes.size());
    is_free_.assign(is_free);
    is_free_.resize(box_.size(), false);
    search(box_, is_free_, pairs);
    found_.clear();
    collect(cell, boxes.size(), pairs);
    add_unbounded(boxes, is_free);
    std::sort(found_.begin(), found_.end());
    found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
    pairs.clear();
    images.clear();
    for (const Pair& pair : found_) {
        pairs.push_back(pair.bodies);
        images.push_back(pair.image);
    }
}

template <int Dim>
requires SpaceDimension<Dim>
void ImagePairs<Dim>::bring_home(const PeriodicCell<Dim>& cell, std::span<const Aabb<Dim>> boxes) {
    require_no_nan(boxes);
    const ReducedLattice<Dim> lattice = cell.reduced();
    const Matrix<Dim> inverse = inverted(lattice.vectors).inverse;
    box_.clear();
    home_.assign(boxes.size(), Steps{});
    place_.assign(boxes.size(), Vector<Dim>::Zero());
    extent_.assign(boxes.size(), Vector<Dim>::Zero());
    bounded_.assign(boxes.size(), false);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        box_.push_back(boxes[i]);
        if (is_empty(boxes[i])) continue;
        if (!boxes[i].bounded()) {
            constexpr double infinity = std::numeric_limits<double>::infinity();
            box_.back() = {Vector<Dim>::Constant(infinity), Vector<Dim>::Constant(-infinity)};
            continue;
        }
        bounded_[i] = true;
        const Vector<Dim> centre = 0.5 * (boxes[i].low + boxes[i].high);
        const Vector<Dim> half = 0.5 * (boxes[i].high - boxes[i].low);
        place_[i] = inverse * centre;
        for (int k = 0; k < Dim; ++k) {
            for (int d = 0; d < Dim; ++d) extent_[i][k] += std::abs(inverse(k, d)) * half[d];
            if (!lattice.periodic[static_cast<std::size_t>(k)]) continue;
            const double cells = std::floor(place_[i][k]);
            if (!(std::abs(cells) <= static_cast<double>(most_steps)))
                detail::reject(
                    detail::numbered("distance from the origin of body", i, ", in cells,"), cells,
                    "within 2^31");
            home_[i][static_cast<std::size_t>(k)] = -static_cast<std::int64_t>(cells);
            place_[i][k] -= cells;
        }
        const Vector<Dim> way = shift(lattice.vectors, home_[i]);
        // What rounding may take away on the way home.
        const double rounding = 8.0 * std::numeric_limits<double>::epsilon() *
                                (way.norm() + centre.norm() + half.norm());
        box_.back() =
            Aabb<Dim>{Vector<Dim>(boxes[i].low + way), Vector<Dim>(boxes[i].high + way)}.expanded(
                rounding);
    }
}

/// Images that can meet a box at home.
template <int Dim>
requires SpaceDimension<Dim>
void ImagePairs<Dim>::add_images(const PeriodicCell<Dim>& cell, std::size_t count) {
    constexpr double rounding = 1e-9;
    const ReducedLattice<Dim> lattice = cell.reduced();
    Vector<Dim> largest = Vector<Dim>::Zero();
    for (const Vector<Dim>& e : extent_) largest = largest.cwiseMax(e);
    image_.clear();
    for (std::size_t i = 0; i < count; ++i) {
        if (!bounded_[i]) continue;
        Steps first{}, last{};
        double images = 1.0;
        for (int d = 0; d < Dim; ++d) {
            const auto k = static_cast<std::size_t>(d);
            if (!lattice.periodic[k]) continue;
            const double reach = extent_[i][d] + largest[d] + rounding;
            const double low = std::ceil(-reach - place_[i][d]);
            const double high = std::floor(1.0 + reach - place_[i][d]);
            images *= high - low + 1.0;
            first[k] = static_cast<std::int64_t>(low);
            last[k] = static_cast<std::int64_t>(high);
        }
        if (!(images <= most_images))
            detail::reject(
                detail::numbered("number of images of body", i, " near the cell"), images,
                "at most " + detail::text_of(most_images) + ": bodies are too large for it");
        Steps at = first;
        const auto advance = [&] {
            for (std::size_t k = 0; k < at.size(); ++k) {
                if (++at[k] <= last[k]) return true;
                at[k] = first[k];
            }
            return false;
        };
        do {
            if (at == Steps{}) continue;
            const Vector<Dim> way = shift(lattice.vectors, at);
            image_.push_back({static_cast<BodyIndex>(i), at});
            box_.push_back({Vector<Dim>(box_[i].low + way), Vector<Dim>(box_[i].high + way)});
        } while (advance());
    }
}

template <int Dim>
requires SpaceDimension<Dim> ImageShift ImagePairs<Dim>::checked(const Steps& steps, BodyIndex a,
                                                                 BodyIndex b) {
    ImageShift image;
    for (std::size_t k = 0; k < steps.size(); ++k) {
        if (steps[k] > most_steps || steps[k] < -most_steps)
            detail::reject(detail::numbered("image of body", static_cast<std::size_t>(b)) +
                               detail::numbered(" that body", static_cast<std::size_t>(a),
                                                " meets, in lattice vectors,"),
                           static_cast<double>(steps[k]), "within 2^31");
        image.n[k] = static_cast<std::int32_t>(steps[k]);
    }
    return image;
}

/// From boxes to bodies, each pair once: two find each other as images of either.
template <int Dim>
requires SpaceDimension<Dim>
void ImagePairs<Dim>::collect(const PeriodicCell<Dim>& cell, std::size_t count,
                              const Column<CandidatePair>& pairs) {
    const ReducedLattice<Dim> lattice = cell.reduced();
    for (const CandidatePair& pair : pairs) {
        const auto i = static_cast<std::size_t>(pair.a), other = static_cast<std::size_t>(pair.b);
        const Image image = other < count ? Image{pair.b, {}} : image_[other - count];
        const auto j = static_cast<std::size_t>(image.body);
        if (i == j) continue;
        Steps steps{};
        for (std::size_t k = 0; k < steps.size(); ++k)
            steps[k] = home_[j][k] + image.steps[k] - home_[i][k];
        if (i > j)
            for (auto& s : steps) s = -s;
        const CandidatePair bodies{std::min(pair.a, image.body), std::max(pair.a, image.body)};
        found_.push_back({bodies, checked(lattice.in_lattice(steps), bodies.a, bodies.b)});
    }
}

/// Pairs with what has no bounds, where bodies are.
template <int Dim>
requires SpaceDimension<Dim>
void ImagePairs<Dim>::add_unbounded(std::span<const Aabb<Dim>> boxes,
                                    std::span<const bool> is_free) {
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        if (boxes[i].bounded() || is_empty(boxes[i])) continue;
        for (std::size_t j = 0; j < boxes.size(); ++j) {
            const bool twice = j <= i && !boxes[j].bounded();
            if (twice || j == i || is_empty(boxes[j]) || !(is_free[i] || is_free[j]) ||
                !boxes[i].overlaps(boxes[j]))
                continue;
            found_.push_back(
                {{static_cast<BodyIndex>(std::min(i, j)), static_cast<BodyIndex>(std::max(i, j))},
                 {}});
        }
    }
}

}  // namespace talus
