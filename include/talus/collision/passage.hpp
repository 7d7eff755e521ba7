// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/narrow_phase.hpp>
#include <talus/core/instantiate.hpp>
#include <talus/spatial/twist.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace talus {

/// A shape on its way: where it stands, and how far one step of its present twist would take it.
template <int Dim>
struct MovingShape {
    ShapeView<Dim> shape;
    Pose<Dim> pose;
    Twist<Dim> motion;  ///< displacement of the frame's origin and turn, world axes [m, rad]

    /// Whether its turning shows: that of a ball about its centre does not.
    bool turns() const {
        return !motion.angular.isZero(0.0) &&
               !(shape.kind() == ShapeKind::ball &&
                 shape.template as<Ball<Dim>>().centre().isZero(0.0));
    }
    /// Whether it is a polytope.
    bool flat_sided() const {
        return shape.kind() == ShapeKind::core && shape.core().radius == 0.0 &&
               shape.core().face_count() > 0;
    }
    /// Whether it turns little enough for where it gets to be foreseen.
    bool foreseeable() const;
    /// After `steps` such steps.
    Pose<Dim> pose_after(double steps) const {
        Pose<Dim> p{pose.position + steps * motion.linear, pose.rotation};
        if (turns())
            p.rotation = (Rotation<Dim>::exp(steps * motion.angular) * pose.rotation).normalized();
        return p;
    }
    /// The farthest point along d with the shape placed there; world axes.
    Vector<Dim> foremost(const Vector<Dim>& d, const Pose<Dim>& placed) const {
        return placed.point_world(shape.support(placed.rotation.transpose_times(d)));
    }
    /// Radius of a ball that holds the shape [m].
    double bound() const {
        if (shape.has_core()) return shape.core().bound;
        const Aabb<Dim> box = shape.aabb(Pose<Dim>{});
        return 0.5 * (box.high - box.low).norm();
    }
};

/// How far from now contacts look, and what they overlook.
struct Foresight {
    /// Motions are followed for this many steps, so that bodies that speed up within the step,
    /// up to this many times, are foreseen as well [-].
    static constexpr double steps = 2.0;
    /// Turn of a body in one step beyond which its motion is not followed [rad]: contacts then are
    /// those at the nearest points.
    static constexpr double most_turn = 0.2;
    /// Overlap along an axis that does not keep it from separating, in units of the smaller
    /// bounding radius: more than resting bodies overlap, less than anyone looks at [-].
    static constexpr double slack = 1e-3;
    /// The same where one of the two has no flat side: round bodies go from side to side without a
    /// jump, and more would let them sink by as much where they roll on each other.
    static constexpr double slack_round = 1e-6;
    /// The same in units of the thinner shape along the axis, so that no plate is overlooked [-].
    static constexpr double slack_of_width = 0.1;
    /// Axes tried one after the other on the way to the first touch. Spheres need five or so; an
    /// axis that was left unfinished is safe, but not the one at which the bodies meet.
    static constexpr int most_axes = 12;
};

template <int Dim>
bool MovingShape<Dim>::foreseeable() const {
    return !turns() || motion.angular.norm() <= Foresight::most_turn;
}

/// The side by which two convex bodies, now apart, can meet in a step.
///
/// A step keeps bodies apart by one plane for each pair, gap / h + u_n >= 0. The normal of the
/// nearest points is the right one for bodies that come straight at each other, but a box that
/// slides from one tile to the next has the edge of the next tile before it: the plane of the
/// nearest points would stop it there. Of all planes that separate two bodies now, the one to keep
/// is the one that the motion leaves last: bodies that pass each other never leave it, and bodies
/// that meet do so across it.
///
/// sep(n, s) = min over A of n.x - max over B of n.x with both bodies s steps ahead. An axis
/// qualifies if sep(n, 0) >= -slack; it is lost at the first s at which sep(n, s) < -slack, and
/// held if at none that is looked at. The search starts from the normal of the nearest points,
/// looks at the normals at the end of the motion, and then climbs: where an axis is lost, the
/// narrow phase names the next one, as in conservative advancement. Between an axis that is lost
/// and one that is held but was not separating at first there is one, across the motion, that is
/// both: that of bodies that pass a corner.
template <int Dim>
requires SpaceDimension<Dim>
class Passage {
  public:
    /// `near` has room for the contacts of one pair; `reach` [m] bounds what the two travel.
    Passage(const MovingShape<Dim>& a, const MovingShape<Dim>& b, std::span<const OwnPair<Dim>> own,
            SupportRoutine<Dim> by_support, double tolerance, double reach,
            std::vector<ContactPoint<Dim>>& near);

