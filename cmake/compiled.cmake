# talus::compiled = talus with its common templates compiled once: the same headers, in which the
# macro TALUS_COMPILED says that a library holds these instances (core/instantiate.hpp).
option(TALUS_BUILD_COMPILED "Build talus::compiled, the common templates compiled once" ${PROJECT_IS_TOP_LEVEL})
if(TALUS_BUILD_COMPILED)
  foreach(dimension IN ITEMS PLANE SPACE)
    string(TOLOWER ${dimension} name)
    file(GENERATE OUTPUT ${PROJECT_BINARY_DIR}/compiled_${name}.cpp CONTENT
"// SPDX-License-Identifier: BSL-1.0
#define TALUS_COMPILE_${dimension}
#include <talus/solver/automatic.hpp>
#include <talus/stepping/simulation.hpp>
")
  endforeach()
  add_library(talus_compiled STATIC EXCLUDE_FROM_ALL
    ${PROJECT_BINARY_DIR}/compiled_plane.cpp ${PROJECT_BINARY_DIR}/compiled_space.cpp)
  add_library(talus::compiled ALIAS talus_compiled)
  target_link_libraries(talus_compiled PUBLIC talus)
  target_compile_definitions(talus_compiled INTERFACE TALUS_COMPILED)
  set_target_properties(talus_compiled PROPERTIES
    EXPORT_NAME compiled POSITION_INDEPENDENT_CODE ON)
endif()
