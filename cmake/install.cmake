# Installed package: find_package(talus) gives talus::talus; pkg-config knows it as "talus".
# Headers depend on no processor, so the package lives under share/ and can be moved.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS talus EXPORT talusTargets
  FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILE_SET hdf5_headers DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
# Of a processor, unlike the headers: apart, and found where it was built for.
if(TALUS_BUILD_COMPILED)
  install(TARGETS talus_compiled EXPORT talusCompiledTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT talusCompiledTargets NAMESPACE talus:: DESTINATION ${CMAKE_INSTALL_DATADIR}/cmake/talus)
endif()
install(EXPORT talusTargets NAMESPACE talus:: DESTINATION ${CMAKE_INSTALL_DATADIR}/cmake/talus)

file(WRITE ${PROJECT_BINARY_DIR}/talusConfig.cmake
"include(CMakeFindDependencyMacro)
find_dependency(Eigen3 3.4)
include(\${CMAKE_CURRENT_LIST_DIR}/talusTargets.cmake)
include(\${CMAKE_CURRENT_LIST_DIR}/talusCompiledTargets.cmake OPTIONAL)
if(\"compiled\" IN_LIST talus_FIND_COMPONENTS AND talus_FIND_REQUIRED_compiled AND NOT TARGET talus::compiled)
  set(talus_FOUND FALSE)
  set(talus_NOT_FOUND_MESSAGE \"this installation has no compiled library: install with -DTALUS_BUILD_COMPILED=ON\")
endif()
if(\"hdf5\" IN_LIST talus_FIND_COMPONENTS)
  include(\${CMAKE_CURRENT_LIST_DIR}/find_hdf5.cmake)
  if(talus_FIND_REQUIRED_hdf5 AND NOT TARGET talus::hdf5)
    set(talus_FOUND FALSE)
    set(talus_NOT_FOUND_MESSAGE \"the HDF5 C library, which the component hdf5 needs, is missing\")
  endif()
endif()
")
write_basic_package_version_file(${PROJECT_BINARY_DIR}/talusConfigVersion.cmake
  COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
configure_file(${PROJECT_SOURCE_DIR}/cmake/talus.pc.in ${PROJECT_BINARY_DIR}/talus.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/talusConfig.cmake ${PROJECT_BINARY_DIR}/talusConfigVersion.cmake
  ${PROJECT_SOURCE_DIR}/cmake/find_hdf5.cmake
  DESTINATION ${CMAKE_INSTALL_DATADIR}/cmake/talus)
install(FILES ${PROJECT_BINARY_DIR}/talus.pc DESTINATION ${CMAKE_INSTALL_DATADIR}/pkgconfig)
