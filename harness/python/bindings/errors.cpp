#include <stdexcept>

#include "harness/process/process_pool.h"
#include "harness/python/bindings/bindings.h"

namespace py = pybind11;

namespace stereobench::harness::bindings {
namespace {

/// Bad input and a crash, as the program tells them apart by its exit codes 2 and 4.
void translate(std::exception_ptr thrown) {
  const py::module_ module = py::module_::import("stereobench._core");
  try {
    std::rethrow_exception(thrown);
  } catch (const py::builtin_exception&) {
    throw;  // pybind11 knows what it is in Python
  } catch (const RunCrash& crash) {
    PyErr_SetString(module.attr("RunCrash").ptr(), crash.what());
  } catch (const std::runtime_error& error) {
    PyErr_SetString(module.attr("Error").ptr(), error.what());
  }
}

}  // namespace

void add_errors(py::module_& module) {
  const py::object error = py::reinterpret_steal<py::object>(PyErr_NewExceptionWithDoc(
      "stereobench.Error", "Bad input. The message is the line that the program would print.",
      PyExc_RuntimeError, nullptr));
  module.attr("Error") = error;
  module.attr("RunCrash") = py::reinterpret_steal<py::object>(PyErr_NewExceptionWithDoc(
      "stereobench.RunCrash", "A run or a detector broke down. The message is the program's line.",
      error.ptr(), nullptr));
  py::register_exception_translator(translate);
}

}  // namespace stereobench::harness::bindings
