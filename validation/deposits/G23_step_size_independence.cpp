// SPDX-License-Identifier: BSL-1.0
#include <talus/measure/penetration.hpp>

#include <algorithm>
#include <array>

#include "deposit.hpp"

namespace validation {
namespace G23 {

/// What is looked at when a deposit has come to rest.
struct Averages {
    double solid_fraction;  ///< below nine tenths of the mean height, away from the floor
    double coordination;    ///< contacts that carry an impulse, per ball, twice for those between
    double overlap;         ///< mean over these contacts, over the mean diameter
};

/// Part of a ball of radius r that lies below a plane at distance `over` above its centre.
double share_below(int dim, double r, double over) {
    const double c = std::clamp(over / r, -1.0, 1.0);
    if (dim == 2) return 1.0 - (std::acos(c) - c * std::sqrt(1 - c * c)) / pi;
    return 0.25 * (2 + 3 * c - c * c * c);
}

template <int Dim>
Averages averages(const World<Dim>& world, const Deposit<Dim>& deposit) {
    const auto& bodies = world.bodies();
    const auto& shapes = world.system().shapes();
    std::vector<double> heights;
    for (std::size_t i = Deposit<Dim>::walls; i < bodies.count(); ++i)
        heights.push_back(bodies.position[i][Dim - 1]);
    std::sort(heights.begin(), heights.end());
    const double top = 0.9 * heights[heights.size() * 95 / 100], bottom = 4 * deposit.mean;
    double solid = 0.0;
    for (std::size_t i = Deposit<Dim>::walls; i < bodies.count(); ++i) {
        const double r = shapes[i].template get_if<talus::Ball<Dim>>()->radius();
        const double y = bodies.position[i][Dim - 1];
        const double volume = Dim == 2 ? pi * r * r : 4.0 / 3 * pi * r * r * r;
        solid += volume * (share_below(Dim, r, top - y) - share_below(Dim, r, bottom - y));
    }
    const auto& data = world.data();
    const auto carries = [&](std::size_t c) { return data.impulse[c][0] > 0.0; };
    double ends = 0.0;
    for (std::size_t c = 0; c < data.contact_count(); ++c)
        if (carries(c))
            ends += bodies.is_obstacle(static_cast<std::size_t>(data.contacts.key[c].a)) ? 1 : 2;
    return {solid / (std::pow(deposit.width(), Dim - 1) * (top - bottom)), ends / deposit.count,
            talus::penetration<Dim>(data.contacts, carries).mean / (2 * deposit.mean)};
}

template <int Dim>
void run(Trial<Dim>& trial) {
    const Deposit<Dim> deposit{500, Dim == 2 ? 32 : 8};
    const std::array steps{1e-4, 5e-5, 2.5e-5};
    const int realisations = 5;
    std::array<std::vector<Averages>, 3> seen;
    for (std::size_t k = 0; k < steps.size(); ++k)
        for (int seed = 0; seed < realisations; ++seed) {
            auto world = deposit.make(trial,
                                      {.h = steps[k],
                                       .contact = law<Dim>(0.3),
                                       .solver = {.max_sweeps = 2000, .tolerance = 1e-4},
                                       .solver_name = "momentum_gauss_seidel"},
                                      static_cast<std::uint64_t>(seed));
            world.run(0.5);
            seen[k].push_back(averages<Dim>(world, deposit));
        }
    const auto mean_of = [&](std::size_t k, double Averages::*what) {
        double mean = 0.0, squares = 0.0;
        for (const Averages& a : seen[k]) mean += a.*what / realisations;
        for (const Averages& a : seen[k]) squares += (a.*what - mean) * (a.*what - mean);
        return std::pair{mean, std::sqrt(squares / (realisations - 1.0) / realisations)};
    };
    const auto agree = [&](const std::string& name, double Averages::*what) {
        const auto [fine, fine_error] = mean_of(2, what);
        for (const std::size_t k : {0u, 1u}) {
            const auto [mean, error] = mean_of(k, what);
            trial.within(name, mean, fine, 3 * std::hypot(error, fine_error),
                         "3 standard errors, against the smallest h", steps[k], Class::X);
        }
    };
    agree("solid fraction", &Averages::solid_fraction);
    agree("coordination number", &Averages::coordination);
    // Overlap: proportional to h.
    Series overlaps{"mean overlap", {}, {}};
    for (std::size_t k = 0; k < steps.size(); ++k) {
        const double overlap = mean_of(k, &Averages::overlap).first;
        overlaps.x.push_back(steps[k]);
        overlaps.y.push_back(overlap);
        const double fall =
            std::sqrt(2 * g * deposit.pitch * deposit.count / std::pow(deposit.across, Dim - 1));
        trial.within("mean overlap / diameter", overlap, 0.0, steps[k] * fall / (2 * deposit.mean),
                     "h times the speed of the highest fall, over the diameter", steps[k]);
    }
    for (const std::size_t k : {0u, 1u}) {
        const auto [coarse, coarse_error] = mean_of(k, &Averages::overlap);
        const auto [fine, fine_error] = mean_of(k + 1, &Averages::overlap);
        const double order = std::log2(coarse / fine);
        const double error = std::hypot(coarse_error / coarse, fine_error / fine) / std::log(2.0);
        trial.holds("the mean overlap shrinks at least in the first order", order > 0.9 - 3 * error,
                    "order " + std::to_string(order) + " ± " + std::to_string(error), steps[k + 1]);
    }
    trial.curves(
        {"overlap over step size",
         "h [s]",
         "mean overlap / diameter",
         {overlaps,
          {"proportional", {0.0, steps[0]}, {0.0, overlaps.y[2] / steps[2] * steps[0]}, true}}});
}

const Register g23(
    {.id = "G23",
     .name = "step-size-independence",
     .title = "Averages do not depend on the step size",
     .gate = 3,
     .setup = "500 discs (spheres) of 4 to 6 mm radius fall into a box and come to rest, five "
              "realisations each at h = 0.1, 0.05 and 0.025 ms, friction 0.3.",
     .reference = {"solid fraction and coordination number: the same",
                   "overlap / d ∼ frac{h v_{impact}}{d}"},
     .compared = "Averages of h and h/2 with those of h/4 within three standard errors; the mean "
                 "overlap with h.",
     .kind = Class::X,
     .why =
         "Runs of different h part company (chaos), their averages must not. Overlap is what "
         "the midpoint rule leaves at an impact: h times the speed. Contacts that close slowly, "
         "at speeds of order g h, add a part of second order, so the order lies between. At "
         "h = 0.2 ms balls enter each other by some hundredths of their radius as they fall, and "
         "have 0.07 contacts more, 3.5 standard errors.",
     .source = "Derived.",
     .catches = {Fault::loose_contact, Fault::reaction_lost}},
    run<2>, run<3>, __FILE__);

}  // namespace G23
}  // namespace validation
