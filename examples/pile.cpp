// SPDX-License-Identifier: BSL-1.0
//
// The main job: grains settle under gravity in a box, in the plane or in space, from one text. At
// the end comes a certificate of the answer, and pictures in the manner of Moreau: grains grey by
// their load, force chains as segments as wide as the force.
//
// The simulation is in pile/settle.hpp, what a certificate finds impossible in pile/verdict.hpp.
//
// Sample runs:  examples/run
//               examples/run pile --dim 3 --shape polyhedron --count 200
//               examples/run pile --scene examples/scenes/discs.txt --json certificate.json
#include <talus/io/scene_file.hpp>

#include <cstdio>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "pile/certificate.hpp"
#include "pile/job.hpp"
#include "pile/outputs.hpp"
#include "pile/read_options.hpp"
#include "pile/stop_request.hpp"

namespace pile {

enum ExitCode { all_certified = 0, failed = 1, wrong_input = 2, not_certified = 3, stopped = 128 };

void complain(const std::exception& error) {
    std::fprintf(stderr, "pile: %s\n", talus::detail::printable(error.what()).c_str());
}

/// The dimensions that are asked for. Throws input_error if the scene is of another one.
std::vector<int> dimensions(const Options& o) {
    int dim = o.dim;
    if (!o.scene.empty()) {
        dim = talus::scene_dimension(o.scene);
        if (o.dim != 0 && o.dim != dim)
            throw talus::input_error("--dim is " + std::to_string(o.dim) + ", but " + o.scene +
                                     " is a scene of dimension " + std::to_string(dim));
    } else if (dim == 0 && !o.shape.empty()) {
        dim = o.shape == "disc" || o.shape == "polygon" ? 2 : 3;
    }
    return dim == 0 ? std::vector{2, 3} : std::vector{dim};
}

/// Settles piles one after the other, and writes what there is of each before the next one begins.
class Program {
  public:
    explicit Program(const Options& o) : options_(o) {
        const auto dims = dimensions(o);
        for (const int dim : dims) jobs_.push_back(dim == 2 ? plane_job(o) : space_job(o));
        try_outputs(o, dims);
        if (!o.json.empty() && talus::is_standard_output(o.json)) words_ = stderr;
    }

    int run() {
        StopRequest::listen();
        for (const auto& job : jobs_) {
            if (StopRequest::signal() != 0) break;
            std::fprintf(words_, "%s\n", job->title().c_str());
            std::fflush(words_);
            settle(*job, job == jobs_.back());
        }
        if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
            fail(std::runtime_error("cannot write to standard output"));
        if (failed_) return ExitCode::failed;
        if (const int signal = StopRequest::signal()) return ExitCode::stopped + signal;
        return certified_ ? ExitCode::all_certified : ExitCode::not_certified;
    }

  private:
    /// Figures come before pictures, and what cannot be written does not keep the rest from it.
    void settle(Job& job, bool last) {
        const Figures figures = job.run();
        all_.push_back(json_of(figures));
        certified_ = certified_ && certified(figures);
        if (!figures.failure.empty()) fail(std::runtime_error(figures.failure));
        if (!options_.json.empty())
            attempt([&] { write_json(last || StopRequest::signal() != 0); });
        std::fprintf(words_, "Certificate\n%s", text_of(figures).c_str());
        attempt([&] {
            for (const std::string& file : job.write_pictures(figures.mean_grain_weight()))
                say_written(file);
        });
        std::fflush(words_);
    }

    /// A file is written anew after each pile; what cannot be replaced, once.
    void write_json(bool last) {
        if (talus::is_stream(options_.json) && !last) return;
        using Json = nlohmann::json;
        talus::write_file(options_.json,
                          all_.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
        if (!talus::is_stream(options_.json)) say_written(options_.json);
    }
    void say_written(const std::string& file) {
        std::fprintf(words_, "  wrote %s\n", talus::detail::printable(file).c_str());
    }

    template <class Action>
    void attempt(Action&& action) {
        try {
            action();
        } catch (const std::exception& error) {
            fail(error);
        }
    }
    void fail(const std::exception& error) {
        complain(error);
        failed_ = true;
    }

    Options options_;
    std::vector<std::unique_ptr<Job>> jobs_;
    nlohmann::json all_ = nlohmann::json::array();
    std::FILE* words_ = stdout;
    bool certified_ = true, failed_ = false;
};

}  // namespace pile

int main(int argc, char** argv) {
    try {
        const auto options = pile::read_options(argc, argv);
        return options ? pile::Program(*options).run() : 0;
    } catch (const talus::input_error& error) {
        pile::complain(error);
        return pile::ExitCode::wrong_input;
    } catch (const std::exception& error) {
        pile::complain(error);
        return pile::ExitCode::failed;
    }
}
