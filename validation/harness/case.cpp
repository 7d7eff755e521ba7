// SPDX-License-Identifier: BSL-1.0
#include "case.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace validation {

namespace {

std::vector<Case>& registry() {
    static std::vector<Case> cases;
    return cases;
}

void require_complete(const Case& c) {
    const CaseText& t = c.text;
    const auto require = [&](bool good, const char* what) {
        if (!good) throw std::logic_error("case " + t.id + " (" + t.name + "): " + what);
    };
    require(t.id.size() == 3 && t.id[0] >= 'A' && t.id[0] <= 'Z',
            "its id is no letter and two digits");
    require(t.gate >= 1 && t.gate <= 3, "its gate is not 1, 2 or 3");
    require(c.plane || c.space, "it has no dimension");
    require(!t.name.empty() && !t.title.empty() && !t.setup.empty() && !t.reference.empty() &&
                !t.compared.empty() && !t.why.empty() && !t.source.empty(),
            "a text is missing");
    require(!t.catches.empty(), "it names no fault that it catches");
}

}  // namespace

const std::vector<Case>& all_cases() {
    static const std::vector<Case> sorted = [] {
        std::vector<Case> cases = registry();
        std::sort(cases.begin(), cases.end(),
                  [](const Case& a, const Case& b) { return a.text.id < b.text.id; });
        for (const Case& c : cases) require_complete(c);
        for (std::size_t i = 1; i < cases.size(); ++i)
            if (cases[i].text.id == cases[i - 1].text.id)
                throw std::logic_error("two cases are called " + cases[i].text.id);
        return cases;
    }();
    return sorted;
}

Register::Register(CaseText text, std::function<void(Trial<2>&)> plane,
                   std::function<void(Trial<3>&)> space, const char* file) {
    namespace fs = std::filesystem;
    const fs::path relative = fs::path(file).lexically_relative(TALUS_SOURCE_DIR);
    registry().push_back({std::move(text), std::move(plane), std::move(space),
                          relative.generic_string(),
                          relative.parent_path().filename().generic_string()});
}

}  // namespace validation
