// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/assembly/stopped_motion.hpp>
#include <talus/collision/contact_set.hpp>
#include <talus/collision/passage.hpp>
#include <talus/core/column.hpp>
#include <talus/core/instantiate.hpp>
#include <talus/dynamics/bodies.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

namespace talus {

/// Contacts by what the motion of the bodies will make of them (see Passage): those of bodies that
/// are apart, and of bodies that touch at a side which they slide past, as flush tiles do.
///
/// Which side two bodies meet depends on what else is in the way: the floor under a body that lands
/// keeps it from the sides of the tiles. So contacts of pairs that can meet across one side alone,
/// which are what they are, hold up their bodies first (StoppedMotion); then the others are decided
/// on, in the order in which they would meet, each by the motion that those before have left.
template <int Dim>
requires SpaceDimension<Dim>
class AnticipatedContacts {
  public:
    /// Starts a step; `motion` is that of each body over one step [m, rad], `routines` are those
    /// for all shapes that come.
    void begin(const Bodies<Dim>& bodies, std::span<const Twist<Dim>> motion,
               const NarrowRoutines<Dim>& routines, double tolerance);

    /// Takes `points`, what the narrow phase found for bodies a and b up to the gap `reach` [m].
    /// Pairs come in their order.
    /// In a periodic cell body a meets an image of b, where a is; pairs come in the order of images
    /// within that of bodies.
    template <class A, class B>
    requires CanMeet<A, B, Dim>
    void add(BodyIndex a, const A& shape_a, BodyIndex b, const B& shape_b, double reach,
             std::span<const ContactPoint<Dim>> points, const BodyImage<Dim>& image = {}) {
        if (!points.empty())
            add({a, b, view_of<Dim>(shape_a), view_of<Dim>(shape_b), reach, image}, points);
    }

    /// Appends the contacts of all pairs, sorted. In the place of those that the motion would close
    /// are the ones that it leads to. Those of half-spaces, which have one normal alone, and of
    /// shapes without a support mapping stay. What takes the place of open contacts, of gap >
    /// tolerance, is open. `in_cell`: contacts get the offsets of images.
    void finish(ContactSet<Dim>& contacts, bool in_cell = false);

  private:
    /// Two convex parts of bodies, and where their contacts are in `found_`.
    struct Encounter {
        BodyIndex a, b;
        ShapeView<Dim> shape_a, shape_b;
        double reach;
        BodyImage<Dim> image = {};  ///< of b
        std::uint32_t child_a = 0, child_b = 0;
        std::size_t first = 0, count = 0;            ///< contacts at the nearest points
        std::size_t kept_first = 0, kept_count = 0;  ///< contacts to keep
        Meeting meeting = {};
    };

    void add(const Encounter& pair, std::span<const ContactPoint<Dim>> points);
    void add_parts(const Encounter& pair, std::span<const ContactPoint<Dim>> points);
    /// Approaches of less are noise of bodies at rest, in units of the reach [-].
    static constexpr double least_approach = 1e-3;
    /// Whether the foreseen motion would close some contact, or closes one further: else they are
    /// good as they are. Closed are those of gap <= tolerance.
    bool concerns(const Encounter& e) const;
    /// How far A goes past B there in one step.
    [[gnu::noinline]] Vector<Dim> change_at(const Encounter& e, const Vector<Dim>& point) const {
        return motion_.motion(e.a).at(point - bodies_->position[e.a]) -
               motion_.motion(e.b).at(point - (bodies_->position[e.b] + e.image.offset)) -
               e.image.motion;
    }
    bool has_sides(const Encounter& e) const;
    /// Whether two round bodies go past each other by enough for their normal to turn: else that of
    /// the nearest points is theirs.
    bool turns_around(const Encounter& e) const;
    /// Looks for the contacts that the motion as now known leads to.
    void judge(Encounter& e);
    bool hold_up_bodies(const Encounter& e);
    void decide_disputes();

    std::span<const ContactPoint<Dim>> nearest_of(const Encounter& e) const {
        return std::span(found_).subspan(e.first, e.count);
    }
    std::span<const ContactPoint<Dim>> kept_of(const Encounter& e) const {
        return std::span(found_).subspan(e.kept_first, e.kept_count);
    }
    MovingShape<Dim> moving(BodyIndex i, const ShapeView<Dim>& shape) const;
    MovingShape<Dim> moving_a(const Encounter& e) const { return moving(e.a, e.shape_a); }
    MovingShape<Dim> moving_b(const Encounter& e) const {
        MovingShape<Dim> b = moving(e.b, e.shape_b);
        b.pose.position += e.image.offset;
        b.motion.linear += e.image.motion;
        return b;
    }

