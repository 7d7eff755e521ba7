// SPDX-License-Identifier: BSL-1.0
#include <talus/io/svg.hpp>
#include <talus/measure/fabric.hpp>

#include "harness/gsl.hpp"
#include "measured.hpp"

namespace validation {
namespace G06 {

constexpr double a2 = 0.2, a4 = 0.1, angle2 = 0.3, angle4 = 0.7;
constexpr std::size_t sectors = 24;

double density(double angle) {
    return (1 + a2 * std::cos(2 * (angle - angle2)) + a4 * std::cos(4 * (angle - angle4))) /
           (2 * pi);
}
/// Its integral from 0.
double cumulative(double angle) {
    return (angle + a2 / 2 * (std::sin(2 * (angle - angle2)) + std::sin(2 * angle2)) +
            a4 / 4 * (std::sin(4 * (angle - angle4)) + std::sin(4 * angle4))) /
           (2 * pi);
}

talus::DirectionHistogram sampled(std::mt19937_64 rng, int count) {
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    talus::DirectionHistogram histogram(sectors);
    for (int k = 0; k < count;) {
        const double angle = 2 * pi * uniform(rng);
        if (uniform(rng) * (1 + a2 + a4) > density(angle) * 2 * pi) continue;
        histogram.add(V<2>(std::cos(angle), std::sin(angle)));
        ++k;
    }
    return histogram;
}

/// The library's fit, as measured.
talus::FabricHarmonic fitted(const TrialRecord& trial, const talus::DirectionHistogram& histogram,
                             int order) {
    talus::FabricHarmonic harmonic = talus::fit_harmonic(histogram, order);
    const double half = order * pi / sectors;
    if (trial.faulty(Fault::mean_over_sectors_forgotten))
        harmonic.amplitude *= std::sin(half) / half;
    return harmonic;
}

/// Amplitudes and directions by general linear least squares, sector factor included.
std::vector<double> reference_fit(const talus::DirectionHistogram& histogram) {
    std::vector<std::vector<double>> rows;
    std::vector<double> y;
    for (std::size_t k = 0; k < sectors; ++k) {
        const double middle = (static_cast<double>(k) + 0.5) * 2 * pi / sectors;
        std::vector<double> row{1.0};
        for (const int n : {2, 4}) {
            const double half = n * pi / sectors, factor = std::sin(half) / half;
            row.push_back(factor * std::cos(n * middle));
            row.push_back(factor * std::sin(n * middle));
        }
        rows.push_back(row);
        y.push_back(histogram.count(k) / histogram.total() * sectors);
    }
    return gsl::fit_linear(rows, y);
}

std::string rose(const talus::DirectionHistogram& histogram) {
    talus::Svg svg({-1.5, -1.2}, {1.5, 1.2}, 420.0);
    const auto at = [](double radius, double angle) {
        return V<2>(radius * std::cos(angle), radius * std::sin(angle));
    };
    for (std::size_t k = 0; k < sectors; ++k) {
        const double radius = histogram.density(k) * 2 * pi * 0.8;
        const double low = histogram.middle(k) - pi / sectors, high = low + 2 * pi / sectors;
        const std::vector<V<2>> wedge{V<2>(0, 0), at(radius, low), at(radius, high)};
        svg.polygon(wedge, {.fill = "#e9d8a6", .stroke = "#8a7f5c", .stroke_width = 0.008});
    }
    std::vector<V<2>> curve;
    for (int k = 0; k <= 180; ++k)
        curve.push_back(at(density(2 * pi * k / 180) * 2 * pi * 0.8, 2 * pi * k / 180));
    svg.polyline(curve, {.fill = "none", .stroke = "#1f5fa8", .stroke_width = 0.02});
    return svg.str();
}

void run(Trial<2>& trial) {
    // The exact content of every sector gives the coefficients back.
    talus::DirectionHistogram exact(sectors);
    for (std::size_t k = 0; k < sectors; ++k) {
        const double low = 2 * pi * static_cast<double>(k) / sectors;
        exact.add(V<2>(std::cos(exact.middle(k)), std::sin(exact.middle(k))),
                  cumulative(low + 2 * pi / sectors) - cumulative(low));
    }
    trial.rounding("a_2 from exact sector contents", fitted(trial, exact, 2).amplitude, a2, 10);
    trial.rounding("a_4 from exact sector contents", fitted(trial, exact, 4).amplitude, a4, 10);
    trial.rounding("angle of a_2 [rad]", fitted(trial, exact, 2).direction, angle2, 100);
    trial.rounding("angle of a_4 [rad]", fitted(trial, exact, 4).direction, angle4, 100);

    const int count = 100000;
    const double error = std::sqrt(2.0 / count);
    std::vector<double> second, fourth;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        const auto histogram = sampled(trial.rng(seed), count);
        const auto two = fitted(trial, histogram, 2), four = fitted(trial, histogram, 4);
        const std::vector<double> c = reference_fit(histogram);
        const std::string which = ", sample " + std::to_string(seed);
        trial.rounding("a_2 against linear least squares" + which, two.amplitude,
                       std::hypot(c[1], c[2]), 10);
        trial.rounding("a_4 against linear least squares" + which, four.amplitude,
                       std::hypot(c[3], c[4]), 10);
        // The part along the direction looked for; across it there is noise alone.
        second.push_back(two.amplitude * std::cos(2 * (two.direction - angle2)));
        fourth.push_back(four.amplitude * std::cos(4 * (four.direction - angle4)));
        trial.within("a_2" + which, second.back(), a2, 4 * error, "4 √(2/N)", 0.0, Class::X);
        trial.within("a_4" + which, fourth.back(), a4, 4 * error, "4 √(2/N)", 0.0, Class::X);
        if (seed == 0) {
            trial.drawing(rose(histogram));
            Series bars{"24 sectors", {}, {}}, line{"exact", {}, {}, true};
            for (std::size_t k = 0; k < sectors; ++k) {
                bars.x.push_back(histogram.middle(k) / degree);
                bars.y.push_back(histogram.density(k));
            }
            for (int k = 0; k <= 180; ++k) {
                line.x.push_back(2.0 * k);
                line.y.push_back(density(2 * k * degree));
            }
            trial.curves({"density of directions", "angle [deg]", "1 / rad", {line, bars}});
        }
    }
    trial.statistic("mean of a_2", second, a2);
    trial.statistic("mean of a_4", fourth, a4);
}

const Register g06(
    {.id = "G06",
     .name = "fabric-histogram",
     .title = "Fourier fit of contact directions",
     .gate = 1,
     .setup = "Eight samples of 100,000 directions drawn from a known density, counted over 24 "
              "sectors as in Moreau's drawings.",
     .reference =
         {"frac{1}{2 π} (1 + a_2 cos 2(θ − θ_2) + a_4 cos 4(θ − θ_4))",
          "a_n = frac{2 ⟨cos n(θ − θ_n)⟩}{f_n}, f_n = frac{sin(n d / 2)}{n d / 2}, d = 15°",
          "standard error √{2/N} = 0.0045"},
     .compared = "Coefficients from exact sector contents; against general linear least squares "
                 "for every sample; each sample and their mean against the truth.",
     .kind = Class::X,
     .why = "Least squares on equal sectors is orthogonal, so the short formula equals the general "
            "one to rounding. Samples scatter by √(2/N).",
     .source = "Derived; Moreau, section 3.3.",
     .catches = {Fault::mean_over_sectors_forgotten}},
    run, nullptr, __FILE__);

}  // namespace G06
}  // namespace validation
