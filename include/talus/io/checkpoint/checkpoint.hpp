// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/number_record.hpp>
#include <talus/dynamics/run_state.hpp>
#include <talus/io/checkpoint/named_arrays.hpp>
#include <talus/io/checkpoint/state_arrays.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace talus {

/// Data of one's own that a checkpoint carries, by names of letters, digits, `_`, `-` and `.`:
/// `{{"rain", record_of(random)}, {"run", record_of(summary)}}`.
struct CheckpointRecords : std::map<std::string, NumberRecord> {
    using std::map<std::string, NumberRecord>::map;
    /// Throws input_error naming the record if there is none of that name.
    const NumberRecord& at(const std::string& name) const {
        const auto found = find(name);
        if (found != end()) return found->second;
        std::string names;
        for (const auto& [other, record] : *this) names += (names.empty() ? "" : ", ") + other;
        throw input_error("record of the checkpoint is '" + detail::printable(name, 40) +
                          "', but must be one that was saved" +
                          (names.empty() ? ": none was" : " (" + names + ")"));
    }
};

/// Motions of obstacles that are made of functions, by the names that they have
/// (PrescribedMotion::named).
template <int Dim>
using NamedMotions = std::map<std::string, PrescribedMotion<Dim>>;

/// What can be written down and gone on with: a Simulation, or whatever has its two functions.
template <class S>
concept Resumable = requires(S& sim, const S& same) {
    sim.restore(same.state());
};

/// Throws input_error unless a record can be called so: what carries records along asks before a
/// run, not at the first checkpoint.
inline void require_record_name(const std::string& name) {
    constexpr std::string_view letters =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.";
    constexpr std::size_t longest = 100;
    if (name.empty() || name.size() > longest || name == "." || name == ".." ||
        name.find_first_not_of(letters) != std::string::npos)
        throw input_error("name of a record is '" + detail::printable(name, 40) +
                          "', but must be 1 to 100 letters, digits, _, - or .");
}

namespace detail {

inline constexpr const char* checkpoint_format = "talus checkpoint";
/// The version is 2 where there is a periodic cell, which older programs would overlook.
inline constexpr int checkpoint_version = 1, checkpoint_version_of_cells = 2;

template <class State>
struct StateTypes;
template <int Dim_, class ShapeType_>
struct StateTypes<RunState<Dim_, ShapeType_>> {
    static constexpr int Dim = Dim_;
    using ShapeType = ShapeType_;
};
template <class Sim>
using StateTypesOf = StateTypes<std::remove_cvref_t<decltype(std::declval<const Sim&>().state())>>;

/// Throws input_error unless each obstacle is where its motion has it, to what another machine's
/// sine may differ by.
template <int Dim, class ShapeType>
void require_same_motions(const RunState<Dim, ShapeType>& state) {
    for (const Obstacle<Dim>& obstacle : state.obstacles) {
        const Pose<Dim> pose = obstacle.motion.pose(state.time);
        const Vector<Dim>& position = state.bodies.position[obstacle.body];
        const Twist<Dim> twist = obstacle.motion.twist(state.time),
                         stored = state.bodies.twist(obstacle.body);
        const double off = (pose.position - position).norm() +
                           pose.rotation.distance(state.bodies.rotation[obstacle.body]);
        const double other =
            (twist.linear - stored.linear).norm() + (twist.angular - stored.angular).norm();
        const double speed = stored.linear.norm() + stored.angular.norm();
        constexpr double rounding = 1e-9, of_differences = 1e-6;
        if (!(off <= rounding * (1.0 + position.norm()) && other <= of_differences * (1.0 + speed)))
            throw input_error(
                "motion" +
                (obstacle.motion.name().empty()
                     ? std::string()
                     : " '" + printable(obstacle.motion.name(), 40) + "'") +
                numbered(" of body", static_cast<std::size_t>(obstacle.body)) +
                " leads elsewhere at time " + text_of(state.time) +
                ", but must lead to where the checkpoint has the body, at its velocity");
    }
}

}  // namespace detail

