// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/collision/narrow_phase.hpp>
#include <talus/core/column.hpp>
#include <talus/core/instantiate.hpp>
#include <talus/spatial/twist.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

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
    [[gnu::noinline]] Vector<Dim> foremost(const Vector<Dim>& d, const Pose<Dim>& placed) const {
        return placed.point_world(shape.support(placed.rotation.transpose_times(d)));
    }
};

/// How far from now contacts look, and what they overlook.
struct Foresight {
    /// Motions are followed for this many steps, so that bodies that speed up within the step,
    /// up to this many times, are foreseen as well [-].
    static constexpr double steps = 2.0;
    /// Turn of a body in one step beyond which its motion is not followed [rad]: contacts then are
    /// those at the nearest points.
    static constexpr double most_turn = 1.0;
    /// Overlap along an axis that does not keep it from separating, in units of the smaller
    /// bounding radius: more than resting bodies overlap, less than anyone looks at [-].
    static constexpr double slack = 1e-3;
    /// The same in units of the thinner shape along the axis, so that no plate is overlooked [-].
    static constexpr double slack_of_width = 0.1;
    /// Axes tried one after the other on the way to the first touch. An axis that was left
    /// unfinished is safe, but not the one at which the bodies meet.
    static constexpr int most_axes = 8;
};

template <int Dim>
bool MovingShape<Dim>::foreseeable() const {
    return !turns() || motion.angular.norm() <= Foresight::most_turn;
}

/// What was found out about two bodies that approach each other.
struct Meeting {
    bool disputed = false;  ///< there is more than one side that they might meet by
    double after = std::numeric_limits<double>::infinity();  ///< never, or so many steps from now
};

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
/// qualifies if sep(n, 0) >= -slack, and is lost at the first s at which sep(n, s) < -slack, taken
/// to be linear within a step; it is held if it is at none. Tried are the normal of the nearest
/// points and those of all faces; then, where the best of them is lost, the narrow phase names the
/// next, as in conservative advancement. If that one does not separate the bodies now, they pass a
/// corner of each other: between the two is an axis across the motion that does so all the way.
template <int Dim>
requires SpaceDimension<Dim>
class Passage {
  public:
    /// `near` has room for the contacts of one pair; `reach` [m] bounds what the two travel.
    Passage(const MovingShape<Dim>& a, const MovingShape<Dim>& b,
            const NarrowRoutines<Dim>& routines, double tolerance, double reach,
            Column<ContactPoint<Dim>>& near);

    /// Appends to `out` the contacts to keep in place of those at the nearest points, `present`:
    /// perhaps none.
    Meeting append(std::span<const ContactPoint<Dim>> present, Column<ContactPoint<Dim>>& out);

  private:
    struct Axis {
        Vector<Dim> normal;
        double now, next, last;  ///< sep(normal, s) at s = 0, 1, 2 [m]
        double lost;             ///< steps until it is lost; 0 if it does not qualify

        bool held() const { return lost == std::numeric_limits<double>::infinity(); }
        bool qualifies() const { return lost > 0.0; }
        double end() const { return std::min(next, last); }
    };
    enum class Outcome { meet, held, pass };

    double separation(const Vector<Dim>& n, const Pose<Dim>& a, const Pose<Dim>& b) const {
        return n.dot(a_.foremost(-n, a) - b_.foremost(n, b));
    }
    double width(const MovingShape<Dim>& m, const Vector<Dim>& n) const {
        return n.dot(m.foremost(n, m.pose) - m.foremost(-n, m.pose));
    }
    double slack(const Vector<Dim>& n) const;
    void look_ahead();
    Axis measured(const Vector<Dim>& n);
    bool better(const Axis& x, const Axis& than) const;
    /// Finds the contacts with the bodies so far ahead, A shifted; null if they are too far apart.
    const ContactPoint<Dim>* look(double steps, const Vector<Dim>& shift);
    /// Where the contact of least gap is.
    template <class Contacts>
    static auto nearest_of(Contacts& contacts) {
        return std::min_element(contacts.begin(), contacts.end(),
                                [](const auto& x, const auto& y) { return x.gap < y.gap; });
    }
    static CoreView<Dim> core_of(const ShapeView<Dim>& shape);
    void find_faces(const MovingShape<Dim>& m, const CoreView<Dim>& core, double sign,
                    std::span<const ContactPoint<Dim>> present);
    Outcome advance(Axis& best);
    bool find_place_along(const Axis& axis);
    Axis across(const Axis& lost, const Axis& gained);
    ContactPoint<Dim> brought_back(const ContactPoint<Dim>& point) const;
    ContactPoint<Dim> of_foremost_points(FeatureId feature, const Axis& axis) const;
    void append_near(double least_gap, Column<ContactPoint<Dim>>& out);

