// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>

#include <CLI/CLI.hpp>

#include <cstdlib>
#include <string>

/// Adds a numeric option that accepts [low, high] alone and says so when it gets something else.
template <class Number>
CLI::Option* add_number(CLI::App& app, const std::string& name, Number& value, double low,
                        double high, const std::string& help) {
    return app
        .add_option_function<std::string>(
            name,
            [&value, name, low, high](const std::string& text) {
                char* end = nullptr;
                const double x = std::strtod(text.c_str(), &end);
                if (end == text.c_str() || *end != '\0' || !(x >= low && x <= high))
                    throw talus::input_error(
                        name + " is '" + text + "', but must be a number in [" +
                        talus::detail::text_of(low) + ", " + talus::detail::text_of(high) + "]");
                value = x;
            },
            help)
        ->type_name("NUMBER");
}
