// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/number_record.hpp>
#include <talus/dynamics/run_state.hpp>
#include <talus/io/checkpoint/named_arrays.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace talus::detail {

/// Small vectors one after another.
template <class Vectors>
std::vector<double> flat(const Vectors& vectors) {
    NumberRecord record;
    for (const auto& x : vectors) record.array(x);
    return std::move(record.reals);
}
template <class SmallVector, class Vectors>
void read_vectors(const std::vector<double>& numbers, Vectors& vectors) {
    constexpr auto width = static_cast<std::size_t>(SmallVector::SizeAtCompileTime);
    vectors.resize(numbers.size() / width);
    for (std::size_t k = 0; k < numbers.size(); ++k)
        vectors[k / width].data()[k % width] = numbers[k];
}

/// How many numbers a rotation is written as.
template <int Dim>
std::size_t rotation_width() {
    return record_of(Rotation<Dim>()).reals.size();
}

/// The periodic cell, and which images the contacts are of.
template <int Dim, class ShapeType>
void write_cell(const RunState<Dim, ShapeType>& state, NamedArrays& arrays) {
    arrays.put("cell", record_of(*state.cell));
    auto& image = arrays.integers["contacts/image"];
    for (const ContactKey& key : state.key)
        image.insert(image.end(), key.image.n.begin(), key.image.n.end());
}
/// Nothing where there was none, as in older files.
template <int Dim, class ShapeType>
void read_cell(const NamedArrays& arrays, RunState<Dim, ShapeType>& state) {
    if (!arrays.reals.contains("cell/reals")) return;
    state.cell = from_record<PeriodicCell<Dim>>(arrays.record("cell"));
    const auto& image = arrays.integer_list("contacts/image", 3 * state.key.size());
    constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
    for (std::size_t c = 0; c < state.key.size(); ++c)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int64_t steps = image[3 * c + k];
            if (steps > most || steps < -most)
                throw input_error("contacts/image is " + std::to_string(steps) +
                                  ", but must be within 2^31");
            state.key[c].image.n[k] = static_cast<std::int32_t>(steps);
        }
}

/// A state as lists of numbers: one list per field of the bodies, body after body.
template <int Dim, Recordable ShapeType>
NamedArrays arrays_of(const RunState<Dim, ShapeType>& state) {
    NamedArrays arrays;
    const Bodies<Dim>& bodies = state.bodies;
    arrays.integers["dimension"] = {Dim};
    arrays.reals["bodies/position"] = flat(bodies.position);
    NumberRecord rotations;
    for (const Rotation<Dim>& rotation : bodies.rotation) rotation.write(rotations);
    arrays.reals["bodies/rotation"] = std::move(rotations.reals);
    arrays.reals["bodies/velocity"] = flat(bodies.velocity);
    arrays.reals["bodies/spin_body"] = flat(bodies.spin);
    arrays.reals["bodies/inverse_mass"] = bodies.inverse_mass;
    arrays.reals["bodies/inverse_inertia"] = flat(bodies.inverse_inertia);
    arrays.integers["bodies/material"] = {bodies.material.begin(), bodies.material.end()};
    auto& ids = arrays.integers["bodies/id"];
    for (const BodyId id : bodies.id) ids.push_back(id.serial);
    arrays.integers["bodies/next_id"] = {bodies.next_serial()};
    NumberRecord locked;
    for (const LockedAxes<Dim>& axes : bodies.locked) axes.write(locked);
    arrays.integers["bodies/locked"] = std::move(locked.integers);
    auto& groups = arrays.integers["bodies/groups"];
    for (const CollisionGroups& g : bodies.groups) {
        groups.push_back(g.member);
        groups.push_back(g.meets);
    }
    auto& ignored = arrays.integers["ignored_pairs"];
    for (const auto& [first, second] : state.ignored.pairs()) {
        ignored.push_back(first.serial);
        ignored.push_back(second.serial);
    }
    NumberRecord shapes;
    for (const ShapeType& shape : state.shapes) shape.write(shapes);
    arrays.put("shapes", shapes);
    NumberRecord motions;
    auto& moved = arrays.integers["obstacles/body"];
    for (const Obstacle<Dim>& obstacle : state.obstacles) {
        moved.push_back(obstacle.body);
        obstacle.motion.write(motions);
    }
    arrays.put("obstacles/motion", motions);
    arrays.reals["gravity"] = {state.gravity.data(), state.gravity.data() + Dim};
    arrays.reals["clock/time"] = {state.time};
    arrays.reals["clock/h"] = {state.h};
    arrays.reals["clock/time_start"] = {state.time_start};
    arrays.integers["clock/step_count"] = {state.step_count};
    arrays.reals["clock/last_h"] = {state.last_h};
    auto& a = arrays.integers["contacts/a"];
    auto& b = arrays.integers["contacts/b"];
    auto& feature = arrays.integers["contacts/feature"];
    for (const ContactKey& key : state.key) {
        a.push_back(key.a);
        b.push_back(key.b);
        feature.push_back(static_cast<std::int64_t>(key.feature.code));
    }
    arrays.reals["contacts/impulse_world"] = flat(state.impulse);
    // Only where there are some: other files stay as they were.
    if (!state.moment.empty()) arrays.reals["contacts/moment_world"] = flat(state.moment);
    if (state.cell) write_cell(state, arrays);
    arrays.put("correction", state.correction);
    return arrays;
}

/// The motion of an obstacle whose motion is made of functions, by its id and name.
template <int Dim>
using MotionOf = std::function<PrescribedMotion<Dim>(BodyId id, const std::string& name)>;

/// An index of a list of `count`, out of a file.
inline BodyIndex body_index(const char* item, std::int64_t value, std::size_t count) {
    require_in(item, static_cast<double>(value), 0.0, static_cast<double>(count) - 1.0);
    return static_cast<BodyIndex>(value);
}

