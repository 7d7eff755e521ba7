// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/number_record.hpp>
#include <talus/stepping/system.hpp>

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace talus {

/// Takes free bodies out of a system whose centres are where it is, as an observer of its run, and
/// counts them: the plane below an outlet, the world beyond a container.
///
///     Sink<3> sink = Sink<3>::below({0, 0, 1}, -0.5);
///     const RunSummary run = sim.run(10.0, [&](auto&) { sink.drain(sim.system()); });
template <int Dim>
requires SpaceDimension<Dim>
class Sink {
  public:
    /// Wherever `takes(centre)` holds. Throws input_error if it is empty.
    explicit Sink(std::function<bool(const Vector<Dim>&)> takes) : takes_(std::move(takes)) {
        if (!takes_) throw input_error("place of the sink is empty, but must be callable");
    }
    /// Points x with normal . x < offset [m]; the normal is normalised. Throws input_error unless
    /// it has a length.
    static Sink below(const Vector<Dim>& normal, double offset) {
        require_finite("normal of the sink", normal);
        require_in("offset of the sink", offset, -1e300, 1e300);
        const Vector<Dim> n =
            normal / require_positive("length of the sink's normal", normal.norm());
        return Sink([n, offset](const Vector<Dim>& x) { return n.dot(x) < offset; });
    }
    /// Outside the box between two corners [m]. Throws input_error unless low < high.
    static Sink outside(const Vector<Dim>& low, const Vector<Dim>& high) {
        for (int k = 0; k < Dim; ++k)
            if (!(low[k] < high[k]))
                detail::reject("high corner of the sink", high[k],
                               "above the low one, " + detail::text_of(low[k]));
        return Sink([low, high](const Vector<Dim>& x) {
            return (x - low).minCoeff() < 0.0 || (high - x).minCoeff() < 0.0;
        });
    }

    /// Removes the bodies that are there; returns how many. O(bodies).
    template <class Law, class ShapeType>
    std::size_t drain(System<Dim, Law, ShapeType>& system) {
        taken_.clear();
        for (std::size_t i = 0; i < system.bodies.count(); ++i)
            if (!system.bodies.is_obstacle(i) && takes_(system.bodies.position[i]))
                taken_.push_back(system.bodies.id[i]);
        if (taken_.empty()) return 0;
        double mass = 0.0;
        for (const BodyId id : taken_) mass += system.bodies.mass(system.bodies.index(id));
        system.remove(taken_);
        count_ += static_cast<std::int64_t>(taken_.size());
        mass_ += mass;
        return taken_.size();
    }

    std::int64_t count() const { return count_; }  ///< taken so far
    double mass() const { return mass_; }          ///< of them [kg]
    /// Of those of the last `drain`.
    const std::vector<BodyId>& taken() const { return taken_; }

    /// How much it took; where it is the program says again.
    void write(NumberRecord& out) const {
        out.integer(count_);
        out.real(mass_);
    }
    void restore(const NumberRecord& record) {
        NumberRecordReader in(record);
        const auto count = in.integer(0);
        const double mass = require_non_negative("mass that the sink took", in.real());
        in.require_end();
        count_ = count;
        mass_ = mass;
    }

  private:
    std::function<bool(const Vector<Dim>&)> takes_;
    std::vector<BodyId> taken_;
    std::int64_t count_ = 0;
    double mass_ = 0.0;
};

}  // namespace talus
