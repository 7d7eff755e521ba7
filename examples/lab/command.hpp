// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/printable.hpp>

#include <CLI/CLI.hpp>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "../number_option.hpp"

namespace lab {

enum ExitCode { certified = 0, failed = 1, wrong_input = 2, not_certified = 3, stopped = 128 };

/// What every experiment can be asked: where its results go, its seed, its size. An experiment adds
/// numbers of its own, and then reads the command line.
class Command {
  public:
    /// `about` is one paragraph for --help.
    Command(std::string name, const std::string& about)
        : name_(std::move(name)), app_(about, name_) {
        out_ = name_ + "-out";
        app_.footer(
            "A run that was stopped (Ctrl-C) or killed goes on where its last checkpoint is, with "
            "the same\nbits, when it is started again with the same options; --fresh begins anew.\n"
            "Exit codes: 0 certified, 3 not certified, 2 wrong input, 1 any other failure, 130 or "
            "143 stopped.\nUnits are SI.\n");
        app_.add_option("--out", out_, "folder for results, made if there is none (" + out_ + ")");
        add_number(app_, "--seed", seed_, 0, 1e15, "of everything random (1)");
        add_number(app_, "--save-every", save_every_, 0, 1e9,
                   "work between two checkpoints [s] (30)");
        app_.add_flag("--full", full_, "the paper's size, where that takes longer than minutes");
        app_.add_flag("--fresh", fresh_, "begin anew, whatever there is");
        app_.add_flag("--quiet", quiet_, "no progress bar");
    }

    /// A number of the experiment, with its default.
    void number(const std::string& option, double& value, double low, double high,
                const std::string& help) {
        numbers_.push_back({option, &value, value, nullptr});
        numbers_.back().given = add_number(app_, option, value, low, high,
                                           help + " (" + talus::detail::text_of(value) + ")");
    }
    /// The same with another default for --full.
    void number(const std::string& option, double& value, double at_full, double low, double high,
                const std::string& help) {
        number(option, value, low, high,
               help + "; " + talus::detail::text_of(at_full) + " with --full");
        numbers_.back().at_full = at_full;
    }

    /// The same of what is shown alone: a checkpoint does not ask for it.
    void shown_number(const std::string& option, double& value, double low, double high,
                      const std::string& help) {
        number(option, value, low, high, help);
        numbers_.back().of_physics = false;
    }

    /// Reads the command line; false if it asked for help, which was then printed. Throws
    /// input_error, one sentence.
    bool read(int argc, char** argv) {
        try {
            app_.parse(argc, argv);
        } catch (const CLI::Success&) {
            std::fputs(app_.help().c_str(), stdout);
            return false;
        } catch (const CLI::ParseError& error) {
            throw talus::input_error(std::string(error.what()) + " (" + name_ +
                                     " --help lists the options)");
        }
        for (const Number& n : numbers_)
            if (full_ && n.given->count() == 0) *n.value = n.at_full;
        return true;
    }
    /// Throws input_error unless the value of an option is a whole number.
    static void require_whole(const std::string& option, double value) {
        if (value != std::floor(value))
            throw talus::input_error(option + " is " + talus::detail::text_of(value) +
                                     ", but must be a whole number");
    }
    /// The experiment with all its numbers, by which a checkpoint knows its own.
    std::string label() const {
        std::string text = name_ + " --seed " + exact(seed_);
        for (const Number& n : numbers_)
            if (n.of_physics) text += " " + n.option + " " + exact(*n.value);
        return text;
    }

    const std::string& name() const { return name_; }
    std::filesystem::path out() const { return out_; }
    std::uint64_t seed() const { return static_cast<std::uint64_t>(seed_); }
    double save_every() const { return save_every_; }  ///< [s] of work
    bool quiet() const { return quiet_; }
    bool fresh() const { return fresh_; }

  private:
    struct Number {
        std::string option;
        double* value;
        double at_full;
        CLI::Option* given;
        bool of_physics = true;
    };
    static std::string exact(double x) {
        std::array<char, 32> digits{};
        return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), x).ptr};
    }

    std::string name_, out_;
    CLI::App app_;
    std::vector<Number> numbers_;
    double seed_ = 1, save_every_ = 30;
    bool full_ = false, fresh_ = false, quiet_ = false;
};

}  // namespace lab