    /// Appends to `out` the contacts to keep in place of those at the nearest points, `present`.
    void append(std::span<const ContactPoint<Dim>> present, std::vector<ContactPoint<Dim>>& out);

  private:
    /// An axis of separation and where it was found.
    struct Axis {
        Vector<Dim> normal;
        double now, end;     ///< sep now, and the least of those at the ends of the steps [m]
        double slack;        ///< [m]
        double lost;         ///< steps until it is lost; infinite if it is held
        double found = 0.0;  ///< steps until the place of its contacts
        Vector<Dim> shift = Vector<Dim>::Zero();  ///< of A at that place, besides [m]
        bool across_motion = false;               ///< not a normal of contacts there

        bool held() const { return lost == std::numeric_limits<double>::infinity(); }
        bool qualifies() const { return now >= -slack; }
        /// How much of the foreseen motion its plane would take [m].
        double taken() const { return std::max(0.0, -(std::max(now, 0.0) + end - now)); }
    };

    double separation(const Vector<Dim>& n, const Pose<Dim>& a, const Pose<Dim>& b) const {
        return n.dot(a_.foremost(-n, a) - b_.foremost(n, b));
    }
    double separation(const Vector<Dim>& n, double steps) const {
        return separation(n, a_.pose_after(steps), b_.pose_after(steps));
    }
    double width(const MovingShape<Dim>& m, const Vector<Dim>& n) const {
        return n.dot(m.foremost(n, m.pose) - m.foremost(-n, m.pose));
    }
    Axis measured(const Vector<Dim>& n) const;
    double steps_until_lost(const Axis& axis, double middle) const;
    bool better(const Axis& x, const Axis& than) const;
    /// Finds the contacts with the bodies so far ahead; false if they are too far apart.
    bool look(double steps, const Vector<Dim>& shift);
    /// The best axis that follows from the normal found there: fixed, or turning with a body.
    Axis axis_from(const Vector<Dim>& n, double steps, const Vector<Dim>& shift) const;
    void try_at(double steps, const Vector<Dim>& shift, Axis& best);
    Axis across(const Axis& lost, const Axis& gained) const;
    void advance(Axis& best);
    Axis search(const Vector<Dim>& nearest);
    ContactPoint<Dim> brought_back(const ContactPoint<Dim>& point, const Axis& axis) const;
    ContactPoint<Dim> of_foremost_points(FeatureId feature, const Axis& axis) const;

    const MovingShape<Dim>&a_, &b_;
    std::array<Pose<Dim>, 2> one_ahead_, all_ahead_;
    std::span<const OwnPair<Dim>> own_;
    SupportRoutine<Dim> by_support_;
    double tolerance_, reach_, size_;
    bool turning_, flat_;
    std::vector<ContactPoint<Dim>>& near_;
};

#define TALUS_OF_PASSAGE(...) \
    template <int Dim>        \
    requires SpaceDimension<Dim> __VA_ARGS__ Passage<Dim>

TALUS_OF_PASSAGE()::Passage(const MovingShape<Dim>& a, const MovingShape<Dim>& b,
                            std::span<const OwnPair<Dim>> own, SupportRoutine<Dim> by_support,
                            double tolerance, double reach, std::vector<ContactPoint<Dim>>& near)
    : a_(a),
      b_(b),
      one_ahead_{a.pose_after(1.0), b.pose_after(1.0)},
      all_ahead_{a.pose_after(Foresight::steps), b.pose_after(Foresight::steps)},
      own_(own),
      by_support_(by_support),
      tolerance_(tolerance),
      reach_(reach),
      size_(std::min(a.bound(), b.bound())),
      turning_(a.turns() || b.turns()),
      flat_(a.flat_sided() && b.flat_sided()),
      near_(near) {}

TALUS_OF_PASSAGE(typename Passage<Dim>::Axis)::measured(const Vector<Dim>& n) const {
    Axis axis{n, separation(n, a_.pose, b_.pose), 0.0, 0.0, 0.0};
    const double thinner = std::min(width(a_, n), width(b_, n));
    axis.slack = std::min(tolerance_ + (flat_ ? Foresight::slack : Foresight::slack_round) * size_,
                          Foresight::slack_of_width * thinner);
    double middle, far;
    if (turning_) {
        middle = separation(n, one_ahead_[0], one_ahead_[1]);
        far = separation(n, all_ahead_[0], all_ahead_[1]);
    } else {
        const double change = n.dot(a_.motion.linear - b_.motion.linear);
        middle = axis.now + change;
        far = axis.now + Foresight::steps * change;
    }
    axis.end = std::min(middle, far);
    axis.lost = steps_until_lost(axis, middle);
    return axis;
}

