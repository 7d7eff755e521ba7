// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/version.hpp>

/// Names a template instance that the library talus::compiled holds, below the template and outside
/// of all namespaces: TALUS_IN_PLANE for one of the plane, TALUS_IN_SPACE for one of space. Without
/// that library both say nothing, and the compiler makes what a file uses. With it (its CMake
/// target defines TALUS_COMPILED) they keep the compiler from making it again. In the sources of
/// the library itself (which define TALUS_COMPILE_PLANE or TALUS_COMPILE_SPACE) they make it.
///
/// TALUS_FUNCTION stands where a function that is no template, and too large to be compiled in
/// every file, would say `inline`. Its body, and what that alone includes, is within
/// `#if TALUS_BODIES`: one source of the library (TALUS_COMPILE_FUNCTIONS) has them. Functions that
/// few programs call are templates nevertheless, since the compiler works through what is `inline`
/// whether it is called or not; TALUS_IN_LIBRARY then names the instance that the library holds.
#if defined(TALUS_COMPILE_PLANE)
#define TALUS_IN_PLANE(...) template __VA_ARGS__;
#define TALUS_IN_SPACE(...)
#elif defined(TALUS_COMPILE_SPACE)
#define TALUS_IN_PLANE(...)
#define TALUS_IN_SPACE(...) template __VA_ARGS__;
#elif defined(TALUS_COMPILE_FUNCTIONS) || defined(TALUS_COMPILED)
#define TALUS_IN_PLANE(...) extern template __VA_ARGS__;
#define TALUS_IN_SPACE(...) extern template __VA_ARGS__;
#else
#define TALUS_IN_PLANE(...)
#define TALUS_IN_SPACE(...)
#endif
#if defined(TALUS_COMPILE_FUNCTIONS)
#define TALUS_FUNCTION
#define TALUS_BODIES 1
#define TALUS_IN_LIBRARY(...) template __VA_ARGS__;
#elif defined(TALUS_COMPILE_PLANE) || defined(TALUS_COMPILE_SPACE) || defined(TALUS_COMPILED)
#define TALUS_FUNCTION
#define TALUS_BODIES 0
#define TALUS_IN_LIBRARY(...)
#else
#define TALUS_FUNCTION inline
#define TALUS_BODIES 1
#define TALUS_IN_LIBRARY(...)
#endif

namespace talus::detail {

/// How Eigen aligns memory, by its own rule [bytes]: it follows the vector instructions that a file
/// is compiled for and Eigen's settings. Known without Eigen, and the same whether a file includes
/// it before or after.
#if defined(EIGEN_DONT_ALIGN)
inline constexpr int eigen_alignment = 0;
#elif defined(EIGEN_MAX_ALIGN_BYTES)
inline constexpr int eigen_alignment = EIGEN_MAX_ALIGN_BYTES;
#elif defined(EIGEN_DONT_VECTORIZE)
inline constexpr int eigen_alignment = 0;
#elif defined(__AVX512F__)
inline constexpr int eigen_alignment = 64;
#elif defined(__AVX__)
inline constexpr int eigen_alignment = 32;
#else
inline constexpr int eigen_alignment = 16;
#endif
/// How it aligns its arrays.
#if defined(EIGEN_DONT_ALIGN) || defined(EIGEN_DONT_ALIGN_STATICALLY)
inline constexpr int eigen_array_alignment = 0;
#elif defined(EIGEN_MAX_STATIC_ALIGN_BYTES)
inline constexpr int eigen_array_alignment =
    EIGEN_MAX_STATIC_ALIGN_BYTES < eigen_alignment ? EIGEN_MAX_STATIC_ALIGN_BYTES : eigen_alignment;
#elif defined(__i386__) || defined(__x86_64__) || defined(__arm__) || defined(__aarch64__) || \
    defined(__powerpc__) || defined(__mips__)
inline constexpr int eigen_array_alignment = eigen_alignment;
#else
inline constexpr int eigen_array_alignment = 0;
#endif

/// What makes layouts and memory differ between files that include the same headers: the version,
/// the alignment of Eigen's arrays and of its memory, and the debug mode of the standard library.
/// The library defines `tag` for its own alone: the linker then names what another file was
/// compiled for. (`used` and `retain`, as no code asks for it: compiler and linker leave out what
/// nothing uses, and the question with it.)
template <int Version, int ArrayAlignment, int MemoryAlignment, bool DebugStandardLibrary>
struct CompiledFor {
    static const int tag;
};
#ifdef _GLIBCXX_DEBUG
inline constexpr bool debug_standard_library = true;
#else
inline constexpr bool debug_standard_library = false;
#endif
using CompiledForThis =
    CompiledFor<10000 * TALUS_VERSION_MAJOR + 100 * TALUS_VERSION_MINOR + TALUS_VERSION_PATCH,
                eigen_array_alignment, eigen_alignment, debug_standard_library>;
#if defined(TALUS_COMPILE_FUNCTIONS)
template <>
const int CompiledForThis::tag = 1;
#elif defined(TALUS_COMPILED)
[[gnu::used, gnu::retain]] inline const int* const compiled_for_this = &CompiledForThis::tag;
#endif

}  // namespace talus::detail
