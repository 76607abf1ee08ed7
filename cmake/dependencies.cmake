# Finds what the library needs. Used by the build and, installed beside the package configuration, by its users.
#
# In:  CAMBIUM_OPENMP, CAMBIUM_MODULES (folder of FindFFTW3.cmake)
# Out: CAMBIUM_DEPENDENCIES (targets), CAMBIUM_MISSING (a message, empty if everything was found)
set(CAMBIUM_DEPENDENCIES Eigen3::Eigen cambium::xsimd FFTW3::double FFTW3::single)
set(CAMBIUM_MISSING "")

macro(cambium_require found what package)
  if(NOT ${found})
    string(APPEND CAMBIUM_MISSING "Cambium needs ${what}, which was not found. On Debian: apt-get install ${package}\n")
  endif()
endmacro()

find_package(Eigen3 3.4 QUIET NO_MODULE)
cambium_require(Eigen3_FOUND "Eigen 3.4" libeigen3-dev)

# xsimd before version 9 asks to be linked with xtl, which it uses for xtl's own complex numbers alone: its headers are
# all that is taken.
find_package(xsimd QUIET CONFIG)
if(xsimd_FOUND AND xsimd_VERSION VERSION_LESS 8.1)
  set(xsimd_FOUND FALSE)
endif()
cambium_require(xsimd_FOUND "xsimd 8.1 or later" libxsimd-dev)
if(TARGET xsimd AND NOT TARGET cambium::xsimd)
  get_target_property(cambium_xsimd_headers xsimd INTERFACE_INCLUDE_DIRECTORIES)
  add_library(cambium::xsimd INTERFACE IMPORTED GLOBAL)
  target_include_directories(cambium::xsimd INTERFACE ${cambium_xsimd_headers})
endif()

list(PREPEND CMAKE_MODULE_PATH ${CAMBIUM_MODULES})
find_package(FFTW3 3.3 QUIET MODULE)
list(POP_FRONT CMAKE_MODULE_PATH)
cambium_require(FFTW3_FOUND "FFTW 3.3 in double and single precision" libfftw3-dev)

if(CAMBIUM_OPENMP)
  find_package(OpenMP QUIET COMPONENTS CXX)
  cambium_require(OpenMP_CXX_FOUND "OpenMP of the C++ compiler (or -DCAMBIUM_OPENMP=OFF to run on one thread)"
                  "g++, or libomp-dev for clang++")
  list(APPEND CAMBIUM_DEPENDENCIES OpenMP::OpenMP_CXX)
endif()
