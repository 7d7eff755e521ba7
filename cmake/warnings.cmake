# Flags of talus' own tests, examples and benches: never of the INTERFACE target.
add_library(talus_strict INTERFACE)
target_link_libraries(talus_strict INTERFACE talus::talus)
target_compile_options(talus_strict INTERFACE -Wall -Wextra -Wpedantic -Wconversion)
# GCC 12 sees overlaps in std::string that are none (its bug 105651).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(talus_strict INTERFACE -Wno-restrict)
endif()
if(TALUS_NATIVE)
  target_compile_options(talus_strict INTERFACE -march=native)
endif()
