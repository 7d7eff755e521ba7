// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/contact_set.hpp>
#include <talus/core/column.hpp>
#include <talus/core/input.hpp>
#include <talus/core/room.hpp>
#include <talus/problem/contact_problem.hpp>

#include <cstddef>
#include <span>
#include <utility>

namespace talus {

/// Carries impulses from step to step by contact key: the warm start of [Moreau] section 2.1,
/// "whenever the same contact was already in effect". Impulses are kept in world axes, so that the
/// choice of tangents does not matter. Keys are sorted, so recall and store cost O(contacts).
/// With rolling friction the moment impulses on the first body go with them.
template <int Dim>
requires SpaceDimension<Dim>
class ImpulseCache {
  public:
    /// Fills r (local axes) with the impulses of the contacts that were there before, times `scale`
    /// (the ratio of step sizes); zero for new contacts. Returns how many were recalled.
    std::size_t recall(const ContactSet<Dim>& contacts, const ContactJacobian<Dim>& jacobian,
                       std::span<Vector<Dim>> r, double scale = 1.0) const {
        std::size_t old = 0;
        std::size_t recalled = 0;
        for (std::size_t c = 0; c < contacts.count(); ++c) {
            while (old < key_.size() && key_[old] < contacts.key[c]) ++old;
            if (old < key_.size() && key_[old] == contacts.key[c]) {
                r[c] = scale * (jacobian.frame[c] * impulse_[old]);
                ++recalled;
            } else {
                r[c].setZero();
            }
        }
        return recalled;
    }
    /// The same for their moments, world axes: zero where none were stored.
    void recall_moments(const ContactSet<Dim>& contacts, std::span<AngularVector<Dim>> moments,
                        double scale = 1.0) const {
        std::size_t old = 0;
        for (std::size_t c = 0; c < contacts.count(); ++c) {
            while (old < moment_.size() && key_[old] < contacts.key[c]) ++old;
            const bool known = old < moment_.size() && key_[old] == contacts.key[c];
            moments[c] = known ? scale * moment_[old] : AngularVector<Dim>::Zero();
        }
    }

    /// Replaces the memory by the impulses r (local axes) of these contacts, and their moments
    /// (world axes) if they have some.
    void store(const ContactSet<Dim>& contacts, const ContactJacobian<Dim>& jacobian,
               std::span<const Vector<Dim>> r, std::span<const AngularVector<Dim>> moments = {}) {
        detail::make_room(key_, r.size());
        key_ = contacts.key;
        impulse_.resize(r.size());
        for (std::size_t c = 0; c < r.size(); ++c)
            impulse_[c] = jacobian.frame[c].transpose() * r[c];
        if (!moments.empty()) detail::make_room(moment_, moments.size());
        moment_.assign(moments);
    }

    /// After bodies were removed: `to` is the new index of each old one, ascending, -1 for those
    /// that are gone, whose contacts are forgotten. O(contacts).
    void renumber(std::span<const BodyIndex> to) {
        std::size_t kept = 0;
        for (std::size_t c = 0; c < key_.size(); ++c) {
            const BodyIndex a = to[static_cast<std::size_t>(key_[c].a)];
            const BodyIndex b = to[static_cast<std::size_t>(key_[c].b)];
            if (a < 0 || b < 0) continue;
            key_[kept] = {a, b, key_[c].feature, key_[c].image};
            impulse_[kept] = impulse_[c];
            if (!moment_.empty()) moment_[kept] = moment_[c];
            ++kept;
        }
        key_.resize(kept);
        impulse_.resize(kept);
        if (!moment_.empty()) moment_.resize(kept);
    }

    /// Replaces the memory by these contacts, ascending, and impulses in world axes, with their
    /// moments or none. Throws input_error, and remembers what it did, unless they are so, as many
    /// as each other and finite.
    void assign(Column<ContactKey> key, Column<Vector<Dim>> impulse,
                Column<AngularVector<Dim>> moment = {}) {
        require_count("impulses remembered", impulse.size(), "contacts", key.size());
        if (!moment.empty())
            require_count("moments remembered", moment.size(), "contacts", key.size());
        for (std::size_t c = 0; c < key.size(); ++c) {
            require_finite("impulse remembered", impulse[c]);
            if (!moment.empty()) require_finite("moment remembered", moment[c]);
            if (c > 0 && !(key[c - 1] < key[c]))
                throw input_error(detail::numbered("contact", c,
                                                   " to be remembered is not after the one before, "
                                                   "but must be"));
        }
        key_ = std::move(key);
        impulse_ = std::move(impulse);
        moment_ = std::move(moment);
    }

    void clear() {
        key_.clear();
        impulse_.clear();
        moment_.clear();
    }
    std::size_t size() const { return key_.size(); }
    std::span<const ContactKey> keys() const { return key_; }
    std::span<const Vector<Dim>> impulses() const { return impulse_; }  ///< world axes [N s]
    /// On the first body, world axes [N m s]; empty without rolling friction.
    std::span<const AngularVector<Dim>> moments() const { return moment_; }

  private:
    Column<ContactKey> key_;
    Column<Vector<Dim>> impulse_;
    Column<AngularVector<Dim>> moment_;
};

}  // namespace talus
