# `cpack` in the folder of the build makes libcambium-dev_VERSION_all.deb: the headers, and what they need declared.

# What is installed are files of the source: programs need not be built for it.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY TRUE)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME libcambium-dev)
set(CPACK_PACKAGE_CONTACT "The Cambium authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "remeshed particle methods in C++20 (headers)")
set(CPACK_PACKAGE_DESCRIPTION
    "Particles carry what moves, lattices carry what is smooth, kernels of proven order take values from one to the
other and back. Interfaces as level sets, Poisson solvers, kinetics and species on surfaces, growth of tumours.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES FALSE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libeigen3-dev (>= 3.4), libxsimd-dev (>= 8.1), libfftw3-dev (>= 3.3)")
if(CAMBIUM_OPENMP)  # the package asks for it; g++ brings its own
  string(APPEND CPACK_DEBIAN_PACKAGE_DEPENDS ", g++ (>= 4:12) | libomp-dev (>= 1:14)")
endif()
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "cmake (>= 3.25), pkg-config")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION TRUE)
include(CPack)
