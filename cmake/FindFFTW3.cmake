# Finds FFTW 3 and defines the targets FFTW3::double (libfftw3) and FFTW3::single (libfftw3f).
#
# pkg-config, where it is there, tells where to look; without it the usual folders and CMAKE_PREFIX_PATH are searched.
find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_check_modules(PC_FFTW3 QUIET fftw3)
  pkg_check_modules(PC_FFTW3F QUIET fftw3f)
endif()

find_path(FFTW3_INCLUDE_DIR fftw3.h HINTS ${PC_FFTW3_INCLUDE_DIRS})
find_library(FFTW3_DOUBLE_LIBRARY fftw3 HINTS ${PC_FFTW3_LIBRARY_DIRS})
find_library(FFTW3_SINGLE_LIBRARY fftw3f HINTS ${PC_FFTW3F_LIBRARY_DIRS})
set(FFTW3_VERSION ${PC_FFTW3_VERSION})
mark_as_advanced(FFTW3_INCLUDE_DIR FFTW3_DOUBLE_LIBRARY FFTW3_SINGLE_LIBRARY)

include(FindPackageHandleStandardArgs)
# Without pkg-config the version is not known: fftw3.h does not tell it.
if(FFTW3_VERSION)
  find_package_handle_standard_args(
    FFTW3
    REQUIRED_VARS FFTW3_DOUBLE_LIBRARY FFTW3_SINGLE_LIBRARY FFTW3_INCLUDE_DIR
    VERSION_VAR FFTW3_VERSION)
else()
  find_package_handle_standard_args(FFTW3 REQUIRED_VARS FFTW3_DOUBLE_LIBRARY FFTW3_SINGLE_LIBRARY FFTW3_INCLUDE_DIR)
endif()

if(FFTW3_FOUND)
  foreach(precision double single)
    if(NOT TARGET FFTW3::${precision})
      string(TOUPPER ${precision} upper)
      add_library(FFTW3::${precision} UNKNOWN IMPORTED)
      set_target_properties(FFTW3::${precision} PROPERTIES IMPORTED_LOCATION "${FFTW3_${upper}_LIBRARY}"
                                                           INTERFACE_INCLUDE_DIRECTORIES "${FFTW3_INCLUDE_DIR}")
    endif()
  endforeach()
endif()