/// By the rule of the secant, its bracket halved in between: one secant is exact for bodies that do
/// not turn. Turning bodies may dip below the slack and come back unseen between the ends of steps,
/// where nobody looks.
TALUS_OF_PASSAGE(double)::steps_until_lost(const Axis& axis, double middle) const {
    if (!axis.qualifies()) return 0.0;
    if (axis.end >= -axis.slack) return std::numeric_limits<double>::infinity();
    const bool soon = middle < -axis.slack;
    double low = 0.0, high = soon ? 1.0 : Foresight::steps;
    double above = axis.now + axis.slack, below = (soon ? middle : axis.end) + axis.slack;
    if (!turning_) return low + (high - low) * (above / (above - below));
    for (int k = 0; k < 16 && high - low > 1e-4; ++k) {
        const double share = k % 2 == 0 ? above / (above - below) : 0.5;
        const double s = low + (high - low) * share;
        const double at = separation(axis.normal, s) + axis.slack;
        if (at >= 0.0)
            low = s, above = at;
        else
            high = s, below = at;
    }
    return low;
}

TALUS_OF_PASSAGE(bool)::better(const Axis& x, const Axis& than) const {
    const double doubt = 1e-9 * size_;
    if (!x.qualifies()) return false;
    if (x.held() != than.held()) return x.held();
    if (!x.held()) return x.lost > than.lost + 1e-6;
    if (std::abs(x.taken() - than.taken()) > doubt) return x.taken() < than.taken();
    return x.end > than.end + doubt;
}

TALUS_OF_PASSAGE(bool)::look(double steps, const Vector<Dim>& shift) {
    near_.clear();
    Pose<Dim> a = a_.pose_after(steps);
    a.position += shift;
    // Apart by the reach at most now, and going as far in each step.
    const double margin = (1.0 + Foresight::steps) * reach_ + 2.0 * Foresight::slack * size_;
    NarrowPhase<Dim>(margin, own_, by_support_, near_)
        .append(a_.shape, a, b_.shape, b_.pose_after(steps));
    return !near_.empty();
}

TALUS_OF_PASSAGE(typename Passage<Dim>::Axis)::axis_from(const Vector<Dim>& n, double steps,
                                                         const Vector<Dim>& shift) const {
    Axis axis = measured(n);
    for (const MovingShape<Dim>* m : {&a_, &b_}) {
        if (!m->turns()) continue;
        const Axis turned =
            measured(m->pose.rotation * m->pose_after(steps).rotation.transpose_times(n));
        if (!axis.qualifies() || better(turned, axis)) axis = turned;
    }
    axis.found = steps;
    axis.shift = shift;
    return axis;
}

TALUS_OF_PASSAGE(void)::try_at(double steps, const Vector<Dim>& shift, Axis& best) {
    if (!look(steps, shift)) return;
    const auto nearest = std::ranges::min_element(near_, {}, &ContactPoint<Dim>::gap);
    const Axis axis = axis_from(nearest->normal, steps, shift);
    if (better(axis, best)) best = axis;
}

/// The positive combination of two axes whose separation the motion does not change. Where the one
/// is lost the other separates, and so does what is between them; and across the motion it did so
/// before and will do so afterwards.
TALUS_OF_PASSAGE(typename Passage<Dim>::Axis)::across(const Axis& lost, const Axis& gained) const {
    const auto change = [&](const Axis& axis) {
        return separation(axis.normal, one_ahead_[0], one_ahead_[1]) - axis.now;
    };
    const double down = std::max(-change(lost), 0.0), up = std::max(change(gained), 0.0);
    const Vector<Dim> n = up * lost.normal + down * gained.normal;
    if (!(n.norm() > 0.0)) return gained;
    Axis axis = measured(Vector<Dim>(n.normalized()));
    axis.found = gained.found;
    axis.across_motion = true;
    return axis;
}

