# talus::compiled = talus with its common templates compiled once: the same headers, in which the
# macro TALUS_COMPILED says that a library holds these instances (core/instantiate.hpp). Built when
# something links it; an installation has it if TALUS_BUILD_COMPILED is ON.
option(TALUS_BUILD_COMPILED "Build and install talus::compiled, the common templates compiled once" OFF)

set(talus_compiled_sources)
foreach(dimension IN ITEMS plane space)
  string(TOUPPER ${dimension} macro)
  foreach(part IN ITEMS stepping/simulation solver/solver_registry)
    get_filename_component(name ${part} NAME)
    set(source ${PROJECT_BINARY_DIR}/compiled/${name}_${dimension}.cpp)
    file(CONFIGURE OUTPUT ${source} CONTENT
"// SPDX-License-Identifier: BSL-1.0
#define TALUS_COMPILE_${macro}
#include <talus/${part}.hpp>
")
    list(APPEND talus_compiled_sources ${source})
  endforeach()
endforeach()

add_library(talus_compiled STATIC ${talus_compiled_sources})
add_library(talus::compiled ALIAS talus_compiled)
target_link_libraries(talus_compiled PUBLIC talus)
target_compile_definitions(talus_compiled INTERFACE TALUS_COMPILED)
set_target_properties(talus_compiled PROPERTIES EXPORT_NAME compiled POSITION_INDEPENDENT_CODE ON)
if(NOT TALUS_BUILD_COMPILED)
  set_target_properties(talus_compiled PROPERTIES EXCLUDE_FROM_ALL ON)
endif()
