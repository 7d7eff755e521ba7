# Installed package: find_package(talus) gives talus::talus; pkg-config knows it as "talus".
# Headers depend on no processor, so the package lives under share/ and can be moved.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS talus EXPORT talusTargets FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT talusTargets NAMESPACE talus:: DESTINATION ${CMAKE_INSTALL_DATADIR}/cmake/talus)

file(WRITE ${PROJECT_BINARY_DIR}/talusConfig.cmake
"include(CMakeFindDependencyMacro)
find_dependency(Eigen3 3.4)
include(\${CMAKE_CURRENT_LIST_DIR}/talusTargets.cmake)
")
write_basic_package_version_file(${PROJECT_BINARY_DIR}/talusConfigVersion.cmake
  COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
configure_file(${PROJECT_SOURCE_DIR}/cmake/talus.pc.in ${PROJECT_BINARY_DIR}/talus.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/talusConfig.cmake ${PROJECT_BINARY_DIR}/talusConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_DATADIR}/cmake/talus)
install(FILES ${PROJECT_BINARY_DIR}/talus.pc DESTINATION ${CMAKE_INSTALL_DATADIR}/pkgconfig)
