# Three Debian packages, one a component; scripts/package.sh makes them.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME stereobench)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_DEBIAN_PACKAGE_RELEASE ${STEREOBENCH_REVISION})
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program dev python)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
string(REGEX MATCH " -- ([^>]*>)" maintainer "${changelog_lines}")
set(CPACK_DEBIAN_PACKAGE_MAINTAINER ${CMAKE_MATCH_1})
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME stereobench)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# What the program opens at run time, and the letters of its charts.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "libosmesa6 | libegl1, fonts-dejavu-core")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "libegl1, libgl1-mesa-dri, python3")  # python3: for the example of a detector
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "python3-stereobench, python3-opencv, ffmpeg")
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "testbench of stereo vision and SLAM with exact truth
stereobench renders a robot's drive through a world of coloured balls, rooms
and corridors, in software, without a graphics card or a screen. Vision finds
the balls in each stereo pair, SLAM filters estimate the robot's path and a
map, and every stage is scored against exact truth.

It is for regression tests of vision code, for rendered data sets, and for
studies of what a detector's noise does to SLAM.")

# Headers include those of others: the packages that the modules' dependencies.cmake name.
list(REMOVE_DUPLICATES stereobench_packages)
list(JOIN stereobench_packages ", " needed)
set(CPACK_DEBIAN_DEV_PACKAGE_NAME libstereobench-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "pkg-config, ${needed}")
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS "cmake, g++")
set(CPACK_DEBIAN_DEV_DESCRIPTION "C++ modules of stereobench: SLAM, stereo vision, rendering
Headers, static libraries and CMake files of what stereobench is made of: SLAM
filters (EKF, FastSLAM, UFastSLAM, incremental smoothing), detection of balls
in stereo pairs, worlds and paths, an offscreen renderer, and the harness that
runs and scores experiments.

Each module is a CMake target of its own that needs only those before it.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-stereobench)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
if(python_part STREQUAL MODULE_LIBRARY)  # which is for one version of Python
  get_property(minor GLOBAL PROPERTY STEREOBENCH_PYTHON_MINOR)
  math(EXPR next_minor "${minor} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "python3 (>= 3.${minor}), python3 (<< 3.${next_minor}), python3-numpy, libosmesa6 | libegl1")
else()
  set(CPACK_DEBIAN_PYTHON_PACKAGE_ARCHITECTURE all)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3, python3-numpy")
endif()
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-opencv")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${packaging}/postinst ${packaging}/prerm)
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "testbench of stereo vision and SLAM with exact truth, from Python
The module stereobench renders scenarios to numpy arrays, calls detectors that
are written in Python, steps filters, and scores both against exact truth. Its
part stereobench.datasets opens rendered data sets: pictures, depth, flow,
disparity, poses, tables and calibrations.

Pictures and calibrations of data sets are read by OpenCV (python3-opencv).")

include(CPack)
