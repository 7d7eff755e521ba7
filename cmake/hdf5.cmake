# Headers that need the HDF5 C library, and the target that brings it to them where it is found.
set(talus_hdf5_headers hdf5_handle hdf5_reader hdf5_writer problem_file read_problem step_dump write_problem)
list(TRANSFORM talus_hdf5_headers PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/include/talus/io/)
list(TRANSFORM talus_hdf5_headers APPEND .hpp)

if(TALUS_HDF5)
  include(cmake/find_hdf5.cmake)
endif()
if(NOT TARGET talus::hdf5 AND (TALUS_BUILD_TESTS OR TALUS_BUILD_EXAMPLES))
  message(FATAL_ERROR "talus: tests and examples need HDF5 (libhdf5-dev) and -DTALUS_HDF5=ON")
endif()
