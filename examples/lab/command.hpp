// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace lab {

enum ExitCode { certified = 0, failed = 1, wrong_input = 2, not_certified = 3, stopped = 128 };

/// What every experiment can be asked: where its results go, its seed, its size, its movie. An
/// experiment adds numbers of its own, and then reads the command line.
class Command {
  public:
    /// `about` is one paragraph for --help.
    Command(const std::string& name, const std::string& about);
    ~Command();

    /// A number of the experiment, with its default.
    void number(const std::string& option, double& value, double low, double high,
                const std::string& help);
    /// The same with another default for --full.
    void number(const std::string& option, double& value, double at_full, double low, double high,
                const std::string& help);
    /// The same of whole numbers.
    void count(const std::string& option, double& value, double low, double high,
               const std::string& help);
    void count(const std::string& option, double& value, double at_full, double low, double high,
               const std::string& help);
    /// Numbers separated by commas, with others for --full.
    void list(const std::string& option, std::vector<double>& values,
              const std::vector<double>& at_full, double low, double high, const std::string& help);
    /// One of some words, by their place in the list: value 0 is the first. The default is kept.
    void choice(const std::string& option, double& value, const std::vector<std::string>& words,
                const std::string& help);

    /// The path of a file to be read; empty: none.
    void file(const std::string& option, std::string& path, const std::string& help);

    /// Reads the command line; false if it asked for help, which was then printed. Throws
    /// input_error, one sentence.
    bool read(int argc, char** argv);
    /// The experiment with all its numbers, by which a checkpoint knows its own.
    std::string label() const;

    const std::string& name() const;
    std::filesystem::path out() const;
    std::uint64_t seed() const;
    double save_every() const;  ///< [s] of work
    double frames() const;      ///< of a movie [1/s]
    bool quiet() const;
    bool fresh() const;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace lab
