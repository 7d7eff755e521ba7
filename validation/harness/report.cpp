// SPDX-License-Identifier: BSL-1.0
#include "report.hpp"

#include <talus/core/version.hpp>

#include <Eigen/Core>
#include <gsl/gsl_version.h>

#include <cmath>
#include <fstream>
#include <string>
#include <sys/utsname.h>
#include <thread>

namespace validation {

namespace {

using nlohmann::ordered_json;

/// JSON has no infinities.
ordered_json number(double x) { return std::isfinite(x) ? ordered_json(x) : ordered_json(nullptr); }

ordered_json numbers(const std::vector<double>& list) {
    ordered_json result = ordered_json::array();
    for (const double x : list) result.push_back(number(x));
    return result;
}

ordered_json json_of(const Check& c) {
    return {{"label", c.label},
            {"class", name_of(c.kind)},
            {"h", c.h > 0.0 ? ordered_json(c.h) : ordered_json(nullptr)},
            {"measured", number(c.measured)},
            {"expected", number(c.expected)},
            {"error", number(c.error)},
            {"bound", number(c.bound)},
            {"unit", c.unit},
            {"passed", c.passed()},
            {"note", c.note}};
}

ordered_json json_of(const OrderStudy& s) {
    return {{"label", s.label},
            {"h", numbers(s.h)},
            {"error", numbers(s.error)},
            {"slope", number(s.slope)},
            {"slope_error", number(s.slope_error)},
            {"constant", number(s.constant)},
            {"band", {s.band.low, s.band.high}},
            {"passed", s.passed()}};
}

ordered_json json_of(const Curves& c) {
    ordered_json series = ordered_json::array();
    for (const Series& s : c.series)
        series.push_back(
            {{"name", s.name}, {"x", numbers(s.x)}, {"y", numbers(s.y)}, {"exact", s.exact}});
    return {{"label", c.label}, {"x_label", c.x_label}, {"y_label", c.y_label}, {"series", series}};
}

template <class List>
ordered_json list_of(const List& list) {
    ordered_json result = ordered_json::array();
    for (const auto& item : list) result.push_back(json_of(item));
    return result;
}

ordered_json json_of(const Result& r) {
    return {{"dim", r.dim},
            {"verdict", name_of(r.verdict)},
            {"seconds", r.seconds},
            {"budget", r.budget()},
            {"error", r.error},
            {"drawing", r.record.drawing()},
            {"checks", list_of(r.record.checks())},
            {"orders", list_of(r.record.orders())},
            {"curves", list_of(r.record.all_curves())},
            {"notes", r.record.notes()}};
}

ordered_json json_of(const Case& c) {
    ordered_json catches = ordered_json::array();
    for (const Fault fault : c.text.catches) catches.push_back(std::string(text_of(fault).name));
    return {{"id", c.text.id},
            {"name", c.text.name},
            {"title", c.text.title},
            {"section", c.section()},
            {"family", c.family},
            {"gate", c.text.gate},
            {"dims", c.dims()},
            {"setup", c.text.setup},
            {"reference", c.text.reference},
            {"compared", c.text.compared},
            {"class", name_of(c.text.kind)},
            {"why", c.text.why},
            {"source", c.text.source},
            {"file", c.file},
            {"catches", catches}};
}

std::string processor() {
    std::ifstream file("/proc/cpuinfo");
    std::string line;
    while (std::getline(file, line))
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    return "unknown";
}

}  // namespace

ordered_json report_of(const std::vector<Result>& results) {
    ordered_json cases = ordered_json::array();
    const Case* last = nullptr;
    for (const Result& r : results) {
        if (r.of != last) {
            cases.push_back(json_of(*r.of));
            cases.back()["results"] = ordered_json::array();
            last = r.of;
        }
        cases.back()["results"].push_back(json_of(r));
    }
    return cases;
}

ordered_json matrix_of(const std::vector<Cell>& cells) {
    ordered_json faults = ordered_json::array(), list = ordered_json::array();
    for (const FaultText& text : fault_texts)
        faults.push_back({{"name", std::string(text.name)}, {"title", std::string(text.title)}});
    for (const Cell& cell : cells) {
        if (cell.fault == Fault::control) continue;
        list.push_back({{"case", cell.of->text.id},
                        {"dim", cell.dim},
                        {"fault", std::string(text_of(cell.fault).name)},
                        {"claimed", cell.claimed},
                        {"outcome", cell.caught ? "caught" : "survived"},
                        {"by", cell.by}});
    }
    return {{"faults", faults}, {"cells", list}};
}

ordered_json environment() {
    utsname system{};
    uname(&system);
#if defined(__clang__)
    const std::string compiler = std::string("Clang ") + __clang_version__;
#else
    const std::string compiler = std::string("GCC ") + __VERSION__;
#endif
    return {
        {"compiler", compiler},
        {"flags", TALUS_VALIDATION_FLAGS},
        {"cpu", processor()},
        {"cores", std::thread::hardware_concurrency()},
        {"os", std::string(system.sysname) + " " + system.release},
        {"eigen", std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) +
                      "." + std::to_string(EIGEN_MINOR_VERSION)},
        {"gsl", GSL_VERSION}};
}

}  // namespace validation
