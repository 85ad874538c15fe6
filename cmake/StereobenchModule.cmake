# What every target of the project is compiled with, and the two shapes of target there are:
# a module (a library made of all sources below one folder) and a module's tests.

add_library(stereobench_options INTERFACE)
target_compile_features(stereobench_options INTERFACE cxx_std_20)
target_include_directories(stereobench_options INTERFACE $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}>)
# Warnings are errors by the compilers that we build with: others warn of what we have not seen. GCC 12 sees overflows in
# what sanitizers make of the library's code.
set(compiler "${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}")
if(compiler MATCHES "^(GNU 12|Clang 14)\\." AND NOT CMAKE_CXX_FLAGS MATCHES "-fsanitize")
  set(warnings_fail -Werror)
endif()
# Warnings are ours alone. What a project that uses an installed module is compiled with, too, stands outside.
set(warnings
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast
  $<$<CXX_COMPILER_ID:GNU>:-Wdouble-promotion>  # clang takes double{x} for an implicit conversion, too
  ${warnings_fail}
  -Wno-missing-field-initializers)  # fields of our aggregates have defaults
target_compile_options(stereobench_options INTERFACE
  "$<BUILD_INTERFACE:${warnings}>"
  -ffp-contract=off)  # results do not depend on whether the machine has fused multiply-add
target_compile_definitions(stereobench_options INTERFACE $<BUILD_INTERFACE:GLM_FORCE_EXPLICIT_CTOR>
  $<INSTALL_INTERFACE:EIGEN_MAX_ALIGN_BYTES=16>)  # that of our libraries, also where the user's compiler has AVX

include(StereobenchInstallModule)

option(STEREOBENCH_TIDY "run clang-tidy on every source" OFF)
if(STEREOBENCH_TIDY)
  find_program(CLANG_TIDY clang-tidy REQUIRED)
  set(CMAKE_CXX_CLANG_TIDY ${CLANG_TIDY} --quiet)
endif()

# Headers that most sources read, parsed once for each target. The preset `dev` goes without: it tells of a
# source that forgets an #include.
set(STEREOBENCH_COMMON_HEADERS <algorithm> <cmath> <filesystem> <functional> <limits> <map> <memory> <optional> <set>
    <span> <sstream> <stdexcept> <string> <vector> <Eigen/Core> <Eigen/Geometry> <Eigen/LU>)

# The compiler reads up to twelve sources of one folder at once, where CMAKE_UNITY_BUILD is on: it then makes templates
# that they share once. Names in anonymous namespaces are therefore unique within a folder.
function(stereobench_unite target sources)
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
  set(count 0)
  set(last_room "")
  foreach(source IN LISTS sources)
    get_filename_component(room ${source} DIRECTORY)
    if(NOT room STREQUAL last_room)
      set(count 0)
      set(last_room ${room})
    endif()
    math(EXPR part "${count} / 12")
    math(EXPR count "${count} + 1")
    file(RELATIVE_PATH group ${CMAKE_SOURCE_DIR} ${room})
    string(REPLACE "/" "_" group ${group})
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group}_${part})
  endforeach()
endfunction()

# stereobench_module(<name> LINKS <libraries...> HEADERS <more headers to parse once...>): the library
# stereobench_<name>.
function(stereobench_module name)
  cmake_parse_arguments(ARG "" "" "LINKS;HEADERS" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "/(main\\.cpp|python/bindings/.*)$")
  add_library(stereobench_${name} STATIC ${sources})
  # Shared libraries may link a module. Hidden names let the compiler inline as it does in a program.
  set_target_properties(stereobench_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden
                                                       VISIBILITY_INLINES_HIDDEN ON)
  target_link_libraries(stereobench_${name} PUBLIC stereobench_options ${ARG_LINKS})
  target_precompile_headers(stereobench_${name} PRIVATE ${STEREOBENCH_COMMON_HEADERS} ${ARG_HEADERS})
  stereobench_unite(stereobench_${name} "${sources}")
  stereobench_install_module(${name})
endfunction()

# stereobench_discover_suites(<executable> <label>): a test of ctest for each suite of GoogleTest in an executable.
function(stereobench_discover_suites tests label)
  set(suites ${CMAKE_CURRENT_BINARY_DIR}/${tests}_suites.cmake)
  add_custom_command(TARGET ${tests} POST_BUILD BYPRODUCTS ${suites} VERBATIM
                     COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:${tests}> -D LABEL=${label} -D OUT=${suites}
                             -P ${CMAKE_SOURCE_DIR}/cmake/discover_suites.cmake)
  file(WRITE ${suites}.if_built "if(EXISTS ${suites})\n  include(${suites})\nelse()\n"
                                "  add_test(${tests}_NOT_BUILT ${tests}_NOT_BUILT)\nendif()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${suites}.if_built)
endfunction()

# stereobench_tests(<module> LABEL <unit|render|e2e> LINKS <libraries...> HEADERS <headers...>): the executable
# <module>_tests from tests/<module>/, and a test of ctest for each of its suites.
function(stereobench_tests module)
  cmake_parse_arguments(ARG "" "LABEL" "LINKS;HEADERS" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${module}/*.cpp)
  add_executable(${module}_tests ${sources})
  target_link_libraries(${module}_tests PRIVATE stereobench_${module} ${ARG_LINKS} GTest::gmock GTest::gtest_main)
  target_compile_definitions(${module}_tests PRIVATE STEREOBENCH_SOURCE_DIR="${CMAKE_SOURCE_DIR}"
                             STEREOBENCH_BINARY_DIR="${CMAKE_BINARY_DIR}")
  target_precompile_headers(${module}_tests PRIVATE ${STEREOBENCH_COMMON_HEADERS} <gmock/gmock.h> <gtest/gtest.h>
                            ${ARG_HEADERS})
  stereobench_unite(${module}_tests "${sources}")
  stereobench_discover_suites(${module}_tests ${ARG_LABEL})
endfunction()
