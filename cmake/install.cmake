# Headers, and a package that find_package(cambium) finds wherever the prefix is moved to.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_DATADIR}/cmake/cambium)

install(DIRECTORY include/cambium DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp")
install(TARGETS cambium EXPORT cambium INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT cambium NAMESPACE cambium:: FILE cambiumTargets.cmake DESTINATION ${package_dir})

configure_package_config_file(cmake/cambiumConfig.cmake.in ${PROJECT_BINARY_DIR}/cambiumConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/cambiumConfigVersion.cmake COMPATIBILITY SameMinorVersion
                                 ARCH_INDEPENDENT)
install(FILES ${PROJECT_BINARY_DIR}/cambiumConfig.cmake ${PROJECT_BINARY_DIR}/cambiumConfigVersion.cmake
              cmake/dependencies.cmake cmake/FindFFTW3.cmake DESTINATION ${package_dir})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

# For builds without CMake: g++ -std=c++20 program.cpp $(pkg-config --cflags --libs cambium)
set(pkgconfig_openmp "")
if(CAMBIUM_OPENMP)
  set(pkgconfig_openmp ${OpenMP_CXX_FLAGS})
endif()
configure_file(cmake/cambium.pc.in ${PROJECT_BINARY_DIR}/cambium.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/cambium.pc DESTINATION ${CMAKE_INSTALL_DATADIR}/pkgconfig)
