# Installed package: find_package(talus) gives talus::talus; pkg-config knows it as "talus".
# Headers depend on no processor, so the package lives under share/ and can be moved.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS talus EXPORT talusTargets
  FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILE_SET hdf5_headers DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
# Of a processor, unlike the headers: apart, so that an installation can have the headers alone.
# (What an earlier installation in the same place had of it is removed with it.)
if(NOT TALUS_BUILD_COMPILED)
  install(CODE "file(GLOB old \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}/cmake/talus/talusCompiledTargets*.cmake\")
    if(old)
      file(REMOVE \${old})
    endif()")
else()
  install(TARGETS talus_compiled EXPORT talusCompiledTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT talusCompiledTargets NAMESPACE talus:: DESTINATION ${CMAKE_INSTALL_DATADIR}/cmake/talus)
endif()
install(EXPORT talusTargets NAMESPACE talus:: DESTINATION ${CMAKE_INSTALL_DATADIR}/cmake/talus)

file(WRITE ${PROJECT_BINARY_DIR}/talusConfig.cmake
"include(CMakeFindDependencyMacro)
find_dependency(Eigen3 3.4)
include(\${CMAKE_CURRENT_LIST_DIR}/talusTargets.cmake)
include(\${CMAKE_CURRENT_LIST_DIR}/talusCompiledTargets.cmake OPTIONAL)
if(\"hdf5\" IN_LIST talus_FIND_COMPONENTS)
  include(\${CMAKE_CURRENT_LIST_DIR}/find_hdf5.cmake)
endif()
set(talus_missing_compiled \"this installation has no compiled library: install with -DTALUS_BUILD_COMPILED=ON\")
set(talus_missing_hdf5 \"the HDF5 C library, which the component hdf5 needs, is missing\")
foreach(component IN LISTS talus_FIND_COMPONENTS)
  if(TARGET talus::\${component})
    set(talus_\${component}_FOUND TRUE)
  elseif(talus_FIND_REQUIRED_\${component})
    set(talus_FOUND FALSE)
    set(talus_NOT_FOUND_MESSAGE \"\${talus_missing_\${component}}\")
    if(NOT talus_NOT_FOUND_MESSAGE)
      set(talus_NOT_FOUND_MESSAGE \"there is no component '\${component}': there are compiled and hdf5\")
    endif()
  endif()
endforeach()
")
write_basic_package_version_file(${PROJECT_BINARY_DIR}/talusConfigVersion.cmake
  COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
configure_file(${PROJECT_SOURCE_DIR}/cmake/talus.pc.in ${PROJECT_BINARY_DIR}/talus.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/talusConfig.cmake ${PROJECT_BINARY_DIR}/talusConfigVersion.cmake
  ${PROJECT_SOURCE_DIR}/cmake/find_hdf5.cmake
  DESTINATION ${CMAKE_INSTALL_DATADIR}/cmake/talus)
install(FILES ${PROJECT_BINARY_DIR}/talus.pc DESTINATION ${CMAKE_INSTALL_DATADIR}/pkgconfig)