template <int Dim>
void read_bodies(const NamedArrays& arrays, Bodies<Dim>& bodies) {
    constexpr auto dim = static_cast<std::size_t>(Dim);
    constexpr auto spins = static_cast<std::size_t>(rotation_dof<Dim>);
    const auto& ids = arrays.integer_list("bodies/id");
    const std::size_t n = ids.size();
    read_vectors<Vector<Dim>>(arrays.real_list("bodies/position", n * dim), bodies.position);
    NumberRecord rotations{arrays.real_list("bodies/rotation", n * rotation_width<Dim>()), {}};
    NumberRecordReader in(rotations);
    for (std::size_t i = 0; i < n; ++i) bodies.rotation.push_back(Rotation<Dim>::read(in));
    read_vectors<Vector<Dim>>(arrays.real_list("bodies/velocity", n * dim), bodies.velocity);
    read_vectors<AngularVector<Dim>>(arrays.real_list("bodies/spin_body", n * spins), bodies.spin);
    const auto& inverse_mass = arrays.real_list("bodies/inverse_mass", n);
    bodies.inverse_mass.assign(inverse_mass.begin(), inverse_mass.end());
    read_vectors<AngularVector<Dim>>(arrays.real_list("bodies/inverse_inertia", n * spins),
                                     bodies.inverse_inertia);
    for (const std::int64_t material : arrays.integer_list("bodies/material", n))
        bodies.material.push_back(body_index("material", material, 1u << 30));
    for (const std::int64_t id : ids) {
        if (id < 0 || (!bodies.id.empty() && id <= bodies.id.back().serial))
            throw input_error("id of a body is " + std::to_string(id) +
                              ", but must be 0 or more and above that of the body before");
        bodies.id.push_back({id});
    }
    const NumberRecord locked{{}, arrays.integer_list("bodies/locked", n * twist_dof<Dim>)};
    NumberRecordReader axes(locked);
    for (std::size_t i = 0; i < n; ++i) bodies.locked.push_back(LockedAxes<Dim>::read(axes));
    const auto& groups = arrays.integer_list("bodies/groups", 2 * n);
    for (std::size_t i = 0; i < n; ++i)
        bodies.groups.push_back({static_cast<std::uint32_t>(groups[2 * i]),
                                 static_cast<std::uint32_t>(groups[2 * i + 1])});
    const std::int64_t next = arrays.integer("bodies/next_id");
    if (next < 0 || (n > 0 && next <= ids.back()))
        throw input_error("bodies/next_id is " + std::to_string(next) +
                          ", but must be above those of all bodies");
    bodies.skip_serials(next);
}

/// The state that the lists are of. Throws input_error where they are of none; whether its parts
/// fit a simulation is left to Simulation::restore.
template <int Dim, Recordable ShapeType>
RunState<Dim, ShapeType> state_of(const NamedArrays& arrays, const MotionOf<Dim>& motion_of) {
    if (const std::int64_t dimension = arrays.integer("dimension"); dimension != Dim)
        throw input_error("dimension is " + std::to_string(dimension) + ", but must be " +
                          std::to_string(Dim));
    RunState<Dim, ShapeType> state;
    read_bodies(arrays, state.bodies);
    const std::size_t n = state.bodies.count();
    const NumberRecord shapes = arrays.record("shapes");
    NumberRecordReader shape_reader(shapes);
    for (std::size_t i = 0; i < n; ++i) state.shapes.push_back(ShapeType::read(shape_reader));
    shape_reader.require_end();
    const auto& ignored = arrays.integer_list("ignored_pairs");
    if (ignored.size() % 2 != 0)
        throw input_error("number of ids in ignored_pairs is odd, but must be even");
    for (std::size_t k = 0; k + 1 < ignored.size(); k += 2)
        state.ignored.insert({ignored[k]}, {ignored[k + 1]});
    const NumberRecord motions = arrays.record("obstacles/motion");
    NumberRecordReader motion_reader(motions);
    for (const std::int64_t moved : arrays.integer_list("obstacles/body")) {
        const BodyIndex body = body_index("body of an obstacle", moved, n);
        state.obstacles.push_back(
            {body, PrescribedMotion<Dim>::read(motion_reader, [&](const std::string& name) {
                 return motion_of(state.bodies.id[body], name);
             })});
    }
    motion_reader.require_end();
    state.gravity =
        NumberRecordReader({arrays.real_list("gravity", Dim), {}}).template array<Vector<Dim>>();
    state.time = arrays.real("clock/time");
    state.h = arrays.real("clock/h");
    state.time_start = arrays.real("clock/time_start");
    state.step_count = arrays.integer("clock/step_count");
    state.last_h = arrays.real("clock/last_h");
    const auto& a = arrays.integer_list("contacts/a");
    const auto& b = arrays.integer_list("contacts/b", a.size());
    const auto& feature = arrays.integer_list("contacts/feature", a.size());
    for (std::size_t c = 0; c < a.size(); ++c)
        state.key.push_back({body_index("body of a contact", a[c], n),
                             body_index("body of a contact", b[c], n),
                             {static_cast<std::uint64_t>(feature[c])}});
    read_vectors<Vector<Dim>>(arrays.real_list("contacts/impulse_world", a.size() * Dim),
                              state.impulse);
    if (arrays.reals.contains("contacts/moment_world"))
        read_vectors<AngularVector<Dim>>(
            arrays.real_list("contacts/moment_world",
                             a.size() * static_cast<std::size_t>(rotation_dof<Dim>)),
            state.moment);
    read_cell(arrays, state);
    state.correction = arrays.record("correction");
    return state;
}

}  // namespace talus::detail
