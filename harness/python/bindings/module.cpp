#include "harness/process/progress.h"
#include "harness/python/bindings/bindings.h"
#include "harness/python/bindings/tables.h"

namespace bindings = stereobench::harness::bindings;

PYBIND11_MODULE(_core, module) {
  module.doc() = "The compiled part of stereobench; use it through the package.";
  stereobench::harness::silence_progress();
  bindings::register_tables();
  bindings::add_errors(module);
  bindings::add_scenario(module);
  bindings::add_frame(module);
  bindings::add_drive(module);
  bindings::add_filter(module);
  bindings::add_tally(module);
  bindings::add_run(module);
}
