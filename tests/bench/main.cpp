#include <cstdlib>

#include <benchmark/benchmark.h>

int main(int argc, char** argv) {
  ::setenv("LP_NUM_THREADS", "0", 0);  // rasterise in the calling thread: figures are for one core
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
}
