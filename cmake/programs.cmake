# How the programs of this repository (tests, examples, benchmarks) are compiled; nothing here reaches users.

set(CMAKE_CXX_EXTENSIONS OFF)

add_library(cambium_warnings INTERFACE)
target_compile_options(cambium_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
                                                  $<$<BOOL:${CAMBIUM_WERROR}>:-Werror>)

add_library(cambium_program INTERFACE)
target_link_libraries(cambium_program INTERFACE cambium::cambium cambium_warnings)
target_compile_options(cambium_program INTERFACE $<$<BOOL:${CAMBIUM_NATIVE}>:-march=native>)

# cambium_development_package(found what package): stops with one clear message if something was not found.
function(cambium_development_package found what package)
  if(NOT ${found})
    message(FATAL_ERROR "${what} was not found. On Debian: apt-get install ${package} (scripts/install_dependencies "
                        "installs everything that tests, examples and benchmarks need)")
  endif()
endfunction()

# Lines of `#include` of the library's headers, each as a user writes it.
file(
  GLOB_RECURSE CAMBIUM_HEADERS CONFIGURE_DEPENDS
  RELATIVE ${PROJECT_SOURCE_DIR}/include
  ${PROJECT_SOURCE_DIR}/include/cambium/*.hpp)
