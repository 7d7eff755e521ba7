// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>

/// Names a template instance that the library talus::compiled holds, below the template and outside
/// of all namespaces: TALUS_IN_PLANE for one of the plane, TALUS_IN_SPACE for one of space. Without
/// that library both say nothing, and the compiler makes what a file uses. With it (its CMake
/// target defines TALUS_COMPILED) they keep the compiler from making it again. In the sources of
/// the library itself (which define TALUS_COMPILE_PLANE or TALUS_COMPILE_SPACE) they make it.
///
/// TALUS_FUNCTION stands where a function that is no template, and too large to be compiled in
/// every file, would say `inline`. Its body, and what that alone includes, is within
/// `#if TALUS_BODIES`: one source of the library (TALUS_COMPILE_FUNCTIONS) has them.
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
#elif defined(TALUS_COMPILE_PLANE) || defined(TALUS_COMPILE_SPACE) || defined(TALUS_COMPILED)
#define TALUS_FUNCTION
#define TALUS_BODIES 0
#else
#define TALUS_FUNCTION inline
#define TALUS_BODIES 1
#endif

namespace talus::detail {

/// Eigen aligns its arrays for the vector instructions that it may use, so a program compiled for
/// others than the library has other layouts. The library defines `tag` for its own alignment
/// alone: the linker then names the one that is missing. (`used`, as no code asks for it: an inline
/// variable that nothing uses is left out, and the question with it.)
template <int Bytes>
struct CompiledWithAlignment {
    static const int tag;
};
#if defined(TALUS_COMPILE_FUNCTIONS)
template <int Bytes>
const int CompiledWithAlignment<Bytes>::tag = Bytes;
template struct CompiledWithAlignment<EIGEN_MAX_STATIC_ALIGN_BYTES>;
#elif defined(TALUS_COMPILED)
[[gnu::used]] inline const int* const same_alignment_as_compiled =
    &CompiledWithAlignment<EIGEN_MAX_STATIC_ALIGN_BYTES>::tag;
#endif

}  // namespace talus::detail
