// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/number_record.hpp>
#include <talus/core/types.hpp>

#include <algorithm>
#include <array>
#include <cstddef>

namespace talus {

/// The axes of the world along which, and about which, a body does not move, whatever pushes: it is
/// guided without friction, and the guide takes what it must. A piston has all but one translation
/// locked and every rotation; a door that turns about the third axis all translations and the first
/// two rotations.
template <int Dim>
requires SpaceDimension<Dim>
struct LockedAxes {
    static constexpr std::size_t turns = static_cast<std::size_t>(rotation_dof<Dim>);

    std::array<bool, Dim> translation{};
    std::array<bool, turns> rotation{};

    /// Moves along axis `k` alone, without turning.
    static LockedAxes all_but_translation(int k) {
        require_in("axis", k, 0, Dim - 1);
        LockedAxes locked = all();
        locked.translation[static_cast<std::size_t>(k)] = false;
        return locked;
    }
    /// Turns about axis `k` alone (0 in the plane), its centre staying where it is.
    static LockedAxes all_but_rotation(int k) {
        require_in("axis of rotation", k, 0, rotation_dof<Dim> - 1);
        LockedAxes locked = all();
        locked.rotation[static_cast<std::size_t>(k)] = false;
        return locked;
    }
    /// Moves as it likes, without turning.
    static LockedAxes rotations() {
        LockedAxes locked;
        locked.rotation.fill(true);
        return locked;
    }
    static LockedAxes all() {
        LockedAxes locked = rotations();
        locked.translation.fill(true);
        return locked;
    }

    bool any() const { return *this != LockedAxes{}; }
    std::size_t rotation_count() const {
        std::size_t count = 0;
        for (const bool locked : rotation) count += locked ? 1 : 0;
        return count;
    }

    /// Throws input_error where two of three axes of rotation are free: no guide does that.
    void require_possible() const {
        if (turns > 1 && rotation_count() == 1)
            detail::reject("locked axes of rotation", 1, "none, two or three");
    }

    bool all_translations() const {
        return std::all_of(translation.begin(), translation.end(), [](bool l) { return l; });
    }
    bool all_rotations() const {
        return std::all_of(rotation.begin(), rotation.end(), [](bool l) { return l; });
    }

    /// What is left of a velocity along the axes that are free.
    Vector<Dim> free_part(Vector<Dim> v) const {
        for (std::size_t k = 0; k < translation.size(); ++k)
            if (translation[k]) v.data()[k] = 0.0;
        return v;
    }
    AngularVector<Dim> free_turn(AngularVector<Dim> w) const {
        for (std::size_t k = 0; k < turns; ++k)
            if (rotation[k]) w.data()[k] = 0.0;
        return w;
    }
    void write(NumberRecord& out) const {
        for (const bool locked : translation) out.integer(locked);
        for (const bool locked : rotation) out.integer(locked);
    }
    static LockedAxes read(NumberRecordReader& in) {
        LockedAxes locked;
        for (bool& l : locked.translation) l = in.integer(0, 1) == 1;
        for (bool& l : locked.rotation) l = in.integer(0, 1) == 1;
        return locked;
    }

    friend bool operator==(const LockedAxes&, const LockedAxes&) = default;
};

}  // namespace talus
