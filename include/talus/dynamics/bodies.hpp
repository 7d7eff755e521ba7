// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/column.hpp>
#include <talus/core/ids.hpp>
#include <talus/core/input.hpp>
#include <talus/dynamics/collision_filter.hpp>
#include <talus/dynamics/locked_axes.hpp>
#include <talus/spatial/inertia.hpp>
#include <talus/spatial/pose.hpp>
#include <talus/spatial/twist.hpp>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace talus {

/// All bodies of a system, one array per field, indexed by BodyIndex. Each body's frame stands at
/// its mass centre along its principal axes, so that the inertia matrix A of the paper is diagonal
/// and constant ([Moreau] section 1.2). Obstacles are bodies that impulses do not move: their
/// inverse mass is zero and their pose and twist are prescribed.
template <int Dim>
requires SpaceDimension<Dim>
struct Bodies {
    // State q, u.
    PerBody<Vector<Dim>> position;     ///< of the mass centre [m]
    PerBody<Rotation<Dim>> rotation;   ///< body axes to world axes
    PerBody<Vector<Dim>> velocity;     ///< of the mass centre, world axes [m/s]
    PerBody<AngularVector<Dim>> spin;  ///< **body** axes [rad/s]

    // Constants.
    PerBody<double> inverse_mass;                 ///< 0 for obstacles [1/kg]
    PerBody<AngularVector<Dim>> inverse_inertia;  ///< principal, 0: does not turn [1/(kg m^2)]
    PerBody<MaterialIndex> material;
    PerBody<BodyId> id;               ///< ascending
    PerBody<LockedAxes<Dim>> locked;  ///< set by `lock`
    PerBody<CollisionGroups> groups;  ///< whom it can touch

    std::size_t count() const { return position.size(); }
    bool is_obstacle(std::integral auto i) const { return inverse_mass[i] == 0.0; }
    double mass(std::integral auto i) const {
        return 1.0 / inverse_mass[i];
    }  ///< infinite for obstacles
    /// Principal moments [kg m^2]; infinite where the body does not turn.
    AngularVector<Dim> inertia(std::integral auto i) const {
        return inverse_inertia[i].cwiseInverse();
    }
    Pose<Dim> pose(std::integral auto i) const { return {position[i], rotation[i]}; }
    /// World-axis twist.
    Twist<Dim> twist(std::integral auto i) const {
        return {velocity[i], rotation[i].spin_world(spin[i])};
    }

    /// Where the body of that name is; nothing if there is none (any more). O(log bodies).
    std::optional<BodyIndex> find(BodyId body) const {
        const auto at = std::lower_bound(id.begin(), id.end(), body);
        if (at == id.end() || *at != body) return std::nullopt;
        return static_cast<BodyIndex>(at - id.begin());
    }
    /// The same; throws input_error if there is none.
    BodyIndex index(BodyId body) const {
        if (const auto found = find(body)) return *found;
        throw input_error(detail::joined({"body id is ", detail::digits_of(body.serial),
                                          ", but must be that of a body that was not removed"}));
    }

    /// Of the body that is added next.
    std::int64_t next_serial() const { return next_serial_; }
    /// Gives bodies that are added from now on no serial below `next`: those of bodies that are
    /// gone.
    void skip_serials(std::int64_t next) { next_serial_ = std::max(next_serial_, next); }

