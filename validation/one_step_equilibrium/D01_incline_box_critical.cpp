// SPDX-License-Identifier: BSL-1.0
#include "statics.hpp"

namespace validation {
namespace D01 {

template <int Dim>
void run(Trial<Dim>& trial) {
    const double a = 0.2, c = 0.1, slope = 20 * degree;
    const V<Dim> half = half_extents<Dim>(a, c, 0.2);
    expect_threshold<Dim>(trial, "mu", 0.3676, 0.3603, [&](double h, double mu) {
        return block_on_incline<Dim>(trial, half, slope, mu, h);
    });
    const auto report = expect<Dim>(trial, "box", true, [&](double h) {
        return block_on_incline<Dim>(trial, half, slope, 0.3676, h);
    });
    double down = 0.0, uphill = 0.0;
    for (std::size_t k = 0; k < report.data.contact_count(); ++k) {
        const double n = force_on<Dim>(report, 1, k)[Dim - 1] / g;
        (report.data.contacts.point[k][0] > 0 ? down : uphill) += n;
    }
    const double middle = 0.5 * std::cos(slope), shift = c / a * std::tan(slope);
    trial.rounding("reference, lower share", 0.5 * (1 + shift), 0.590993, 1e6);
    trial.solver("normal force below / weight", down, middle * (1 + shift), 1.0, statics_tolerance);
    trial.solver("normal force above / weight", uphill, middle * (1 - shift), 1.0,
                 statics_tolerance);
}

const Register d01(
    {.id = "D01",
     .name = "incline-box-critical",
     .title = "A box on an incline at its friction angle",
     .gate = 2,
     .setup = "A box 0.4 m wide and 0.2 m high (0.4 m deep) lies on its corners on an incline of "
              "20 degrees, with friction 1 % above and 1 % below tan 20° = 0.36397.",
     .reference = {"stands if μ > tan β",
                   "N_{down} = frac{W cos β}{2} (1 + frac{c}{a} tan β), "
                   "N_{up} = frac{W cos β}{2} (1 − frac{c}{a} tan β)"},
     .compared = "The verdict at h = 0.01 and 0.0001, cold and warm; the normal forces of the "
                 "lower and the upper corners, in space summed over the pair.",
     .kind = Class::S,
     .why = "The normal forces are determined by the moment balance, so they agree to the solver's "
            "tolerance; how friction is shared is not determined and not compared.",
     .source = "Elementary statics; enumeration of statuses.",
     .catches = {Fault::friction_off, Fault::pulling_contact}},
    run<2>, run<3>, __FILE__);

}  // namespace D01
}  // namespace validation
