// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/printable.hpp>

#include <stdexcept>
#include <string>

namespace talus {

/// Broken precondition: an error of the calling program. Thrown by TALUS_CHECK.
class precondition_error : public std::logic_error {
  public:
    using std::logic_error::logic_error;
};

/// Bad input from outside (a file, a mesh, a negative mass). The message names the item, its value
/// and the accepted range, on one line: control characters of the input are shown as \n, \x1b.
/// Thrown before any state changes.
class input_error : public std::invalid_argument {
  public:
    [[gnu::cold]] explicit input_error(const std::string& message)
        : std::invalid_argument(detail::printable(message)) {}
};

namespace detail {

[[noreturn, gnu::cold]] inline void fail_check(const char* expression, const char* sentence,
                                               const char* file, int line) {
    char digits[12] = {};
    char* number = digits + sizeof digits - 1;
    for (; line > 0; line /= 10) *--number = static_cast<char>('0' + line % 10);
    std::string text(file);
    text.append(":").append(number).append(": ").append(sentence);
    throw precondition_error(text.append(" [").append(expression).append("]"));
}

}  // namespace detail
}  // namespace talus

/// Precondition, checked in builds without NDEBUG: throws talus::precondition_error with the
/// expression, the sentence and the location.
#ifdef NDEBUG
#define TALUS_CHECK(condition, sentence) static_cast<void>(0)
#else
#define TALUS_CHECK(condition, sentence) \
    ((condition) ? static_cast<void>(0)  \
                 : ::talus::detail::fail_check(#condition, sentence, __FILE__, __LINE__))
#endif