/// Writes the state of a simulation to an HDF5 file, with records of one's own: all that the next
/// step depends on but what the program says again (laws, forces, settings, solver). Motions that
/// talus made (standing still, belts, uniform ones, tables) are written down; of those made of
/// functions only the name. `experiment` says what run it is; only such a one loads it.
///
/// The file takes the place of one that was there when it is whole and on disk, so that a program
/// killed at any moment leaves the last whole one (and, killed while it writes, a file
/// `.talus-*.part` beside it). Throws input_error for a record whose name is not as told, and as
/// write_file does; then nothing is written.
///
///     RunSummary run = sim.run(1.0);
///     save_checkpoint("silo.h5", sim, "silo", {{"run", record_of(run)}});
///     // In a program that builds the same simulation:
///     const CheckpointRecords records = load_checkpoint("silo.h5", sim, "silo");
///     run = from_record<RunSummary>(records.at("run"));
template <Resumable Sim>
void save_checkpoint(const std::filesystem::path& path, const Sim& sim,
                     const std::string& experiment, const CheckpointRecords& records = {}) {
    detail::NamedArrays arrays = detail::arrays_of(sim.state());
    arrays.texts["experiment"] = experiment;
    for (const auto& [name, record] : records) {
        require_record_name(name);
        arrays.put("records/" + name, record);
    }
    const bool cell = arrays.reals.contains("cell/reals");
    detail::write_arrays(path, detail::checkpoint_format,
                         cell ? detail::checkpoint_version_of_cells : detail::checkpoint_version,
                         arrays);
}

/// Puts the state of a file in place of that of `sim`, a simulation with the laws, forces, settings
/// and solver of the one that was saved; the run that follows then makes the same bits as if there
/// had been no stop. Bodies, shapes and obstacles are those of the file, whatever `sim` had. Of an
/// obstacle whose motion is made of functions the motion is that of its name in `motions`, or that
/// of the obstacle of the same BodyId and name in `sim`. Returns the records. Throws input_error,
/// one sentence that names the file, and changes nothing, if it is no checkpoint, damaged, of
/// another version, experiment, dimension or step size, or where a motion is missing or leads
/// elsewhere.
template <Resumable Sim>
CheckpointRecords load_checkpoint(
    const std::filesystem::path& path, Sim& sim, const std::string& experiment,
    const NamedMotions<detail::StateTypesOf<Sim>::Dim>& motions = {}) {
    using Types = detail::StateTypesOf<Sim>;
    constexpr int Dim = Types::Dim;
    const auto arrays =
        detail::read_arrays(path, detail::checkpoint_format, detail::checkpoint_version,
                            detail::checkpoint_version_of_cells);
    try {
        if (const auto found = arrays.texts.find("experiment");
            found == arrays.texts.end() || found->second != experiment)
            throw input_error("experiment is '" +
                              (found == arrays.texts.end() ? std::string()
                                                           : detail::printable(found->second, 40)) +
                              "', but must be '" + detail::printable(experiment, 40) + "'");
        const RunState<Dim, typename Types::ShapeType> here = sim.state();
        const auto motion_of = [&](BodyId id, const std::string& name) -> PrescribedMotion<Dim> {
            const auto given = motions.find(name);
            if (!name.empty() && given != motions.end()) return given->second;
            for (const Obstacle<Dim>& obstacle : here.obstacles)
                if (here.bodies.id[obstacle.body] == id && obstacle.motion.name() == name)
                    return obstacle.motion;
            throw input_error(
                "motion of the obstacle of id " + std::to_string(id.serial) +
                " is made of functions" +
                (name.empty() ? "" : " and named '" + detail::printable(name, 40) + "'") +
                ", but must then be given by name, or be that of the same obstacle of "
                "the simulation that goes on");
        };
        const auto state = detail::state_of<Dim, typename Types::ShapeType>(arrays, motion_of);
        detail::require_same_motions(state);
        CheckpointRecords records;
        const std::string folder = "records/", end = "/reals";
        for (const auto& [name, list] : arrays.reals)
            if (name.starts_with(folder) && name.ends_with(end)) {
                const std::string own =
                    name.substr(folder.size(), name.size() - folder.size() - end.size());
                records[own] = arrays.record(folder + own);
            }
        sim.restore(state);
        return records;
    } catch (const input_error& error) {
        throw input_error(detail::printable(path.string()) + ": " + error.what());
    }
}

}  // namespace talus
