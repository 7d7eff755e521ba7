# Headers that need the HDF5 C library, and the target that brings it to them where it is found.
set(talus_hdf5_headers hdf5_handle hdf5_reader hdf5_writer problem_file read_problem step_dump write_problem)
list(TRANSFORM talus_hdf5_headers PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/include/talus/io/)
list(TRANSFORM talus_hdf5_headers APPEND .hpp)

if(TALUS_HDF5)
  include(cmake/find_hdf5.cmake)
endif()
if(TARGET talus::hdf5)
  # The same headers once more, to be compiled each alone with HDF5 at hand.
  add_library(talus_hdf5_headers INTERFACE)
  target_sources(talus_hdf5_headers INTERFACE FILE_SET HEADERS BASE_DIRS include FILES ${talus_hdf5_headers})
  target_link_libraries(talus_hdf5_headers INTERFACE talus::hdf5)
  set_target_properties(talus_hdf5_headers PROPERTIES VERIFY_INTERFACE_HEADER_SETS ${PROJECT_IS_TOP_LEVEL})
elseif(TALUS_BUILD_TESTS OR TALUS_BUILD_EXAMPLES)
  message(FATAL_ERROR "talus: tests and examples need HDF5 (libhdf5-dev) and -DTALUS_HDF5=ON")
endif()