    /// How many bodies were ever taken out: where it is another, indices may be those of others.
    std::int64_t removals() const { return removals_; }
    /// Keeps, in their order, the bodies for which `keep(i)` holds. O(bodies).
    template <class Keep>
    void keep_if(Keep&& keep) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < count(); ++i) {
            if (!keep(i)) continue;
            move(i, kept);
            ++kept;
        }
        removals_ += static_cast<std::int64_t>(count() - kept);
        position.resize(kept);
        rotation.resize(kept);
        velocity.resize(kept);
        spin.resize(kept);
        inverse_mass.resize(kept);
        inverse_inertia.resize(kept);
        material.resize(kept);
        id.resize(kept);
        locked.resize(kept);
        groups.resize(kept);
    }

    /// Adds a free body. Moments may be infinite: the body then does not turn (a point mass).
    /// Throws input_error for a mass or moment that is not positive, for moments that no mass
    /// distribution has (one larger than the sum of the others), and for a state that is not
    /// finite.
    BodyIndex add(const Inertia<Dim>& inertia, const Pose<Dim>& pose, const Twist<Dim>& twist = {},
                  MaterialIndex material_index = 0) {
        check(inertia);
        return append(1.0 / inertia.mass, inertia.principal.cwiseInverse(), pose, twist,
                      material_index);
    }
    /// Adds an obstacle. Its motion is prescribed by whoever steps the system.
    BodyIndex add_obstacle(const Pose<Dim>& pose, const Twist<Dim>& twist = {},
                           MaterialIndex material_index = 0) {
        return append(0.0, AngularVector<Dim>::Zero(), pose, twist, material_index);
    }

    /// Locks axes of a free body in place of those that were. Throws input_error if it moves along
    /// one of them, for an obstacle, and where two of three axes of rotation are left free: no
    /// guide does that.
    void lock(std::integral auto i, const LockedAxes<Dim>& axes) {
        require_in("body", static_cast<double>(i), 0.0, static_cast<double>(count()) - 1.0);
        const auto k = static_cast<std::size_t>(i);
        if (is_obstacle(k))
            throw input_error(detail::numbered("body", k,
                                               " is an obstacle, but must be free to have locked "
                                               "axes"));
        axes.require_possible();
        require_at_rest(k, axes);
        locked[k] = axes;
    }
    /// Throws input_error if body i moves along an axis of these, or turns about one.
    void require_at_rest(std::size_t i, const LockedAxes<Dim>& axes) const {
        const Twist<Dim> now = twist(i);
        constexpr double rounding = 1e-9;  // of spins, which are kept in body axes
        const Vector<Dim> slip = now.linear - axes.free_part(now.linear);
        const AngularVector<Dim> turn = now.angular - axes.free_turn(now.angular);
        if (slip != Vector<Dim>::Zero())
            detail::reject(detail::numbered("velocity of body", i, " along locked axes"),
                           slip.norm(), "0");
        if (!(turn.norm() <= rounding * now.angular.norm()))
            detail::reject(detail::numbered("spin of body", i, " about locked axes"), turn.norm(),
                           "0");
    }

  private:
    static void check(const Inertia<Dim>& inertia) {
        require_positive("mass", inertia.mass);
        const AngularVector<Dim>& moments = inertia.principal;
        for (int k = 0; k < moments.size(); ++k) {
            if (!(moments[k] > 0.0)) detail::reject("moment of inertia", moments[k], "positive");
            const double others = moments.sum() - moments[k];
            constexpr double rounding = 1e-9;  // of moments computed by integration
            if (moments.size() == 3 && moments.allFinite() && moments[k] > others * (1 + rounding))
                detail::reject("moment of inertia", moments[k],
                               detail::joined({"at most the sum of the other two (",
                                               detail::text_of(others), ")"}));
        }
    }
    BodyIndex append(double inverse_mass_, const AngularVector<Dim>& inverse_inertia_,
                     const Pose<Dim>& pose, const Twist<Dim>& twist, MaterialIndex material_index) {
        require_finite("position", pose.position);
        require_finite("rotation", pose.rotation.matrix());
        require_finite("velocity", twist.linear);
        require_finite("spin", twist.angular);
        if (material_index < 0) detail::reject("material", material_index, "an index from 0");
        position.push_back(pose.position);
        rotation.push_back(pose.rotation);
        velocity.push_back(twist.linear);
        spin.push_back(pose.rotation.spin_body(twist.angular));
        inverse_mass.push_back(inverse_mass_);
        inverse_inertia.push_back(inverse_inertia_);
        material.push_back(material_index);
        id.push_back({next_serial_++});
        locked.push_back({});
        groups.push_back({});
        return static_cast<BodyIndex>(position.size() - 1);
    }
    void move(std::size_t from, std::size_t to) {
        position[to] = position[from];
        rotation[to] = rotation[from];
        velocity[to] = velocity[from];
        spin[to] = spin[from];
        inverse_mass[to] = inverse_mass[from];
        inverse_inertia[to] = inverse_inertia[from];
        material[to] = material[from];
        id[to] = id[from];
        locked[to] = locked[from];
        groups[to] = groups[from];
    }

    std::int64_t next_serial_ = 0;
    std::int64_t removals_ = 0;
};

