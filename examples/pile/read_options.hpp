// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/solver/any_solver.hpp>

#include <CLI/CLI.hpp>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>

#include "../number_option.hpp"
#include "options.hpp"

namespace pile {

inline void require_one_of(const std::string& name, const std::string& value,
                           std::initializer_list<const char*> choices) {
    std::string list;
    for (const char* choice : choices) {
        if (value == choice) return;
        list += (list.empty() ? "" : ", ") + std::string(choice);
    }
    throw talus::input_error(name + " is '" + value + "', but must be one of " + list);
}

inline void check(const Options& o) {
    for (const auto& [name, value] :
         {std::pair{"--count", o.count}, {"--seed", o.seed}, {"--max-sweeps", o.max_sweeps}})
        if (value != std::floor(value))
            throw talus::input_error(std::string(name) + " is " + talus::detail::text_of(value) +
                                     ", but must be a whole number");
    if (std::llround(o.duration / o.step) == 0)
        throw talus::input_error("--duration is less than half of --step, but must hold a step");
    require_one_of("--scheme", o.scheme, {"anticipating", "midpoint"});
    if (!o.solver.empty()) talus::make_solver<3, talus::Coulomb<3>>(o.solver);
    if (o.shape.empty()) return;
    require_one_of("--shape", o.shape, {"disc", "polygon", "sphere", "polyhedron"});
    const bool plane = o.shape == "disc" || o.shape == "polygon";
    if (o.dim != 0 && plane != (o.dim == 2))
        throw talus::input_error("--shape is '" + o.shape + "', but --dim " +
                                 std::to_string(o.dim) + " has " +
                                 (o.dim == 2 ? "disc, polygon" : "sphere, polyhedron"));
}

/// What --help says of solvers.
inline std::string known_solvers() {
    std::string text =
        "by name (Gauss-Seidel with momentum, the default of simulations, and automatic for what "
        "it does not solve), or one of:";
    for (const auto& [name, description] : talus::solver_names<3, talus::Coulomb<3>>())
        text += "\n" + std::string(name) + ": " + std::string(description);
    return text;
}

/// Reads the command line; nothing if it asked for help, which was then printed. Throws
/// input_error, one sentence, on anything wrong.
inline std::optional<Options> read_options(int argc, char** argv) {
    Options o;
    double dim = 0;
    CLI::App app(
        "Grains settle under gravity in a box. With no options a few hundred polygons settle in "
        "the\n"
        "plane and then as many spheres in space. Every answer comes with a certificate: how well "
        "the\n"
        "exact laws of contact and friction are obeyed, overlaps, where the energy went, and "
        "whether the\n"
        "floor carries the weight; and with pictures.\n",
        "pile");
    app.footer(
        "Examples:\n"
        "  pile --dim 2 --shape disc --count 1000\n"
        "  pile --scene examples/scenes/polyhedra.txt --duration 0.6 --json certificate.json\n"
        "  pile --json - --quiet | python3 -m json.tool\n"
        "Ctrl-C (SIGINT) or SIGTERM ends the run after the step under way; what there is by then "
        "is\n"
        "certified and written. A second one ends the program at once.\n"
        "Exit codes: 0 certified, 3 not certified (a step missed its tolerance, or the figures "
        "show what\n"
        "cannot be), 2 wrong input, 1 any other failure, 130 or 143 stopped by SIGINT or SIGTERM.\n"
        "Units are SI. The format of scenes is described in include/talus/io/README.md.\n");
    app.add_option("--scene", o.scene, "scene file to settle, instead of a generated pile");
    add_number(app, "--dim", dim, 2, 3, "dimension of a generated pile: 2 or 3 (both)");
    app.add_option("--shape", o.shape, "disc, polygon (2D), sphere, polyhedron (3D)");
    add_number(app, "--count", o.count, 1, 1e6, "grains to generate (400)");
    add_number(app, "--seed", o.seed, 0, 1e15, "of the random grains (1)");
    add_number(app, "--mu", o.mu, 0, 1e3, "friction coefficient (the scene's; 0.4)");
    add_number(app, "--restitution", o.restitution, 0, 1, "of all contacts, normal (0)");
    add_number(app, "--duration", o.duration, 1e-9, 1e6, "time to settle [s] (1)");
    add_number(app, "--step", o.step, 1e-9, 1e3,
               "step size [s] (5e-4: a fraction of a grain's time to fall its own radius)");
    app.add_option("--solver", o.solver, known_solvers());
    add_number(app, "--tolerance", o.tolerance, 1e-14, 1,
               "on the residual of every step: of all contacts together, and a tenth of the worst "
               "one's (1e-4); 1e-8 is for the patient");
    add_number(app, "--max-sweeps", o.max_sweeps, 1, 1e9,
               "sweeps, or what else the solver counts, allowed per step (20000); steps that miss "
               "the tolerance are counted");
    app.add_option("--scheme", o.scheme,
                   "anticipating (contacts may close their gap but not more) or midpoint (the "
                   "paper's)");
    add_number(app, "--correction", o.correction, 0, 1,
               "share of overlaps removed per step, positions only (0)");
    app.add_option("--out", o.out,
                   "folder for pictures and VTK files, made if there is none (pile-out)");
    app.add_option("--json", o.json,
                   "file for the certificate and the figures of every step; - or /dev/stdout: "
                   "standard output, all other text then goes to standard error");
    app.add_flag("--quiet", o.quiet, "no progress bar");
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success&) {
        std::fputs(app.help().c_str(), stdout);
        return std::nullopt;
    } catch (const CLI::ParseError& error) {
        throw talus::input_error(std::string(error.what()) + " (pile --help lists the options)");
    }
    if (dim != 0 && dim != 2 && dim != 3)
        throw talus::input_error("--dim is " + talus::detail::text_of(dim) +
                                 ", but must be 2 or 3");
    o.dim = static_cast<int>(dim);
    if (o.json == "-") o.json = "/dev/stdout";
    check(o);
    return o;
}

}  // namespace pile
