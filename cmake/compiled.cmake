# talus::compiled = talus with its common templates compiled once: the same headers, in which the
# macro TALUS_COMPILED says that a library holds these instances (core/instantiate.hpp). Built when
# something links it; an installation has it if TALUS_BUILD_COMPILED is ON.
option(TALUS_BUILD_COMPILED "Build and install talus::compiled, the common templates compiled once" OFF)

# talus_compiled_source(PART HEADER...): a source with what these headers have for plane, space or
# functions.
set(talus_compiled_sources)
function(talus_compiled_source part)
  list(GET ARGN 0 first)
  get_filename_component(name ${first} NAME)
  set(source ${PROJECT_BINARY_DIR}/compiled/${name}_${part}.cpp)
  string(TOUPPER ${part} macro)
  set(content "// SPDX-License-Identifier: BSL-1.0\n#define TALUS_COMPILE_${macro}\n")
  foreach(header IN LISTS ARGN)
    string(APPEND content "#include <talus/${header}.hpp>\n")
  endforeach()
  file(CONFIGURE OUTPUT ${source} CONTENT "${content}")
  set(talus_compiled_sources ${talus_compiled_sources} ${source} PARENT_SCOPE)
endfunction()
# The longest first. All functions are in one source: it also says what the library is compiled for.
talus_compiled_source(space solver/solver_registry)
talus_compiled_source(plane solver/solver_registry)
talus_compiled_source(functions
  solver/solver_registry problem/matrix_problem geometry/convex_polytope)
talus_compiled_source(space stepping/simulation stepping/equilibrium)
talus_compiled_source(plane stepping/simulation stepping/equilibrium)

add_library(talus_compiled STATIC ${talus_compiled_sources})
add_library(talus::compiled ALIAS talus_compiled)
target_link_libraries(talus_compiled PUBLIC talus)
target_compile_definitions(talus_compiled INTERFACE TALUS_COMPILED)
set_target_properties(talus_compiled PROPERTIES
  EXPORT_NAME compiled POSITION_INDEPENDENT_CODE ON CXX_EXTENSIONS OFF DEBUG_POSTFIX _d)
if(NOT TALUS_BUILD_COMPILED)
  set_target_properties(talus_compiled PROPERTIES EXCLUDE_FROM_ALL ON)
endif()
