# Flags of talus' own tests, examples and benches: never of the INTERFACE target.
add_library(talus_strict INTERFACE)
target_link_libraries(talus_strict INTERFACE talus::talus)
target_compile_options(talus_strict INTERFACE -Wall -Wextra -Wpedantic -Wconversion)
if(TALUS_NATIVE)
  target_compile_options(talus_strict INTERFACE -march=native)
endif()
