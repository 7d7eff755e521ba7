// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/concepts.hpp>
#include <talus/core/column.hpp>
#include <talus/core/model.hpp>
#include <talus/core/room.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <utility>

namespace talus {

/// Broad phase on a hierarchy of hashed grids, cell sizes doubling [Mirtich1997]: time linear in
/// bodies and pairs for any mixture of sizes, memory linear in bodies.
///
/// All geometry is done on integers. Coordinates are counted in units of a sixth of the smallest
/// side present, rounded down; rounding is monotone, so overlapping boxes have overlapping integer
/// boxes, wherever the scene lies. A box goes to the lowest level whose cells, 2^level units, are
/// no smaller than it, into the one cell that holds its low corner. Boxes of a level m that overlap
/// a box [low, high] have their low corners in [low - 2^m + 1, high]: two or three cells along each
/// axis. Each box is looked up in its own and in coarser levels, if occupied. Unbounded boxes are
/// kept apart and compared with all others.
///
/// All arrays are kept from call to call. Pairs are sorted by counting, in linear time.
template <int Dim>
requires SpaceDimension<Dim>
class HierarchicalGrid {
  public:
    template <std::predicate<BodyIndex> IsObstacle>
    void find_pairs(std::span<const Aabb<Dim>> boxes, const IsObstacle& is_obstacle,
                    Column<CandidatePair>& pairs) {
        require_no_nan(boxes);
        pairs.clear();
        const auto keep = [&](BodyIndex i, BodyIndex j) {
            if (boxes[index(i)].overlaps(boxes[index(j)]) && !(is_obstacle(i) && is_obstacle(j)))
                pairs.push_back({std::min(i, j), std::max(i, j)});
        };
        sort_out(boxes);
        fill_cells(boxes);
        for (const Entry& entry : entries_) look_up(entry, keep);
        pair_unbounded(keep);
        sort(pairs, boxes.size());
    }

  private:
    using Integer = std::int64_t;
    using Corner = std::array<Integer, Dim>;

    struct Entry {
        Corner low, high;  ///< [units]
        BodyIndex body;
        int level;
    };

    static std::size_t index(BodyIndex i) { return static_cast<std::size_t>(i); }

    /// Splits the bodies into bounded and unbounded, and finds the unit.
    void sort_out(std::span<const Aabb<Dim>> boxes) {
        bounded_.clear();
        unbounded_.clear();
        Aabb<Dim> all;
        double smallest = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < boxes.size(); ++k) {
            if (is_empty(boxes[k])) continue;
            if (!boxes[k].bounded()) {
                unbounded_.push_back(static_cast<BodyIndex>(k));
                continue;
            }
            bounded_.push_back(static_cast<BodyIndex>(k));
            all.include(boxes[k]);
            const double side = (boxes[k].high - boxes[k].low).maxCoeff();
            if (side > 0.0) smallest = std::min(smallest, side);
        }
        origin_ = all.low;
        // Halved first: the extent of a scene may be more than the largest double.
        const double half = bounded_.empty() ? 0.0 : (0.5 * all.high - 0.5 * all.low).maxCoeff();
        unit_ = std::max(smallest / sixth, half / (0.5 * static_cast<double>(largest)));
        if (!(unit_ > 0.0 && std::isfinite(unit_))) unit_ = 1.0;
    }

    /// Monotone in x, in [0, largest].
    Integer count(double x, double origin) const {
        const double units = (x - origin) / unit_;
        return units < static_cast<double>(largest) ? static_cast<Integer>(units) : largest;
    }

    /// Enters the bounded boxes into the hash table: a counting sort by cell.
    void fill_cells(std::span<const Aabb<Dim>> boxes) {
        unsorted_.clear();
        occupied_ = 0;
        for (const BodyIndex body : bounded_) {
            Entry entry{{}, {}, body, 0};
            Integer side = 0;
            for (int d = 0; d < Dim; ++d) {
                const auto axis = static_cast<std::size_t>(d);
                entry.low[axis] = count(boxes[index(body)].low[d], origin_[d]);
                entry.high[axis] = count(boxes[index(body)].high[d], origin_[d]);
                side = std::max(side, entry.high[axis] - entry.low[axis]);
            }
            entry.level = static_cast<int>(std::bit_width(static_cast<std::uint64_t>(side)));
            occupied_ |= std::uint64_t{1} << entry.level;
            unsorted_.push_back(entry);
        }
        const std::size_t buckets = std::bit_ceil(2 * unsorted_.size() + 1);
        bucket_mask_ = buckets - 1;
        bucket_begin_.assign(buckets + 1, 0);
        for (const Entry& e : unsorted_) ++bucket_begin_[bucket(e.level, cell(e)) + 1];
        for (std::size_t k = 0; k < buckets; ++k) bucket_begin_[k + 1] += bucket_begin_[k];
        entries_.resize(unsorted_.size());
        // Filling from the back leaves each bucket in order of bodies and shifts the bounds by one.
        bucket_end_.assign(std::span<const std::size_t>(bucket_begin_).subspan(1));
        for (std::size_t k = unsorted_.size(); k-- > 0;)
            entries_[--bucket_end_[bucket(unsorted_[k].level, cell(unsorted_[k]))]] = unsorted_[k];
    }

