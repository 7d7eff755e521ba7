// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/dynamics/prescribed_motion.hpp>
#include <talus/io/line_reader.hpp>
#include <talus/sample/random.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

namespace lab {

/// How the ground shakes along one direction: accelerations [m/s^2] at times [s], linear between
/// them.
struct GroundRecord {
    std::vector<double> time, acceleration;

    double peak() const {
        double most = 0.0;
        for (const double a : acceleration) most = std::max(most, std::abs(a));
        return most;
    }
    /// The same, with another peak [m/s^2].
    void scale_to(double wanted) {
        const double factor = wanted / peak();
        for (double& a : acceleration) a *= factor;
    }
    /// Velocity and displacement that its last time ends with, by its exact integrals [m/s, m].
    std::array<double, 2> end() const {
        double v = 0.0, x = 0.0;
        for (std::size_t k = 0; k + 1 < time.size(); ++k) {
            const double h = time[k + 1] - time[k], a = acceleration[k], b = acceleration[k + 1];
            x += h * v + h * h / 6.0 * (2.0 * a + b);
            v += 0.5 * h * (a + b);
        }
        return {v, x};
    }
};

/// Reads a record: in each line a time [s] and an acceleration [m/s^2]; what follows a # is a
/// comment. Throws input_error, one sentence with the line.
inline GroundRecord read_ground_record(const std::filesystem::path& path) {
    std::ifstream text = talus::detail::open_file(path, "a record of accelerations");
    talus::LineReader in(text, path.string());
    GroundRecord record;
    while (in.next_words()) {
        in.drop_comment();
        if (in.words_left() == 0) continue;
        record.time.push_back(in.number("time [s]", 0.0, 1e6));
        record.acceleration.push_back(in.number("acceleration [m/s^2]", -1e4, 1e4));
        in.expect_end_of_line();
    }
    if (record.time.size() < 2 || !(record.peak() > 0.0))
        throw talus::input_error(path.string() +
                                 ": the record has no acceleration at two or more times, but must");
    return record;
}

/// A made-up earthquake: waves of 0.5 to 10 Hz, 60 of them, with random phases and amplitudes as
/// behind a soil that resonates at 2.5 Hz (Kanai 1957, Tajimi 1960, damping 0.6), under an envelope
/// that rises over a tenth of the duration, is level and fades over the last half. A part of the
/// envelope, and of the envelope times the time, is taken out, so that the ground ends at rest
/// where it began. Every 0.01 s.
inline GroundRecord made_up_earthquake(double duration, double peak, std::uint64_t seed) {
    constexpr double pi = std::numbers::pi, every = 0.01;
    constexpr int waves = 60;
    talus::Random random(seed);
    std::array<double, waves> amplitude{}, omega{}, phase{};
    for (std::size_t k = 0; k < waves; ++k) {
        const double f = 0.5 + 9.5 * (static_cast<double>(k) + random.uniform()) / waves;  // [Hz]
        const double r = f / 2.5, damped = 4.0 * 0.36 * r * r;
        amplitude[k] = std::sqrt((1.0 + damped) / ((1.0 - r * r) * (1.0 - r * r) + damped));
        omega[k] = 2.0 * pi * f;
        phase[k] = random.uniform(0.0, 2.0 * pi);
    }
    GroundRecord record, level, slope;
    const auto count = static_cast<std::size_t>(std::ceil(duration / every)) + 1;
    for (std::size_t i = 0; i < count; ++i) {
        const double t = every * static_cast<double>(i), part = std::min(t / duration, 1.0);
        const double rise = std::sin(0.5 * pi * std::min(1.0, 10.0 * part));
        const double fade = std::cos(0.5 * pi * std::max(0.0, 2.0 * part - 1.0));
        const double envelope = rise * rise * fade * fade;
        double a = 0.0;
        for (std::size_t k = 0; k < waves; ++k)
            a += amplitude[k] * std::sin(omega[k] * t + phase[k]);
        for (GroundRecord* r : {&record, &level, &slope}) r->time.push_back(t);
        record.acceleration.push_back(envelope * a);
        level.acceleration.push_back(envelope);
        slope.acceleration.push_back(envelope * part);
    }
    const auto [v, x] = record.end();
    const auto [v1, x1] = level.end();
    const auto [v2, x2] = slope.end();
    const double determinant = v1 * x2 - v2 * x1;
    const double of_level = (v * x2 - v2 * x) / determinant;
    const double of_slope = (v1 * x - v * x1) / determinant;
    for (std::size_t i = 0; i < count; ++i)
        record.acceleration[i] -=
            of_level * level.acceleration[i] + of_slope * slope.acceleration[i];
    record.scale_to(peak);
    return record;
}

/// The ground's motion by a record along an axis, from a time `begin` on [s]; before that it rests.
template <int Dim>
talus::PrescribedMotion<Dim> ground_motion(GroundRecord record, int axis, double begin = 0.0) {
    using V = talus::Vector<Dim>;
    std::vector<V> shaken;
    for (double& t : record.time) t += begin;
    for (const double a : record.acceleration) shaken.push_back(a * V::Unit(axis));
    return talus::PrescribedMotion<Dim>::of_accelerations({}, record.time, shaken);
}

/// How far a block slips on ground that shakes so, [m]: N. M. Newmark's sliding block (Effects of
/// earthquakes on dams and embankments, Geotechnique 15 (1965) 139), which goes with the ground
/// until that accelerates by more than mu g, and is then braked by it. Positive: along the axis.
inline double newmark_slip(const GroundRecord& record, double mu, double g) {
    const double most = mu * g;
    double slip = 0.0, velocity = 0.0;  // relative to the ground [m, m/s]
    constexpr int parts = 1000;         // of each interval
    for (std::size_t k = 0; k + 1 < record.time.size(); ++k) {
        const double h = (record.time[k + 1] - record.time[k]) / parts;
        for (int j = 0; j < parts; ++j) {
            const double s = (j + 0.5) / parts;
            const double ground =
                record.acceleration[k] + s * (record.acceleration[k + 1] - record.acceleration[k]);
            // The velocity that it would have if it were free, less what friction takes.
            const double free = velocity - h * ground;
            const double next = std::copysign(std::max(0.0, std::abs(free) - h * most), free);
            slip += 0.5 * h * (velocity + next);
            velocity = next;
        }
    }
    return slip;
}

}  // namespace lab