/// Throws input_error for inverse masses and moments that no body has; returns how many bodies have
/// no mass. O(bodies).
template <int Dim>
std::size_t require_masses_of(const Bodies<Dim>& bodies) {
    const std::size_t n = bodies.count();
    require_count("inverse masses", bodies.inverse_mass.size(), "bodies", n);
    require_count("inverse moments of inertia", bodies.inverse_inertia.size(), "bodies", n);
    require_count("rotations", bodies.rotation.size(), "bodies", n);
    require_count("velocities", bodies.velocity.size(), "bodies", n);
    require_count("spins", bodies.spin.size(), "bodies", n);
    require_count("ids", bodies.id.size(), "bodies", n);
    require_count("sets of locked axes", bodies.locked.size(), "bodies", n);
    require_count("groups", bodies.groups.size(), "bodies", n);
    std::size_t without = 0;
    for (std::size_t i = 0; i < n; ++i) {
        if (bodies.locked[i].any()) {
            bodies.locked[i].require_possible();
            bodies.require_at_rest(i, bodies.locked[i]);
        }
        const double inverse = bodies.inverse_mass[i];
        const AngularVector<Dim>& moments = bodies.inverse_inertia[i];
        if (!(inverse >= 0.0 && std::isfinite(inverse)))
            detail::reject(detail::numbered("inverse mass of body", i), inverse,
                           "finite and not negative");
        if (!(moments.minCoeff() >= 0.0 && moments.allFinite()))
            detail::reject(detail::numbered("inverse moment of inertia of body", i),
                           moments.allFinite() ? moments.minCoeff() : moments.sum(),
                           "finite and not negative");
        without += inverse == 0.0 ? 1 : 0;
    }
    return without;
}

/// Throws input_error unless ids ascend, below that of the next body, and positions are finite: of
/// bodies that come from elsewhere. O(bodies).
template <int Dim>
void require_ids_of(const Bodies<Dim>& bodies) {
    for (std::size_t i = 0; i < bodies.count(); ++i) {
        if (!bodies.position[i].allFinite())
            require_finite(detail::numbered("position of body", i), bodies.position[i]);
        const std::int64_t id = bodies.id[i].serial;
        const std::int64_t least = i == 0 ? 0 : bodies.id[i - 1].serial + 1;
        if (id < least || id >= bodies.next_serial())
            detail::reject(
                detail::numbered("id of body", i), static_cast<double>(id),
                detail::joined({"above those before it and below that of the next body, ",
                                detail::digits_of(bodies.next_serial())}));
    }
}

/// Kinetic energy of body i [J]; zero for obstacles.
template <int Dim>
double kinetic_energy(const Bodies<Dim>& bodies, std::size_t i) {
    if (bodies.is_obstacle(i)) return 0.0;
    double twice = bodies.mass(i) * bodies.velocity[i].squaredNorm();
    for (int k = 0; k < rotation_dof<Dim>; ++k)
        if (bodies.inverse_inertia[i][k] > 0.0)
            twice += bodies.spin[i][k] * bodies.spin[i][k] / bodies.inverse_inertia[i][k];
    return 0.5 * twice;
}

/// Inverse inertia tensor of body i in world axes [1/(kg m^2)]. Exactly a multiple of the identity
/// when all moments are equal.
template <int Dim>
AngularMatrix<Dim> inverse_inertia_world(const Bodies<Dim>& bodies, std::size_t i) {
    const AngularVector<Dim>& principal = bodies.inverse_inertia[i];
    if (principal == AngularVector<Dim>::Constant(principal[0]))
        return principal[0] * AngularMatrix<Dim>::Identity();
    return tensor_world<Dim>(bodies.rotation[i], principal);
}

/// What moments along the free axes do, in world axes, while the guide keeps the others: where one
/// axis is free the inverse of the moment of inertia about it, summed up from the principal ones
/// (taken out of the inverse tensor it would have the digits of the largest entry).
template <int Dim>
AngularMatrix<Dim> free_inverse_inertia_world(const Bodies<Dim>& bodies, std::size_t i) {
    const LockedAxes<Dim>& locked = bodies.locked[i];
    if (locked.rotation_count() == 0) return inverse_inertia_world(bodies, i);
    AngularMatrix<Dim> free = AngularMatrix<Dim>::Zero();
    for (int k = 0; k < rotation_dof<Dim>; ++k) {
        if (locked.rotation[static_cast<std::size_t>(k)]) continue;
        const AngularVector<Dim> axis = bodies.rotation[i].spin_body(AngularVector<Dim>::Unit(k));
        double inertia = 0.0;
        for (int j = 0; j < rotation_dof<Dim>; ++j)
            if (axis[j] != 0.0) inertia += axis[j] * axis[j] / bodies.inverse_inertia[i][j];
        free(k, k) = 1.0 / inertia;
    }
    return free;
}

}  // namespace talus
