#include <cstdlib>

#include <benchmark/benchmark.h>

#include "harness/process/kept_memory.h"

int main(int argc, char** argv) {
  ::setenv("LP_NUM_THREADS", "0", 0);         // rasterise in the calling thread: figures are for one core
  stereobench::harness::keep_freed_memory();  // as where data sets are rendered
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
}