    const Bodies<Dim>* bodies_ = nullptr;
    NarrowRoutines<Dim> routines_;
    double tolerance_ = 0.0;
    StoppedMotion<Dim> motion_;
    Column<Encounter> encounters_;
    Column<std::size_t> disputed_;     // encounters
    Column<ContactPoint<Dim>> found_;  // by encounter; disputed ones also in the end
    Column<ContactPoint<Dim>> near_, result_;
};

#define TALUS_OF_ANTICIPATED(...) \
    template <int Dim>            \
    requires SpaceDimension<Dim> __VA_ARGS__ AnticipatedContacts<Dim>

TALUS_OF_ANTICIPATED(void)::begin(const Bodies<Dim>& bodies, std::span<const Twist<Dim>> motion,
                                  const NarrowRoutines<Dim>& routines, double tolerance) {
    constexpr std::size_t usual = 64;  // contacts of one pair
    near_.reserve(usual);
    result_.reserve(usual);
    encounters_.reserve(usual);
    disputed_.reserve(usual);
    found_.reserve(4 * usual);
    bodies_ = &bodies;
    routines_ = routines;
    tolerance_ = tolerance;
    motion_.begin(bodies, motion);
    encounters_.clear();
    disputed_.clear();
    found_.clear();
}

TALUS_OF_ANTICIPATED(MovingShape<Dim>)::moving(BodyIndex i, const ShapeView<Dim>& shape) const {
    return {shape, bodies_->pose(static_cast<std::size_t>(i)), motion_.motion(i)};
}

TALUS_OF_ANTICIPATED(void)::add(const Encounter& pair, std::span<const ContactPoint<Dim>> points) {
    const bool compound =
        pair.shape_a.kind() == ShapeKind::compound || pair.shape_b.kind() == ShapeKind::compound;
    // A routine of one's own may serve a compound as a whole.
    const auto is_theirs = [&](const OwnPair<Dim>& own) {
        return (own.a == pair.shape_a.access && own.b == pair.shape_b.access) ||
               (own.a == pair.shape_b.access && own.b == pair.shape_a.access);
    };
    bool whole = !compound;
    for (const OwnPair<Dim>& own : routines_.own) whole = whole || is_theirs(own);
    if (whole) {
        add_parts(pair, points);
        return;
    }
    const auto children = [](const ContactPoint<Dim>& c) {
        return std::pair(child_of_a(c.feature), child_of_b(c.feature));
    };
    for (auto first = points.begin(); first != points.end();) {
        auto last = first + 1;
        while (last != points.end() && children(*last) == children(*first)) ++last;
        Encounter part = pair;
        part.child_a = children(*first).first;
        part.child_b = children(*first).second;
        if (pair.shape_a.kind() == ShapeKind::compound)
            part.shape_a = pair.shape_a.child(part.child_a);
        if (pair.shape_b.kind() == ShapeKind::compound)
            part.shape_b = pair.shape_b.child(part.child_b);
        add_parts(part, {first, last});
        first = last;
    }
}

TALUS_OF_ANTICIPATED(void)::add_parts(const Encounter& pair,
                                      std::span<const ContactPoint<Dim>> points) {
    Encounter e = pair;
    e.first = found_.size();
    e.count = points.size();
    found_.append(points);
    e.kept_first = e.first;
    e.kept_count = e.count;
    if (concerns(e) && has_sides(e)) {
        judge(e);
        if (e.meeting.disputed) disputed_.push_back(encounters_.size());
    }
    encounters_.push_back(e);
}

TALUS_OF_ANTICIPATED(bool)::concerns(const Encounter& e) const {
    const auto closes = [&](const ContactPoint<Dim>& c) {
        const double way = Foresight::steps * c.normal.dot(change_at(e, c.point));
        return c.gap > tolerance_ ? c.gap + way < 0.0 : way < -least_approach * e.reach;
    };
    for (const ContactPoint<Dim>& c : nearest_of(e))
        if (closes(c)) return true;
    return false;
}

TALUS_OF_ANTICIPATED(bool)::has_sides(const Encounter& e) const {
    return e.shape_a.access->support && e.shape_b.access->support && !e.shape_a.is_wall() &&
           !e.shape_b.is_wall() &&
           (e.shape_a.kind() == ShapeKind::core || e.shape_b.kind() == ShapeKind::core ||
            turns_around(e)) &&
           moving_a(e).foreseeable() && moving_b(e).foreseeable();
}

TALUS_OF_ANTICIPATED(bool)::turns_around(const Encounter& e) const {
    constexpr double least_turn = 0.01;  // [rad]: an error of 5e-5 of the size in the gap
    const auto size = [](const ShapeView<Dim>& shape) {
        const Aabb<Dim> box = shape.aabb(Pose<Dim>{});
        return 0.5 * (box.high - box.low).maxCoeff();
    };
    const ContactPoint<Dim>& c = nearest_of(e).front();
    const Vector<Dim> change = change_at(e, c.point);
    const Vector<Dim> past = change - c.normal * c.normal.dot(change);
    return Foresight::steps * past.norm() > least_turn * std::min(size(e.shape_a), size(e.shape_b));
}

TALUS_OF_ANTICIPATED(void)::judge(Encounter& e) {
    result_.clear();
    const MovingShape<Dim> a = moving_a(e), b = moving_b(e);
    e.meeting =
        Passage<Dim>(a, b, routines_, tolerance_, e.reach, near_).append(nearest_of(e), result_);
    if (!e.meeting.disputed) return;
    for (ContactPoint<Dim>& c : result_) {
        c.feature = with_child_of_a(c.feature, e.child_a);
        c.feature = with_child_of_b(c.feature, e.child_b);
    }
    e.kept_first = found_.size();
    e.kept_count = result_.size();
    found_.append(result_);
}

/// True if the bodies' motion is to change for that.
TALUS_OF_ANTICIPATED(bool)::hold_up_bodies(const Encounter& e) {
    bool changes = false;
    for (const ContactPoint<Dim>& c : kept_of(e))
        changes |= motion_.add(e.a, e.b, c, least_approach * e.reach, e.image);
    return changes;
}

TALUS_OF_ANTICIPATED(void)::decide_disputes() {
    for (const std::size_t k : disputed_)
        for (const BodyIndex i : {encounters_[k].a, encounters_[k].b}) motion_.release(i);
    for (const Encounter& e : encounters_)
        if (!e.meeting.disputed && (motion_.is_released(e.a) || motion_.is_released(e.b)))
            hold_up_bodies(e);
    for (std::size_t i = 0; i < bodies_->count(); ++i) motion_.settle(static_cast<BodyIndex>(i));
    const auto comes_first = [&](std::size_t j, std::size_t k) {
        const double first = encounters_[j].meeting.after, second = encounters_[k].meeting.after;
        return first != second ? first < second : j < k;
    };
    // (The code of a heap is a third of that of std::sort.)
    std::make_heap(disputed_.begin(), disputed_.end(), comes_first);
    std::sort_heap(disputed_.begin(), disputed_.end(), comes_first);
    for (const std::size_t k : disputed_) {
        Encounter& e = encounters_[k];
        if (motion_.is_changed(e.a) || motion_.is_changed(e.b)) {
            e.kept_first = e.first;
            e.kept_count = e.count;
            if (concerns(e) && has_sides(e)) judge(e);
        }
        if (!hold_up_bodies(e)) continue;
        for (const BodyIndex i : {e.a, e.b}) motion_.settle(i);
    }
}

TALUS_OF_ANTICIPATED(void)::finish(ContactSet<Dim>& contacts, bool in_cell) {
    if (!disputed_.empty()) decide_disputes();
    for (auto e = encounters_.begin(); e != encounters_.end();) {
        const BodyIndex a = e->a, b = e->b;
        const BodyImage<Dim> image = e->image;
        result_.clear();
        for (; e != encounters_.end() && e->a == a && e->b == b && e->image.shift == image.shift;
             ++e)
            result_.append(kept_of(*e));
        sort_by_feature(result_);
        for (const ContactPoint<Dim>& point : result_)
            if (in_cell)
                contacts.push_back(a, b, point, image.shift, image.offset);
            else
                contacts.push_back(a, b, point);
    }
}

#undef TALUS_OF_ANTICIPATED

}  // namespace talus

TALUS_IN_PLANE(class talus::AnticipatedContacts<2>)
TALUS_IN_SPACE(class talus::AnticipatedContacts<3>)
