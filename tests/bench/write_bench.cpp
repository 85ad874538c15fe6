/// What a data set costs: whole sets, pairs of them and files, in CPU time and as multiples of rendering a
/// pair alone, in turns with it.
#include <array>
#include <ctime>
#include <fstream>

#include <benchmark/benchmark.h>

#include "harness/collection/render_tasks.h"
#include "harness/experiment/experiment.h"
#include "harness/io/picture_file.h"
#include "harness/io/sha256.h"
#include "harness/process/progress.h"
#include "renderer/camera/expose.h"
#include "tests/bench/bench_scene.h"
#include "tests/test_folder.h"

namespace stereobench {
namespace {

constexpr int kFew = 2, kMany = 14;  // pairs: their difference is free of what comes once a set

/// CPU time of this process, all threads and the kernel's work for them. Others take none of it.
double cpu_s() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <typename Action>
double cpu_s_of(const Action& action) {
  const double begin_s = cpu_s();
  action();
  return cpu_s() - begin_s;
}

/// What is written of ball_circle.
struct WrittenSet {
  const char* format;
  const char* truth;
  harness::TruthFormat truth_format = harness::TruthFormat::kExact;
};

/// Writes data sets of ball_circle, and renders the same pairs without anything else.
class SetBench {
 public:
  explicit SetBench(const WrittenSet& set)
      : file_(std::string(STEREOBENCH_SOURCE_DIR) + "/assets/scenarios/ball_circle.yaml"),
        experiment_(harness::read_experiment(file_)),
        request_{.scenario = file_, .formats = {&harness::dataset_format(set.format)}},
        renderer_(experiment_.scenario.world, experiment_.scenario.rig) {
    harness::silence_progress();
    request_.truth.format = set.truth_format;
    if (*set.truth != '\0') request_.truth.kinds = harness::parse_truth(set.truth);
  }

  /// @param pairs the first ones of the drive
  void write(int pairs) {
    const TestFolder folder;
    request_.frames.last = static_cast<std::size_t>(pairs - 1);
    harness::render_seeds(harness::render_tasks(request_, experiment_, {0}, folder.path() / "set", false), 1,
                          "");
  }

  void render(int pairs) {
    for (int i = 0; i < pairs; ++i)
      benchmark::DoNotOptimize(renderer_.render(experiment_.scenario.path[static_cast<std::size_t>(i)].pose));
  }

 private:
  std::filesystem::path file_;
  harness::Experiment experiment_;
  harness::RenderRequest request_;
  renderer::Renderer renderer_;
};

/// A set of kMany pairs from nothing to its manifest, shaders and all.
void write_set(benchmark::State& state, const WrittenSet& set) {
  SetBench bench(set);
  double set_s = 0.0, render_s = 0.0;
  for (auto _ : state) {
    const double this_s = cpu_s_of([&] { bench.write(kMany); });
    render_s += cpu_s_of([&] { bench.render(kMany); });
    set_s += this_s;
    state.SetIterationTime(this_s);
  }
  state.counters["pairs_per_cpu_s"] = kMany * static_cast<double>(state.iterations()) / set_s;
  state.counters["renderings"] = set_s / render_s;
}

/// One more pair of a set.
void write_pair(benchmark::State& state, const WrittenSet& set) {
  constexpr int kMore = kMany - kFew;
  SetBench bench(set);
  double pairs_s = 0.0, render_s = 0.0;
  for (auto _ : state) {
    const double few_s = cpu_s_of([&] { bench.write(kFew); });
    const double more_s = cpu_s_of([&] { bench.write(kMany); }) - few_s;
    render_s += cpu_s_of([&] { bench.render(kMore); });
    pairs_s += more_s;
    state.SetIterationTime(more_s / kMore);
  }
  state.counters["pairs_per_cpu_s"] = kMore * static_cast<double>(state.iterations()) / pairs_s;
  state.counters["renderings"] = pairs_s / render_s;
}

/// Both cameras' pictures of one kind, as bytes of files.
void encode_pair(benchmark::State& state, std::string_view extension,
                 cv::Mat renderer::RenderedImage::*kind) {
  Bench bench(scenario_scene("ball_circle"));
  std::size_t bytes = 0;
  bench.run(state, [&] {
    bytes = harness::encoded(extension, bench.frame.left.*kind).size() +
            harness::encoded(extension, bench.frame.right.*kind).size();
  });
  state.counters["bytes"] = static_cast<double>(bytes);
}

/// The names of a pair's bytes in the manifest: two depth pictures.
void hash_pair(benchmark::State& state) {
  Bench bench(scenario_scene("ball_circle"));
  const std::string bytes = harness::encoded(".pfm", bench.frame.left.depth_m);
  bench.run(state, [&] {
    benchmark::DoNotOptimize(harness::sha256_of(bytes));
    benchmark::DoNotOptimize(harness::sha256_of(bytes));
  });
}

constexpr WrittenSet kPosesAlone = {"euroc", ""};
constexpr WrittenSet kIdsAndDepth = {"plain", ""};
constexpr WrittenSet kAllTruth = {"plain", "all"};
constexpr WrittenSet kAllTruthInTiff = {"plain", "all", harness::TruthFormat::kTiff};

#define STEREOBENCH_WRITE(function, name, set) \
  BENCHMARK_CAPTURE(function, name, set)->Unit(benchmark::kMillisecond)->UseManualTime()->Iterations(3)

STEREOBENCH_WRITE(write_set, poses, kPosesAlone);
STEREOBENCH_WRITE(write_set, ids_and_depth, kIdsAndDepth);
STEREOBENCH_WRITE(write_set, all_truth, kAllTruth);
STEREOBENCH_WRITE(write_pair, poses, kPosesAlone);
STEREOBENCH_WRITE(write_pair, ids_and_depth, kIdsAndDepth);
STEREOBENCH_WRITE(write_pair, all_truth, kAllTruth);
STEREOBENCH_WRITE(write_pair, all_truth_in_tiff, kAllTruthInTiff);

#define STEREOBENCH_ENCODE(function, ...) \
  BENCHMARK_CAPTURE(function, __VA_ARGS__)->Unit(benchmark::kMillisecond)->UseManualTime()

STEREOBENCH_ENCODE(encode_pair, ids_png, ".png", &renderer::RenderedImage::ball_id);
STEREOBENCH_ENCODE(encode_pair, depth_pfm, ".pfm", &renderer::RenderedImage::depth_m);
STEREOBENCH_ENCODE(encode_pair, depth_tiff, ".tiff", &renderer::RenderedImage::depth_m);
BENCHMARK(hash_pair)->Name("hash_pair/depth")->Unit(benchmark::kMillisecond)->UseManualTime();

}  // namespace
}  // namespace stereobench