    static Corner cell(const Entry& e) {
        Corner c;
        for (std::size_t d = 0; d < Dim; ++d) c[d] = e.low[d] >> e.level;
        return c;
    }
    /// Runs of 64 cells along the first axis stay together: neighbours share cache lines.
    std::size_t bucket(int level, const Corner& cell) const {
        constexpr int run = 6;
        auto h = static_cast<std::uint64_t>(level);
        for (std::size_t d = 0; d < Dim; ++d)
            h = (h ^ static_cast<std::uint64_t>(d == 0 ? cell[d] >> run : cell[d])) *
                0x9e3779b97f4a7c15u;
        const auto within = static_cast<std::uint64_t>(cell[0]) & ((1u << run) - 1);
        return static_cast<std::size_t>((h >> 32) + within) & bucket_mask_;
    }

    template <class Keep>
    void look_up(const Entry& entry, const Keep& keep) const {
        for (std::uint64_t levels = occupied_ >> entry.level << entry.level; levels != 0;
             levels &= levels - 1) {
            const int level = std::countr_zero(levels);
            const Integer reach = (Integer{1} << level) - 1;
            Corner first, last;
            for (std::size_t d = 0; d < Dim; ++d) {
                first[d] = std::max<Integer>(entry.low[d] - reach, 0) >> level;
                last[d] = entry.high[d] >> level;
            }
            Corner at = first;
            do look_into(entry, level, at, keep);
            while (advance(at, first, last));
        }
    }

    /// Next cell of the block [first, last], the first axis fastest; false after the last one.
    static bool advance(Corner& at, const Corner& first, const Corner& last) {
        for (std::size_t d = 0; d < Dim; ++d) {
            if (++at[d] <= last[d]) return true;
            at[d] = first[d];
        }
        return false;
    }

    template <class Keep>
    void look_into(const Entry& entry, int level, const Corner& at, const Keep& keep) const {
        const std::size_t k = bucket(level, at);
        for (std::size_t i = bucket_begin_[k]; i < bucket_begin_[k + 1]; ++i) {
            const Entry& other = entries_[i];
            // Within a level both find each other; cells of one bucket need not be the same.
            if (other.level != level || (level == entry.level && other.body >= entry.body))
                continue;
            bool meet = cell(other) == at;
            for (std::size_t d = 0; d < Dim && meet; ++d)
                meet = entry.low[d] <= other.high[d] && other.low[d] <= entry.high[d];
            if (meet) keep(entry.body, other.body);
        }
    }

    template <class Keep>
    void pair_unbounded(const Keep& keep) const {
        for (std::size_t k = 0; k < unbounded_.size(); ++k) {
            for (const BodyIndex other : bounded_) keep(unbounded_[k], other);
            for (std::size_t l = k + 1; l < unbounded_.size(); ++l)
                keep(unbounded_[k], unbounded_[l]);
        }
    }

    /// Two stable counting sorts, by b and then by a.
    void sort(Column<CandidatePair>& pairs, std::size_t bodies) {
        for (BodyIndex CandidatePair::*key : {&CandidatePair::b, &CandidatePair::a}) {
            place_.assign(bodies + 1, 0);
            for (const CandidatePair& p : pairs) ++place_[index(p.*key) + 1];
            for (std::size_t k = 0; k < bodies; ++k) place_[k + 1] += place_[k];
            detail::make_room(unsorted_pairs_, pairs.size());
            unsorted_pairs_ = pairs;
            for (const CandidatePair& p : unsorted_pairs_) pairs[place_[index(p.*key)]++] = p;
        }
    }

    /// Units along the smallest side: 6 or 7 after rounding down, so that bodies of equal size
    /// share the level of 8.
    static constexpr double sixth = 6.0;
    /// Largest coordinate [units]: exact in a double, and its sums with a cell fit an Integer.
    static constexpr Integer largest = Integer{1} << 50;

    Vector<Dim> origin_;
    double unit_ = 1.0;           ///< [m]
    std::uint64_t occupied_ = 0;  ///< bit m: level m has boxes
    std::uint64_t bucket_mask_ = 0;
    Column<BodyIndex> bounded_, unbounded_;
    Column<Entry> unsorted_, entries_;
    Column<std::size_t> bucket_begin_, bucket_end_, place_;
    Column<CandidatePair> unsorted_pairs_;
};
TALUS_MODEL(BroadPhase<HierarchicalGrid<2>, 2>);
TALUS_MODEL(BroadPhase<HierarchicalGrid<3>, 3>);

}  // namespace talus
