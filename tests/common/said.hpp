// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/check.hpp>

#include <string>

/// What the refusal of `act` says; nothing if it is not refused.
template <class Act>
std::string said(const Act& act) {
    try {
        act();
    } catch (const talus::input_error& error) {
        return error.what();
    }
    return {};
}
