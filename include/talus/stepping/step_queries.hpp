// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/assembly/contact_jacobian.hpp>
#include <talus/core/check.hpp>
#include <talus/core/input.hpp>
#include <talus/spatial/twist.hpp>
#include <talus/stepping/step_data.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace talus {

// What users ask a step about bodies and contacts. Bodies may be named in any order. A body that
// the step did not have is refused with input_error. O(contacts) each; forces are impulses divided
// by h.

namespace detail {

template <int Dim, class Law>
void require_body(const StepData<Dim, Law>& data, BodyIndex body) {
    if (body < 0 || static_cast<std::size_t>(body) >= data.end.size())
        reject("body", body,
               numbered("an index from 0 below", data.end.size(),
                        ", the number of bodies that the step had"));
}

}  // namespace detail

/// Indices of the contacts between two bodies, in the order of the step's contacts.
template <int Dim, class Law>
std::vector<std::size_t> contacts_between(const StepData<Dim, Law>& data, BodyIndex one,
                                          BodyIndex other) {
    detail::require_body(data, one);
    detail::require_body(data, other);
    std::vector<std::size_t> found;
    for (std::size_t c = 0; c < data.contact_count(); ++c) {
        const ContactKey& key = data.contacts.key[c];
        if ((key.a == one && key.b == other) || (key.a == other && key.b == one))
            found.push_back(c);
    }
    return found;
}

/// Whether two bodies pushed, held or overlapped each other in the step: contacts that are only
/// anticipated, with a gap and without an impulse, are no touch.
template <int Dim, class Law>
bool touches(const StepData<Dim, Law>& data, BodyIndex one, BodyIndex other) {
    for (const std::size_t c : contacts_between(data, one, other))
        if (data.contacts.gap[c] <= 0.0 || !data.impulse[c].isZero(0.0)) return true;
    return false;
}

/// Impulse of contact c on its first body (key.a), world axes [N s]; on the other it is the
/// opposite.
template <int Dim, class Law>
Vector<Dim> contact_impulse(const StepData<Dim, Law>& data, std::size_t c) {
    TALUS_CHECK(c < data.contact_count(), "a contact of this step");
    return data.problem.jacobian.frame[c].transpose() * data.impulse[c];
}

/// Moment impulse of rolling friction at contact c on its first body (key.a), world axes [N m s];
/// on the other it is the opposite. Zero for laws without.
template <int Dim, class Law>
AngularVector<Dim> contact_moment(const StepData<Dim, Law>& data, std::size_t c) {
    TALUS_CHECK(c < data.contact_count(), "a contact of this step");
    if constexpr (has_rolling_rows<Law>)
        return data.moment[c];
    else
        return AngularVector<Dim>::Zero();
}

/// Relative velocity U_end of contact c, of its first body (key.a) against the other, local axes,
/// the normal first [m/s].
template <int Dim, class Law>
Vector<Dim> contact_velocity(const StepData<Dim, Law>& data, std::size_t c) {
    TALUS_CHECK(c < data.contact_count(), "a contact of this step");
    return relative_velocity<Dim>(data.problem.jacobian, c, std::span<const Twist<Dim>>(data.end),
                                  data.cell_rate_end);
}

namespace detail {

/// Sum over the contacts of `body` whose other body is one that `counts`.
template <int Dim, class Law, class Counts>
Wrench<Dim> wrench_impulse_on(const StepData<Dim, Law>& data, BodyIndex body, Counts&& counts) {
    Wrench<Dim> sum;
    const ContactJacobian<Dim>& jacobian = data.problem.jacobian;
    for (std::size_t c = 0; c < data.contact_count(); ++c) {
        const BodyIndex a = jacobian.a[c], b = jacobian.b[c];
        if (a == body && counts(b))
            sum += Wrench<Dim>::at(jacobian.arm_a[c], contact_impulse(data, c));
        else if (b == body && counts(a))
            sum += Wrench<Dim>::at(jacobian.arm_b[c], Vector<Dim>(-contact_impulse(data, c)));
        else
            continue;
        if constexpr (has_rolling_rows<Law>)
            sum.torque += a == body ? data.moment[c] : AngularVector<Dim>(-data.moment[c]);
    }
    return sum;
}

}  // namespace detail

/// Impulse [N s] that all contacts gave to a body in the step, and its moment about the body's
/// centre [N m s], world axes.
template <int Dim, class Law>
Wrench<Dim> wrench_impulse_on(const StepData<Dim, Law>& data, BodyIndex body) {
    detail::require_body(data, body);
    return detail::wrench_impulse_on(data, body, [](BodyIndex) { return true; });
}

/// The part of it that one other body gave.
template <int Dim, class Law>
Wrench<Dim> wrench_impulse_between(const StepData<Dim, Law>& data, BodyIndex on, BodyIndex from) {
    detail::require_body(data, on);
    detail::require_body(data, from);
    return detail::wrench_impulse_on(data, on, [from](BodyIndex other) { return other == from; });
}

}  // namespace talus
