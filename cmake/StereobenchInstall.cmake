# What is installed beside the modules: the program with what a user of it runs (component `program`), what
# find_package(stereobench) reads (`dev`), and the package for Python (`python`). A component is a Debian package, too.
include(CMakePackageConfigHelpers)

# Where the system's Python and zsh look below /usr.
if(EXISTS /etc/debian_version)
  set(python_folder lib/python3/dist-packages)
  set(zsh_folder vendor-completions)
else()
  get_property(minor GLOBAL PROPERTY STEREOBENCH_PYTHON_MINOR)
  string(REGEX REPLACE "\\.$" "" version "3.${minor}")
  set(python_folder ${CMAKE_INSTALL_LIBDIR}/python${version}/site-packages)
  set(zsh_folder site-functions)
endif()
set(STEREOBENCH_PYTHON_DIR ${python_folder} CACHE STRING "folder of Python's modules")
set(STEREOBENCH_ZSH_DIR ${CMAKE_INSTALL_DATADIR}/zsh/${zsh_folder} CACHE STRING "folder of zsh's completions")
set(packaging ${CMAKE_SOURCE_DIR}/packaging)
set(made ${CMAKE_BINARY_DIR}/packaging)
set(executable PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

# The changelog of the packages says the date of what is packaged, and their version.
file(STRINGS ${packaging}/changelog changelog_lines)
string(REGEX MATCH "stereobench \\(([0-9.]+)-([0-9]+)\\)" first "${changelog_lines}")
set(STEREOBENCH_REVISION ${CMAKE_MATCH_2})
if(NOT CMAKE_MATCH_1 VERSION_EQUAL PROJECT_VERSION)
  message(FATAL_ERROR "packaging/changelog: expected version ${PROJECT_VERSION}, got '${CMAKE_MATCH_1}'")
endif()
string(REGEX MATCH " -- [^>]*>  ([^;]*)" last "${changelog_lines}")
execute_process(COMMAND date --utc --date ${CMAKE_MATCH_1} +%s OUTPUT_VARIABLE STEREOBENCH_EPOCH
                OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)

# For find_package().
configure_file(${CMAKE_SOURCE_DIR}/cmake/stereobench-config.cmake.in ${made}/stereobench-config.cmake @ONLY)
write_basic_package_version_file(${made}/stereobench-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${made}/stereobench-config.cmake ${made}/stereobench-config-version.cmake
              ${CMAKE_SOURCE_DIR}/cmake/needs.cmake
        DESTINATION ${STEREOBENCH_CMAKE_DIR} COMPONENT dev)

# The program.
install(TARGETS stereobench RUNTIME COMPONENT program)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/assets/ DESTINATION ${CMAKE_INSTALL_DATADIR}/stereobench COMPONENT program
        PATTERN __pycache__ EXCLUDE
        PATTERN "detectors/*.py" ${executable})
install(FILES ${packaging}/stereobench.bash RENAME stereobench
        DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
install(FILES ${packaging}/_stereobench DESTINATION ${STEREOBENCH_ZSH_DIR} COMPONENT program)

# The package for Python: its loaders, and the compiled part where it is built.
install(DIRECTORY ${CMAKE_SOURCE_DIR}/harness/python/stereobench DESTINATION ${STEREOBENCH_PYTHON_DIR} COMPONENT python
        PATTERN __pycache__ EXCLUDE)
get_target_property(python_part stereobench_python TYPE)
if(python_part STREQUAL MODULE_LIBRARY)
  install(TARGETS stereobench_python LIBRARY DESTINATION ${STEREOBENCH_PYTHON_DIR}/stereobench COMPONENT python)
endif()

# Man pages, of the help of the program that is installed. They are made when that is.
find_program(HELP2MAN help2man)
mark_as_advanced(HELP2MAN)
if(HELP2MAN)
  install(CODE "set(man_program \"$<TARGET_FILE:stereobench>\")
    set(man_help2man \"${HELP2MAN}\")
    set(man_summary \"${PROJECT_DESCRIPTION}\")
    set(man_folder \"${made}/man\")
    set(man_epoch \"${STEREOBENCH_EPOCH}\")
    set(man_destination \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_MANDIR}/man1\")" COMPONENT program)
  install(SCRIPT ${CMAKE_SOURCE_DIR}/cmake/man_pages.cmake COMPONENT program)
else()
  message(STATUS "man pages are left out: help2man is missing (apt-get install help2man)")
endif()

set(documents ${CMAKE_INSTALL_DATADIR}/doc)
install(FILES ${CMAKE_SOURCE_DIR}/README.md DESTINATION ${documents}/stereobench COMPONENT program)
install(FILES ${CMAKE_SOURCE_DIR}/docs/glossary.md DESTINATION ${documents}/stereobench/docs COMPONENT program)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/docs/guide ${CMAKE_SOURCE_DIR}/docs/pictures
        DESTINATION ${documents}/stereobench/docs COMPONENT program)
if(NOT EXISTS /etc/debian_version)
  return()
endif()

# What Debian asks of each of its packages, in a folder of the package.
foreach(text IN ITEMS packaging/changelog=changelog.Debian CHANGELOG.md=changelog)
  string(REGEX MATCH "(.*)=(.*)" text ${text})
  execute_process(COMMAND gzip -9nc ${CMAKE_SOURCE_DIR}/${CMAKE_MATCH_1} OUTPUT_FILE ${made}/${CMAKE_MATCH_2}.gz
                  COMMAND_ERROR_IS_FATAL ANY)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${CMAKE_MATCH_1})
endforeach()
foreach(pair IN ITEMS program=stereobench dev=libstereobench-dev python=python3-stereobench)
  string(REGEX MATCH "(.*)=(.*)" pair ${pair})
  set(component ${CMAKE_MATCH_1})
  set(package ${CMAKE_MATCH_2})
  install(FILES ${packaging}/copyright DESTINATION ${documents}/${package} COMPONENT ${component})
  install(FILES ${made}/changelog.Debian.gz ${made}/changelog.gz DESTINATION ${documents}/${package}
          COMPONENT ${component})
  install(FILES ${packaging}/lintian-overrides RENAME ${package}
          DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides COMPONENT ${component})
endforeach()

include(StereobenchPackages)
