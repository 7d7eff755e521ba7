// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "trial.hpp"

namespace validation {

/// What a reader of the report is told about a case.
struct CaseText {
    std::string id;     ///< of the catalogue: a letter and two digits
    std::string name;   ///< lower case with hyphens
    std::string title;  ///< a few words
    int gate = 2;       ///< 1: seconds, every commit; 2: minutes; 3: hours
    std::string setup;  ///< the situation in words
    /// Formulas, one per line: x_1, x_{ab}, x^2, √{..}, frac{a}{b}; words stay words.
    std::vector<std::string> reference;
    std::string compared;  ///< what is compared with the reference
    Class kind = Class::R;
    std::string why;             ///< why this class and these bounds
    std::string source;          ///< of the reference
    std::vector<Fault> catches;  ///< faults that this case must notice, at least one
    /// Why it is one of the midpoint scheme alone; empty: it holds in either (validation/run
    /// --scheme).
    std::string midpoint_because = {};
};

/// A case with the functions that try it; one of them may be missing.
struct Case {
    CaseText text;
    std::function<void(Trial<2>&)> plane;
    std::function<void(Trial<3>&)> space;
    std::string file;    ///< from the root of the repository
    std::string family;  ///< its folder

    std::string section() const { return text.id.substr(0, 1); }
    std::vector<int> dims() const {
        std::vector<int> result;
        if (plane) result.push_back(2);
        if (space) result.push_back(3);
        return result;
    }
};

/// All cases of the program, by id. Throws std::logic_error where two have the same id.
const std::vector<Case>& all_cases();

/// Registers a case when the program starts:
///
///     template <int Dim> void incline(Trial<Dim>& trial) { ... }
///     const Register a01({.id = "A01", ...}, incline<2>, incline<3>, __FILE__);
///
/// nullptr stands for a dimension in which the case does not exist.
class Register {
  public:
    Register(CaseText text, std::function<void(Trial<2>&)> plane,
             std::function<void(Trial<3>&)> space, const char* file);
};

}  // namespace validation
