// SPDX-License-Identifier: BSL-1.0
#include "statics.hpp"

namespace validation {
namespace D16 {

constexpr double load = 0.7;  // relative to the table's weight
const V<3> place(0.2, 0.1, 0.0);

World<3> table(Trial<3>& trial, double h) {
    auto world = trial.world(statics_params<3>(h, 0.3));
    world.add_floor();
    const V<3> half(0.5, 0.5, 0.05);
    const auto plate =
        world.add(talus::Box<3>(half), box_inertia<3>(1.0 / g, half), {0.05 * up<3>(), {}});
    push<3>(world, plate, place, -load * up<3>());
    return world;
}

void run(Trial<3>& trial) {
    const auto report = expect<3>(trial, "table", true, [&](double h) { return table(trial, h); });
    double sum = 0.0, first = 0.0, second = 0.0, lowest = 1.0, around = 0.0;
    for (std::size_t c = 0; c < report.data.contact_count(); ++c) {
        const V<3> at = report.data.contacts.point[c];
        const double n = force_on<3>(report, 1, c)[2];
        sum += n;
        first += at[0] * n;
        second += at[1] * n;
        around += (at[0] * at[1] > 0 ? 1 : -1) * n;
        lowest = std::min(lowest, n);
    }
    trial.holds("four legs", report.data.contact_count() == 4);
    trial.solver("sum / W", sum, 1 + load, 2.0, statics_tolerance);
    trial.solver("first moment along the first axis / (W m)", first, place[0] * load, 2.0,
                 statics_tolerance);
    trial.solver("first moment along the second axis / (W m)", second, place[1] * load, 2.0,
                 statics_tolerance);
    trial.holds("no leg pulls", lowest >= 0.0);
    trial.note("N_1 − N_2 + N_3 − N_4 = " + std::to_string(around) + " W: found, not determined");
}

const Register d16(
    {.id = "D16",
     .name = "four-leg-table",
     .title = "A table on four legs",
     .gate = 2,
     .setup = "A square plate 1 m wide of weight W stands on its four corners and carries 0.7 W at "
              "(0.2, 0.1) m from its middle.",
     .reference = {"N_1 + N_2 + N_3 + N_4 = W + w",
                   "Σ x_i N_i = 0.2 w, Σ y_i N_i = 0.1 w, N_i ≥ 0"},
     .compared = "The three sums that statics determines. The fourth combination, N_1 − N_2 + N_3 "
                 "− N_4, is found but not determined; the Delassus matrix has rank 3 in it.",
     .kind = Class::S,
     .why = "The solver reaches 1e-12 in spite of the singular matrix; sums add two weights.",
     .source = "Elementary statics.",
     .catches = {Fault::short_arm, Fault::residual_ignored}},
    nullptr, run, __FILE__);

}  // namespace D16
}  // namespace validation
