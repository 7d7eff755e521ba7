// SPDX-License-Identifier: BSL-1.0
#include "command.hpp"

#include <talus/core/input.hpp>

#include <CLI/CLI.hpp>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "../number_option.hpp"

namespace lab {
namespace {

std::string joined(const std::vector<double>& values, std::string (*text)(double)) {
    std::string list;
    for (const double x : values) list += (list.empty() ? "" : ",") + text(x);
    return list;
}

std::string exact(double x) {
    std::array<char, 32> digits{};
    return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), x).ptr};
}

}  // namespace

struct Command::Parts {
    struct Number {
        std::string option;
        double* value;
        double at_full;
        CLI::Option* given;
        bool whole = false;
    };

    struct List {
        std::string option;
        std::vector<double>* values;
        std::vector<double> at_full;
        CLI::Option* given;
    };

    Parts(const std::string& program, const std::string& about)
        : name(program), app(about, program) {}
    std::string name, out = name + "-out";
    CLI::App app;
    std::vector<Number> numbers;
    std::vector<std::pair<std::string, std::string*>> files;
    std::vector<List> lists;
    double seed = 1, save_every = 30, frames = 0;
    bool full = false, fresh = false, quiet = false;
};

Command::Command(const std::string& name, const std::string& about)
    : parts_(std::make_unique<Parts>(name, about)) {
    Parts& p = *parts_;
    p.app.footer(
        "A run that was stopped (Ctrl-C) or killed goes on where its last checkpoint is, with "
        "the same\nbits, when it is started again with the same options; --fresh begins anew.\n"
        "Exit codes: 0 certified, 3 not certified, 2 wrong input, 1 any other failure, 130 or "
        "143 stopped.\nUnits are SI.\n");
    p.app.add_option("--out", p.out, "folder for results, made if there is none (" + p.out + ")");
    add_number(p.app, "--seed", p.seed, 0, 1e15, "of everything random (1)");
    add_number(p.app, "--save-every", p.save_every, 0, 1e9,
               "work between two checkpoints [s] (30)");
    add_number(p.app, "--frames", p.frames, 0, 1000,
               "of a movie for examples/player, for each second [1/s]; 0: none (0)");
    p.app.add_flag("--full", p.full, "the paper's size, where that takes longer than minutes");
    p.app.add_flag("--fresh", p.fresh, "begin anew, whatever there is");
    p.app.add_flag("--quiet", p.quiet, "no progress bar");
}
Command::~Command() = default;

void Command::number(const std::string& option, double& value, double low, double high,
                     const std::string& help) {
    CLI::Option* given = add_number(parts_->app, option, value, low, high,
                                    help + " (" + talus::detail::text_of(value) + ")");
    parts_->numbers.push_back({option, &value, value, given});
}
void Command::number(const std::string& option, double& value, double at_full, double low,
                     double high, const std::string& help) {
    number(option, value, low, high,
           help + "; " + talus::detail::text_of(at_full) + " with --full");
    parts_->numbers.back().at_full = at_full;
}
void Command::count(const std::string& option, double& value, double low, double high,
                    const std::string& help) {
    number(option, value, low, high, help);
    parts_->numbers.back().whole = true;
}
void Command::count(const std::string& option, double& value, double at_full, double low,
                    double high, const std::string& help) {
    number(option, value, at_full, low, high, help);
    parts_->numbers.back().whole = true;
}
void Command::list(const std::string& option, std::vector<double>& values,
                   const std::vector<double>& at_full, double low, double high,
                   const std::string& help) {
    const auto parse = [option, low, high, &values](const std::string& text) {
        values.clear();
        for (const char* at = text.c_str();; ++at) {
            char* end = nullptr;
            const double x = std::strtod(at, &end);
            if (end == at || (*end != '\0' && *end != ',') || !(x >= low && x <= high))
                throw talus::input_error(option + " is '" + text + "', but must be numbers in [" +
                                         talus::detail::text_of(low) + ", " +
                                         talus::detail::text_of(high) + "] separated by commas");
            values.push_back(x);
            at = end;
            if (*at == '\0') return;
        }
    };
    const std::string defaults = joined(values, talus::detail::text_of),
                      full = joined(at_full, talus::detail::text_of);
    CLI::Option* given = parts_->app
                             .add_option_function<std::string>(
                                 option, parse,
                                 help + " (" + defaults + ")" +
                                     (full == defaults ? "" : "; " + full + " with --full"))
                             ->type_name("LIST");
    parts_->lists.push_back({option, &values, at_full, given});
}
void Command::choice(const std::string& option, double& value,
                     const std::vector<std::string>& words, const std::string& help) {
    std::string list;
    for (const std::string& word : words) list += (list.empty() ? "" : ", ") + word;
    CLI::Option* given =
        parts_->app
            .add_option_function<std::string>(
                option,
                [option, words, list, &value](const std::string& text) {
                    for (std::size_t k = 0; k < words.size(); ++k)
                        if (words[k] == text) {
                            value = static_cast<double>(k);
                            return;
                        }
                    throw talus::input_error(option + " is '" + text + "', but must be one of " +
                                             list);
                },
                help + ": " + list + " (" + words.at(static_cast<std::size_t>(value)) + ")")
            ->type_name("WORD");
    parts_->numbers.push_back({option, &value, value, given});
}

void Command::file(const std::string& option, std::string& path, const std::string& help) {
    parts_->app.add_option(option, path, help)->type_name("FILE");
    parts_->files.emplace_back(option, &path);
}

bool Command::read(int argc, char** argv) {
    try {
        parts_->app.parse(argc, argv);
    } catch (const CLI::Success&) {
        std::fputs(parts_->app.help().c_str(), stdout);
        return false;
    } catch (const CLI::ParseError& error) {
        throw talus::input_error(std::string(error.what()) + " (" + name() +
                                 " --help lists the options)");
    }
    for (const Parts::List& l : parts_->lists)
        if (parts_->full && l.given->count() == 0) *l.values = l.at_full;
    for (const Parts::Number& n : parts_->numbers) {
        if (parts_->full && n.given->count() == 0) *n.value = n.at_full;
        if (n.whole && *n.value != std::floor(*n.value))
            throw talus::input_error(n.option + " is " + talus::detail::text_of(*n.value) +
                                     ", but must be a whole number");
    }
    return true;
}

std::string Command::label() const {
    std::string text = name() + " --seed " + exact(parts_->seed);
    for (const Parts::Number& n : parts_->numbers) text += " " + n.option + " " + exact(*n.value);
    for (const auto& [option, path] : parts_->files)
        if (!path->empty()) text += " " + option + " " + *path;
    for (const Parts::List& l : parts_->lists)
        text += " " + l.option + " " + joined(*l.values, exact);
    return text;
}

const std::string& Command::name() const { return parts_->name; }
std::filesystem::path Command::out() const { return parts_->out; }
std::uint64_t Command::seed() const { return static_cast<std::uint64_t>(parts_->seed); }
double Command::save_every() const { return parts_->save_every; }
double Command::frames() const { return parts_->frames; }
bool Command::quiet() const { return parts_->quiet; }
bool Command::fresh() const { return parts_->fresh; }

}  // namespace lab
