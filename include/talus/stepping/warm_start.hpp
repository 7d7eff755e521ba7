// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/assembly/impulse_cache.hpp>
#include <talus/core/column.hpp>
#include <talus/core/input.hpp>
#include <talus/core/instantiate.hpp>
#include <talus/dynamics/bodies.hpp>
#include <talus/dynamics/run_state.hpp>
#include <talus/stepping/step_data.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

namespace talus {

/// What a step leaves to the next one: the impulses by contact, and the step size that they are of.
/// Follows the bodies when some are removed; the last step can be taken back.
template <int Dim>
requires SpaceDimension<Dim>
class WarmStart {
  public:
    ImpulseCache<Dim>& impulses() { return cache_; }
    const ImpulseCache<Dim>& impulses() const { return cache_; }

    /// Follows the bodies that were removed since the last step: they are forgotten, the others
    /// found again by their ids. O(bodies + contacts).
    void follow(const Bodies<Dim>& bodies);
    /// Begins a step, whose problem is known: fills its impulses with those remembered.
    template <class Law>
    void recall(StepData<Dim, Law>& data) const {
        data.impulse.resize(data.contact_count());
        data.recalled =
            cache_.recall(data.contacts, data.problem.jacobian, data.impulse, scale_of(data));
        if constexpr (has_rolling_rows<Law>) {
            data.moment.resize(data.contact_count());
            cache_.recall_moments(data.contacts, data.moment, scale_of(data));
        }
    }
    /// The impulses of a step that was solved, or, if `worth` is false, none; `keep` makes them
    /// those remembered.
    template <class Law>
    void store(const StepData<Dim, Law>& data, bool worth) {
        next_.clear();
        if (worth) next_.store(data.contacts, data.problem.jacobian, data.impulse, data.moment);
    }
    void keep(double of_step) noexcept {
        std::swap(cache_, next_);
        before_ = std::exchange(last_h_, of_step);
    }
    /// Takes the last `keep` back. Once.
    void undo() noexcept {
        std::swap(cache_, next_);
        last_h_ = before_;
    }

    /// What the next step of the bodies of `state` begins with, into it.
    template <class ShapeType>
    void write_to(RunState<Dim, ShapeType>& state) const {
        ImpulseCache<Dim> cache = cache_;
        renumber(cache, state.bodies);
        state.key.assign(cache.keys().begin(), cache.keys().end());
        state.impulse.assign(cache.impulses().begin(), cache.impulses().end());
        state.moment.assign(cache.moments().begin(), cache.moments().end());
        state.last_h = last_h_;
    }
    /// That of a state, whose bodies are those of the next step. Throws input_error, and remembers
    /// what it did, where it is not in order.
    template <class ShapeType>
    void restore(const RunState<Dim, ShapeType>& state) {
        const auto count = static_cast<BodyIndex>(state.bodies.count());
        for (const ContactKey& key : state.key)
            if (key.a < 0 || key.a >= key.b || key.b >= count)
                throw input_error(
                    "contact to be remembered is of bodies " + std::to_string(key.a) + " and " +
                    std::to_string(key.b) +
                    detail::numbered(", but must be of two below", state.bodies.count()));
        require_non_negative("last step size", state.last_h);
        remembered_.reserve(state.bodies.count());
        cache_.assign(state.key, state.impulse, state.moment);
        remembered_ = state.bodies.id;
        last_h_ = state.last_h;
    }

  private:
    /// Of the impulses remembered, in a step of another size.
    template <class Law>
    double scale_of(const StepData<Dim, Law>& data) const {
        return last_h_ > 0.0 ? data.h / last_h_ : 1.0;
    }
    void renumber(ImpulseCache<Dim>& cache, const Bodies<Dim>& bodies) const;

    ImpulseCache<Dim> cache_, next_;  // next_: of the step under way, or before the last
    Column<BodyId> remembered_;       // bodies that the cache numbers
    double last_h_ = 0.0, before_ = 0.0;
};

template <int Dim>
requires SpaceDimension<Dim>
void WarmStart<Dim>::follow(const Bodies<Dim>& bodies) {
    remembered_.reserve(bodies.id.size());  // what may throw comes first
    renumber(cache_, bodies);
    remembered_ = bodies.id;
}

/// Of a memory of `remembered_` one of the bodies there are.
template <int Dim>
requires SpaceDimension<Dim>
void WarmStart<Dim>::renumber(ImpulseCache<Dim>& cache, const Bodies<Dim>& bodies) const {
    // Ids ascend: whoever was remembered is where it was unless somebody before it has gone.
    const auto& ids = bodies.id;
    if (remembered_.size() <= ids.size() &&
        std::equal(remembered_.begin(), remembered_.end(), ids.begin()))
        return;
    Column<BodyIndex> to(remembered_.size(), -1);
    for (std::size_t i = 0, j = 0; i < remembered_.size(); ++i) {
        while (j < ids.size() && ids[j] < remembered_[i]) ++j;
        if (j < ids.size() && ids[j] == remembered_[i]) to[i] = static_cast<BodyIndex>(j);
    }
    cache.renumber(to);
}

}  // namespace talus

TALUS_IN_PLANE(class talus::WarmStart<2>)
TALUS_IN_SPACE(class talus::WarmStart<3>)
