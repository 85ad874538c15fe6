# Where modules are installed, for projects that find_package(stereobench COMPONENTS <module>).
if(CMAKE_LIBRARY_ARCHITECTURE)  # as Debian has it; CMake looks there under any prefix
  set(CMAKE_INSTALL_LIBDIR lib/${CMAKE_LIBRARY_ARCHITECTURE} CACHE STRING "folder of libraries")
endif()
include(GNUInstallDirs)
set(STEREOBENCH_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/stereobench)

# stereobench_install_module(<name>): the library stereobench_<name> as stereobench::<name>, with all its headers.
function(stereobench_install_module name)
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.h)
  list(FILTER headers EXCLUDE REGEX "/python/bindings/")
  target_sources(stereobench_${name} PUBLIC FILE_SET HEADERS BASE_DIRS ${CMAKE_SOURCE_DIR} FILES ${headers})
  set_target_properties(stereobench_${name} PROPERTIES EXPORT_NAME ${name})
  install(TARGETS stereobench_${name} EXPORT stereobench-${name}
          ARCHIVE COMPONENT dev
          FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/stereobench COMPONENT dev)
  install(EXPORT stereobench-${name} NAMESPACE stereobench:: FILE ${name}-targets.cmake
          DESTINATION ${STEREOBENCH_CMAKE_DIR} COMPONENT dev)
  install(FILES ${CMAKE_CURRENT_SOURCE_DIR}/dependencies.cmake RENAME ${name}-dependencies.cmake
          DESTINATION ${STEREOBENCH_CMAKE_DIR} COMPONENT dev)
endfunction()

# The options go with the first module: all others need it.
set_target_properties(stereobench_options PROPERTIES EXPORT_NAME options)
install(TARGETS stereobench_options EXPORT stereobench-slam)