    const MovingShape<Dim>&a_, &b_;
    CoreView<Dim> core_a_, core_b_;
    const NarrowRoutines<Dim>& routines_;
    double tolerance_, reach_, size_;
    double most_slack_;  ///< [m]
    bool turning_;
    bool others_ = false;  ///< an axis other than that of the nearest points qualifies
    Vector<Dim> nearest_ = Vector<Dim>::Zero();  ///< normal at the nearest points
    Axis best_other_ = {};                       ///< of the faces
    Column<ContactPoint<Dim>>& near_;
    double seen_at_ = 0.0;                     ///< where `near_` is from [steps]
    Vector<Dim> shift_ = Vector<Dim>::Zero();  ///< of A, there [m]
    std::array<Pose<Dim>, 2> one_ahead_, all_ahead_;
    bool looked_ahead_ = false;  ///< the poses ahead are known
};

#define TALUS_OF_PASSAGE(...) \
    template <int Dim>        \
    requires SpaceDimension<Dim> __VA_ARGS__ Passage<Dim>

TALUS_OF_PASSAGE()::Passage(const MovingShape<Dim>& a, const MovingShape<Dim>& b,
                            const NarrowRoutines<Dim>& routines, double tolerance, double reach,
                            Column<ContactPoint<Dim>>& near)
    : a_(a),
      b_(b),
      core_a_(core_of(a.shape)),
      core_b_(core_of(b.shape)),
      routines_(routines),
      tolerance_(tolerance),
      reach_(reach),
      size_(std::min(core_a_.bound, core_b_.bound)),
      most_slack_(tolerance + Foresight::slack * size_),
      turning_(a.turns() || b.turns()),
      near_(near) {}

/// That of a shape known by its support alone has nothing but the bound.
TALUS_OF_PASSAGE(CoreView<Dim>)::core_of(const ShapeView<Dim>& shape) {
    if (shape.has_core()) return shape.core();
    const Aabb<Dim> box = shape.aabb(Pose<Dim>{});
    CoreView<Dim> core{};
    core.bound = 0.5 * (box.high - box.low).norm();
    return core;
}

TALUS_OF_PASSAGE(double)::slack(const Vector<Dim>& n) const {
    return std::min(most_slack_, Foresight::slack_of_width * std::min(width(a_, n), width(b_, n)));
}

TALUS_OF_PASSAGE(void)::look_ahead() {
    if (looked_ahead_) return;
    one_ahead_ = {a_.pose_after(1.0), b_.pose_after(1.0)};
    all_ahead_ = {a_.pose_after(Foresight::steps), b_.pose_after(Foresight::steps)};
    looked_ahead_ = true;
}

TALUS_OF_PASSAGE(typename Passage<Dim>::Axis)::measured(const Vector<Dim>& n) {
    Axis axis{n, separation(n, a_.pose, b_.pose), 0.0, 0.0, 0.0};
    if (axis.now < -most_slack_) return axis;
    const double slack = this->slack(n);
    if (axis.now < -slack) return axis;
    if (turning_) {
        look_ahead();
        axis.next = separation(n, one_ahead_[0], one_ahead_[1]);
        axis.last = separation(n, all_ahead_[0], all_ahead_[1]);
    } else {
        const double change = n.dot(a_.motion.linear - b_.motion.linear);
        axis.next = axis.now + change;
        axis.last = axis.now + Foresight::steps * change;
    }
    const auto crossing = [&](double above, double below) {
        return std::max((above + slack) / (above - below), 1e-12);
    };
    axis.lost = axis.next < -slack ? crossing(axis.now, axis.next)
                : axis.last < -slack
                    ? 1.0 + (Foresight::steps - 1.0) * crossing(axis.next, axis.last)
                    : std::numeric_limits<double>::infinity();
    return axis;
}

