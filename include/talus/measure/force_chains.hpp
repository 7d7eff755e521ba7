// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/contact_set.hpp>
#include <talus/core/input.hpp>
#include <talus/core/symmetric_eigen.hpp>
#include <talus/dynamics/bodies.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace talus {

struct ForceChainParams {
    /// Largest angle between a grain's direction of largest compression and the line to the next
    /// grain of its chain [rad], in (0, pi / 2).
    double angle = std::numbers::pi / 4.0;
    /// Grains that a chain has at least [-].
    std::size_t least_length = 3;
    /// Normal impulse above which a contact bears [N s], not negative.
    double least_impulse = 0.0;
};

/// Rows of grains along which compression is handed on.
struct ForceChains {
    std::vector<std::vector<BodyIndex>> chains;  ///< of neighbours, from one end to the other
    std::vector<double> compression;             ///< largest principal compression, by body [Pa]
    double mean = 0.0;  ///< of that, over the free bodies that are compressed [Pa]

    std::size_t grains() const {
        std::size_t count = 0;
        for (const auto& chain : chains) count += chain.size();
        return count;
    }
};

namespace detail {

/// Of each grain the best aligned neighbour on either side of its direction.
struct ChainLinks {
    static constexpr BodyIndex none = -1;
    std::array<BodyIndex, 2> next{none, none};
    std::array<double, 2> cosine{0.0, 0.0};

    void consider(double along, BodyIndex other) {
        const std::size_t side = along > 0.0 ? 0 : 1;
        // Of two as good the one with the smaller index, which comes first.
        if (!(std::abs(along) > cosine[side])) return;
        cosine[side] = std::abs(along);
        next[side] = other;
    }
    bool has(BodyIndex other) const { return next[0] == other || next[1] == other; }
};

}  // namespace detail

/// Force chains after [Peters2005]: among the grains whose largest principal compression is at
/// least the mean, neighbours whose line of centres lies within `angle` of that direction of both.
/// Of several on one side of a grain the best aligned counts, and only where it chooses this grain
/// as well, so that chains do not branch; a closed one begins at its least grain. `moments` are the
/// internal moments of the bodies [N m] (internal_moments, compression negative), `volume` theirs
/// [m^Dim]. O(bodies + contacts). Throws input_error for arrays of other lengths, for bodies
/// that are gone, and for an angle out of range.
template <int Dim>
ForceChains force_chains(const Bodies<Dim>& bodies, const ContactSet<Dim>& contacts,
                         std::span<const Vector<Dim>> r, std::span<const Matrix<Dim>> moments,
                         std::span<const double> volume, ForceChainParams params = {}) {
    const std::size_t n = bodies.count();
    require_count("impulses", r.size(), "contacts", contacts.count());
    contacts.require_bodies(bodies.id);
    require_count("internal moments", moments.size(), "bodies", n);
    require_count("volumes", volume.size(), "bodies", n);
    if (!(params.angle > 0.0 && params.angle < 0.5 * std::numbers::pi))
        detail::reject("angle of force chains", params.angle, "above 0 and below pi / 2");
    require_non_negative("least_impulse", params.least_impulse);
    ForceChains result;
    result.compression.assign(n, 0.0);
    std::vector<Vector<Dim>> direction(n, Vector<Dim>::Zero());
    std::size_t compressed = 0;
    for (std::size_t i = 0; i < n; ++i) {
        if (bodies.is_obstacle(i)) continue;
        require_positive(detail::numbered("volume of body", i), volume[i]);
        const Matrix<Dim> symmetric = (0.5 / volume[i]) * (moments[i] + moments[i].transpose());
        const SymmetricEigen<Dim> principal(symmetric);
        if (!(principal.values[0] < 0.0)) continue;
        result.compression[i] = -principal.values[0];
        direction[i] = principal.vectors.col(0);
        result.mean += result.compression[i];
        ++compressed;
    }
    if (compressed == 0) return result;
    result.mean /= static_cast<double>(compressed);

    const auto strong = [&](std::size_t i) {
        constexpr double rounding = 1e-12;  // where all are alike
        return result.compression[i] > 0.0 &&
               result.compression[i] >= (1.0 - rounding) * result.mean;
    };
    const double least_cosine = std::cos(params.angle);
    std::vector<detail::ChainLinks> links(n);
    for (std::size_t c = 0; c < contacts.count(); ++c) {
        if (!(r[c][0] > params.least_impulse)) continue;
        const BodyIndex a = contacts.key[c].a, b = contacts.key[c].b;
        const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
        if (!strong(i) || !strong(j)) continue;
        Vector<Dim> line = bodies.position[j] - bodies.position[i];
        if (!contacts.offset.empty()) line += contacts.offset[c];
        const double length = line.norm();
        if (!(length > 0.0)) continue;
        const double at_i = line.dot(direction[i]) / length;
        const double at_j = -line.dot(direction[j]) / length;
        if (std::abs(at_i) < least_cosine || std::abs(at_j) < least_cosine) continue;
        links[i].consider(at_i, b);
        links[j].consider(at_j, a);
    }
    // What is not chosen by both is no link.
    std::vector<std::array<BodyIndex, 2>> next(n);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t side = 0; side < 2; ++side) {
            const BodyIndex other = links[i].next[side];
            const bool both = other != detail::ChainLinks::none &&
                              links[static_cast<std::size_t>(other)].has(static_cast<BodyIndex>(i));
            next[i][side] = both ? other : detail::ChainLinks::none;
        }
    std::vector<bool> taken(n, false);
    const auto follow = [&](std::size_t start) {
        std::vector<BodyIndex> chain;
        for (auto at = static_cast<BodyIndex>(start); at != detail::ChainLinks::none;) {
            const auto i = static_cast<std::size_t>(at);
            chain.push_back(at);
            taken[i] = true;
            at = detail::ChainLinks::none;
            for (const BodyIndex other : next[i])
                if (at == detail::ChainLinks::none && other != detail::ChainLinks::none &&
                    !taken[static_cast<std::size_t>(other)])
                    at = other;
        }
        if (chain.size() >= params.least_length) result.chains.push_back(std::move(chain));
    };
    for (const bool closed : {false, true})
        for (std::size_t i = 0; i < n; ++i) {
            const bool end =
                next[i][0] == detail::ChainLinks::none || next[i][1] == detail::ChainLinks::none;
            const bool alone = end && next[i][0] == next[i][1];
            if (!taken[i] && !alone && (closed || end)) follow(i);
        }
    return result;
}

}  // namespace talus
