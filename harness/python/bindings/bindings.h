/// The parts of the Python module `stereobench._core`: each adds its functions and classes.
#pragma once

#include <pybind11/pybind11.h>

namespace stereobench::harness::bindings {

void add_errors(pybind11::module_& module);
void add_scenario(pybind11::module_& module);
void add_frame(pybind11::module_& module);
void add_drive(pybind11::module_& module);
void add_filter(pybind11::module_& module);
void add_tally(pybind11::module_& module);
void add_run(pybind11::module_& module);

}  // namespace stereobench::harness::bindings