TALUS_OF_PASSAGE(bool)::better(const Axis& x, const Axis& than) const {
    if (x.held() && than.held()) return x.end() > than.end() + 1e-9 * size_;
    return x.lost > than.lost + 1e-6;
}

TALUS_OF_PASSAGE(const ContactPoint<Dim>*)::look(double steps, const Vector<Dim>& shift) {
    near_.clear();
    seen_at_ = steps;
    shift_ = shift;
    Pose<Dim> a = a_.pose_after(steps);
    a.position += shift;
    // Apart by the reach at most now, and going as far in each step.
    const double margin = (1.0 + Foresight::steps) * reach_ + 2.0 * Foresight::slack * size_;
    NarrowPhase<Dim>(margin, routines_, near_).append(a_.shape, a, b_.shape, b_.pose_after(steps));
    if (near_.empty()) return nullptr;
    return &*nearest_of(near_);
}

/// Notes the faces that the other body's part in every present contact is beyond, as all of it is
/// if the face separates: this rules out most faces at little cost.
TALUS_OF_PASSAGE(void)::find_faces(const MovingShape<Dim>& m, const CoreView<Dim>& core,
                                   double sign, std::span<const ContactPoint<Dim>> present) {
    const auto of_other = [&](const ContactPoint<Dim>& c) {
        return m.pose.point_body(c.point + 0.5 * sign * c.gap * c.normal);
    };
    const auto try_face = [&](std::size_t f, const Vector<Dim>& point) {
        return core.normals[f].dot(point) >=
               core.offsets[f] + core.radius - most_slack_ - 1e-6 * size_;
    };
    const Vector<Dim> nearest = m.pose.rotation.transpose_times(nearest_);
    const Vector<Dim> first = of_other(present.front());
    for (std::size_t f = 0; f < core.face_count(); ++f) {
        if (!try_face(f, first) && routines_.own.empty()) continue;
        if (sign * core.normals[f].dot(nearest) > 1.0 - 1e-12) continue;
        bool separates = true;
        for (std::size_t c = 1; separates && c < present.size() && routines_.own.empty(); ++c)
            separates = try_face(f, of_other(present[c]));
        if (!separates) continue;
        const Axis axis = measured(Vector<Dim>(sign * (m.pose.rotation * core.normals[f])));
        others_ |= axis.qualifies();
        if (better(axis, best_other_)) best_other_ = axis;
    }
}

/// From axis to axis, each lost later than the one before, to the place where the bodies touch.
TALUS_OF_PASSAGE(typename Passage<Dim>::Outcome)::advance(Axis& best) {
    for (int k = 0; k < Foresight::most_axes && !best.held(); ++k) {
        const ContactPoint<Dim>* nearest = look(best.lost, Vector<Dim>::Zero());
        if (!nearest) return Outcome::pass;
        if (nearest->normal.dot(best.normal) > 1.0 - 1e-10) return Outcome::meet;
        const Axis next = measured(nearest->normal);
        if (!next.qualifies()) {
            best = across(best, next);
            return Outcome::pass;
        }
        if (!better(next, best)) return Outcome::meet;
        best = next;
    }
    return best.held() ? Outcome::held : Outcome::meet;
}

/// Bodies that an axis keeps apart can touch across it only where the one is over the other.
TALUS_OF_PASSAGE(bool)::find_place_along(const Axis& axis) {
    const double deeper = 2.0 * slack(axis.normal);
    for (const double steps : {1.0, Foresight::steps}) {
        const double apart = steps == 1.0 ? axis.next : axis.last;
        const ContactPoint<Dim>* nearest =
            look(steps, Vector<Dim>(-(apart + deeper) * axis.normal));
        if (nearest && nearest->normal.dot(axis.normal) > 1.0 - 1e-3) return true;
    }
    return false;
}

