# talus::compiled = talus with its common templates compiled once: the same headers, in which the
# macro TALUS_COMPILED says that a library holds these instances (core/instantiate.hpp). Built when
# something links it; an installation has it if TALUS_BUILD_COMPILED is ON.
option(TALUS_BUILD_COMPILED "Build and install talus::compiled, the common templates compiled once" OFF)

# talus_compiled_source(HEADER PART): a source with what a header has for plane, space or functions.
set(talus_compiled_sources)
function(talus_compiled_source header part)
  get_filename_component(name ${header} NAME)
  set(source ${PROJECT_BINARY_DIR}/compiled/${name}_${part}.cpp)
  string(TOUPPER ${part} macro)
  file(CONFIGURE OUTPUT ${source} CONTENT
"// SPDX-License-Identifier: BSL-1.0
#define TALUS_COMPILE_${macro}
#include <talus/${header}.hpp>
")
  set(talus_compiled_sources ${talus_compiled_sources} ${source} PARENT_SCOPE)
endfunction()
# The longest first.
foreach(part IN ITEMS space plane functions)
  talus_compiled_source(solver/solver_registry ${part})
endforeach()
foreach(part IN ITEMS space plane)
  talus_compiled_source(stepping/simulation ${part})
endforeach()
talus_compiled_source(problem/matrix_problem functions)

add_library(talus_compiled STATIC ${talus_compiled_sources})
add_library(talus::compiled ALIAS talus_compiled)
target_link_libraries(talus_compiled PUBLIC talus)
target_compile_definitions(talus_compiled INTERFACE TALUS_COMPILED)
set_target_properties(talus_compiled PROPERTIES
  EXPORT_NAME compiled POSITION_INDEPENDENT_CODE ON CXX_EXTENSIONS OFF DEBUG_POSTFIX _d)
if(NOT TALUS_BUILD_COMPILED)
  set_target_properties(talus_compiled PROPERTIES EXCLUDE_FROM_ALL ON)
endif()
