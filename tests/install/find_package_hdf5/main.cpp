// SPDX-License-Identifier: BSL-1.0
#include <talus/io/problem_file.hpp>

#include <string>

/// Succeeds when a file that is not there is refused in words.
int main() {
    try {
        talus::problem_dimension("nowhere.hdf5");
    } catch (const talus::input_error& error) {
        return std::string(error.what()).find("nowhere.hdf5") == 0 ? 0 : 1;
    }
    return 1;
}
