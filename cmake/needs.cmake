# What modules of stereobench need of others, for the build and for projects that find_package() it: the file
# <module>/dependencies.cmake of each module calls these, and names the Debian package that has it. What is not there is
# added to `stereobench_missing`, and every Debian package to `stereobench_packages`.

# stereobench_need(<Debian package> <name> <arguments of find_package...>)
macro(stereobench_need debian name)
  find_package(${name} QUIET ${ARGN})
  stereobench_note(${debian} ${name} ${name}_FOUND)
endmacro()

# stereobench_need_module(<Debian package> <prefix> <module of pkg-config>): the target PkgConfig::<prefix>
macro(stereobench_need_module debian prefix module)
  find_package(PkgConfig QUIET)
  set(${prefix}_FOUND FALSE)
  if(PkgConfig_FOUND)
    pkg_check_modules(${prefix} QUIET IMPORTED_TARGET ${module})
  endif()
  stereobench_note(${debian} ${module} ${prefix}_FOUND)
endmacro()

# stereobench_need_library(<Debian package> <name>): linked by its name
macro(stereobench_need_library debian name)
  find_library(STEREOBENCH_${name}_LIBRARY ${name})
  mark_as_advanced(STEREOBENCH_${name}_LIBRARY)
  stereobench_note(${debian} lib${name} STEREOBENCH_${name}_LIBRARY)
endmacro()

# stereobench_need_header(<Debian package> <name>): headers of ours include it
macro(stereobench_need_header debian name)
  find_path(STEREOBENCH_${name}_FOLDER ${name})
  mark_as_advanced(STEREOBENCH_${name}_FOLDER)
  stereobench_note(${debian} ${name} STEREOBENCH_${name}_FOLDER)
endmacro()

# @param found the name of the variable that says so
macro(stereobench_note debian name found)
  list(APPEND stereobench_packages ${debian})
  if(NOT ${found})
    list(APPEND stereobench_missing "${name} (Debian: ${debian})")
  endif()
endmacro()