/// From axis to axis, each lost later than the one before.
TALUS_OF_PASSAGE(void)::advance(Axis& best) {
    for (int k = 0; k < Foresight::most_axes && !best.held(); ++k) {
        const double lost = best.lost;
        if (!look(lost, Vector<Dim>::Zero())) return;
        const auto nearest = std::ranges::min_element(near_, {}, &ContactPoint<Dim>::gap);
        const Axis next = axis_from(nearest->normal, lost, Vector<Dim>::Zero());
        if (better(next, best)) {
            best = next;
        } else if (!next.qualifies()) {
            const Axis between = across(best, next);
            if (!better(between, best)) return;
            best = between;
        } else {
            best.found = lost;  // they meet here, and so the contacts are those of this place
            return;
        }
    }
}

TALUS_OF_PASSAGE(typename Passage<Dim>::Axis)::search(const Vector<Dim>& nearest) {
    Axis best = measured(nearest);
    for (const double steps : {1.0, Foresight::steps}) {
        if (best.held() && best.taken() == 0.0) return best;
        try_at(steps, Vector<Dim>::Zero(), best);
    }
    // Within the slack of two sides the narrow phase may name the wrong one: deeper in, it does
    // not.
    if (best.held() && best.taken() > 0.0)
        try_at(Foresight::steps, Vector<Dim>(-(best.end + 2.0 * best.slack) * best.normal), best);
    advance(best);
    return best;
}

/// The contact as it is to be seen now: the gap is less what the motion there adds to it, the arms
/// stay those of the place where the bodies meet.
TALUS_OF_PASSAGE(ContactPoint<Dim>)::brought_back(const ContactPoint<Dim>& point,
                                                  const Axis& axis) const {
    const Vector<Dim> way_a = axis.found * a_.motion.linear + axis.shift;
    const Vector<Dim> way_b = axis.found * b_.motion.linear;
    const Vector<Dim> arm_a = point.point - a_.pose.position - way_a;
    const Vector<Dim> arm_b = point.point - b_.pose.position - way_b;
    ContactPoint<Dim> result = point;
    result.point = point.point - 0.5 * (way_a + way_b);
    result.slide = way_a - way_b;
    result.gap -= axis.found * point.normal.dot(a_.motion.at(arm_a) - b_.motion.at(arm_b)) +
                  point.normal.dot(axis.shift);
    return result;
}

/// The one contact of an axis across the motion: where the bodies, as they stand, are foremost
/// along it. Arms that end elsewhere would let a turn do what the plane asks of the body.
TALUS_OF_PASSAGE(ContactPoint<Dim>)::of_foremost_points(FeatureId feature, const Axis& axis) const {
    const Vector<Dim>& n = axis.normal;
    const Vector<Dim> on_a = a_.foremost(-n, a_.pose), on_b = b_.foremost(n, b_.pose);
    const Vector<Dim> apart = on_a - on_b;
    return {0.5 * (on_a + on_b), n, axis.now, feature, n.dot(apart) * n - apart};
}

TALUS_OF_PASSAGE(void)::append(std::span<const ContactPoint<Dim>> present,
                               std::vector<ContactPoint<Dim>>& out) {
    const auto nearest = std::ranges::min_element(present, {}, &ContactPoint<Dim>::gap);
    const Axis axis = search(nearest->normal);
    // One point of a long body holds neither of its ends when other impulses turn it.
    const bool weak = axis.across_motion &&
                      (a_.shape.kind() != ShapeKind::ball && b_.shape.kind() != ShapeKind::ball);
    if (weak || axis.found == 0.0 || axis.normal.dot(nearest->normal) > 1.0 - 1e-12 ||
        !look(axis.found, axis.shift)) {
        out.insert(out.end(), present.begin(), present.end());
        return;
    }
    const double open = std::nextafter(tolerance_, std::numeric_limits<double>::infinity());
    if (axis.across_motion) {
        const auto named = std::ranges::min_element(near_, {}, &ContactPoint<Dim>::gap)->feature;
        near_.assign(1, of_foremost_points(named, axis));
    } else {
        for (ContactPoint<Dim>& point : near_) point = brought_back(point, axis);
    }
    double least = std::numeric_limits<double>::infinity();
    for (ContactPoint<Dim>& point : near_) {
        point.gap = std::max(point.gap, open);
        least = std::min(least, point.gap);
    }
    const double limit = std::max(reach_, least);
    for (const ContactPoint<Dim>& point : near_)
        if (point.gap <= limit) out.push_back(point);
}

#undef TALUS_OF_PASSAGE

}  // namespace talus

TALUS_IN_PLANE(class talus::Passage<2>)
TALUS_IN_SPACE(class talus::Passage<3>)