/// The positive combination of two axes whose separation the motion does not change. Where the one
/// is lost the other separates, and so does what is between them; and across the motion it did so
/// before and will do so afterwards.
TALUS_OF_PASSAGE(typename Passage<Dim>::Axis)::across(const Axis& lost, const Axis& gained) {
    look_ahead();
    const auto change = [&](const Vector<Dim>& n) {
        return separation(n, one_ahead_[0], one_ahead_[1]) - separation(n, a_.pose, b_.pose);
    };
    const double down = std::max(-change(lost.normal), 0.0);
    const double up = std::max(change(gained.normal), 0.0);
    const Vector<Dim> n = up * lost.normal + down * gained.normal;
    return n.norm() > 0.0 ? measured(Vector<Dim>(n.normalized())) : gained;
}

/// The contact as it is to be seen now: the gap is less what the motion there adds to it, the arms
/// stay those of the place where the bodies meet.
TALUS_OF_PASSAGE(ContactPoint<Dim>)::brought_back(const ContactPoint<Dim>& point) const {
    const Vector<Dim> way_a = seen_at_ * a_.motion.linear + shift_;
    const Vector<Dim> way_b = seen_at_ * b_.motion.linear;
    const Vector<Dim> arm_a = point.point - a_.pose.position - way_a;
    const Vector<Dim> arm_b = point.point - b_.pose.position - way_b;
    ContactPoint<Dim> result = point;
    result.point = point.point - 0.5 * (way_a + way_b);
    result.slide = way_a - way_b;
    result.gap -= seen_at_ * point.normal.dot(a_.motion.at(arm_a) - b_.motion.at(arm_b)) +
                  point.normal.dot(shift_);
    return result;
}

/// The one contact of an axis across the motion: where the bodies, as they stand, are foremost
/// along it. Arms that end elsewhere would let a turn do what the plane asks of the body.
TALUS_OF_PASSAGE(ContactPoint<Dim>)::of_foremost_points(FeatureId feature, const Axis& axis) const {
    const Vector<Dim>& n = axis.normal;
    const Vector<Dim> on_a = a_.foremost(-n, a_.pose), on_b = b_.foremost(n, b_.pose);
    const Vector<Dim> apart = on_a - on_b;
    return {0.5 * (on_a + on_b), n, axis.now, feature, -apart};
}

TALUS_OF_PASSAGE(void)::append_near(double least_gap, Column<ContactPoint<Dim>>& out) {
    double least = std::numeric_limits<double>::infinity();
    for (ContactPoint<Dim>& point : near_) {
        point.gap = std::max(point.gap, least_gap);
        least = std::min(least, point.gap);
    }
    const double limit = std::max(reach_, least);
    for (const ContactPoint<Dim>& point : near_)
        if (point.gap <= limit) out.push_back(point);
}

TALUS_OF_PASSAGE(Meeting)::append(std::span<const ContactPoint<Dim>> present,
                                  Column<ContactPoint<Dim>>& out) {
    const auto nearest = nearest_of(present);
    const bool closed = nearest->gap <= tolerance_;
    nearest_ = nearest->normal;
    find_faces(a_, core_a_, -1.0, present);
    find_faces(b_, core_b_, 1.0, present);
    if (!others_ && nearest->gap <= most_slack_) {
        out.append(present);
        return {};
    }
    Axis best = measured(nearest_);
    if (better(best_other_, best)) best = best_other_;
    Outcome outcome = best.held() ? Outcome::held : Outcome::meet;
    if (!closed && !best.held()) outcome = advance(best);
    const bool is_first = best.normal.dot(nearest_) > 1.0 - 1e-12;
    const Meeting meeting{others_ || !is_first, best.lost};
    // A closed contact keeps bodies apart now, unless another axis does so all the way; and the
    // corners of bodies that touch within the slack are no places to pass.
    const bool stays =
        outcome == Outcome::pass ? !best.held() : is_first || (closed && outcome == Outcome::meet);
    if (stays) {
        out.append(present);
        return meeting;
    }
    if (outcome == Outcome::pass)
        near_.assign(1, of_foremost_points(nearest->feature, best));
    else if (outcome == Outcome::held && !find_place_along(best))
        return meeting;
    else
        for (ContactPoint<Dim>& point : near_) point = brought_back(point);
    append_near(
        closed ? nearest->gap : std::nextafter(tolerance_, std::numeric_limits<double>::infinity()),
        out);
    return meeting;
}

#undef TALUS_OF_PASSAGE

}  // namespace talus

TALUS_IN_PLANE(class talus::Passage<2>)
TALUS_IN_SPACE(class talus::Passage<3>)
