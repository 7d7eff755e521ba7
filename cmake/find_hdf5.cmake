# talus::hdf5 = talus and the HDF5 C library, if there is one. Also installed, for
# find_package(talus COMPONENTS hdf5).
include(CheckLanguage)
check_language(C)
if(CMAKE_C_COMPILER)
  enable_language(C)  # CMake tries the library out in C
  set(CMAKE_FIND_PACKAGE_TARGETS_GLOBAL TRUE)
  find_package(HDF5 QUIET COMPONENTS C)
  unset(CMAKE_FIND_PACKAGE_TARGETS_GLOBAL)
endif()
if(HDF5_FOUND AND NOT TARGET talus::hdf5)
  add_library(talus::hdf5 INTERFACE IMPORTED GLOBAL)
  target_link_libraries(talus::hdf5 INTERFACE talus::talus HDF5::HDF5)
endif()
