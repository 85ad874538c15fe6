#include "harness/io/answer_store.h"
#include "harness/process/process_pool.h"
#include "harness/process/progress.h"
#include "harness/run/seed_result.h"

namespace stereobench::harness {
namespace {

std::string answer_of(const DriveTask& task, const std::function<void(double)>& report) {
  return to_bytes(score_seed(drive_seed(task, report), task.parts));
}

}  // namespace

void drive_seeds(const std::vector<DriveTask>& tasks, int jobs, const std::string& what,
                 const OnSeed& on_seed) {
  Progress progress(what, static_cast<double>(tasks.size()));
  const auto drive_task = [&](std::size_t index, const std::function<void(double)>& report) {
    return answer_of(tasks[index], report);
  };
  const auto hand_on = [&](std::size_t index, const std::string& answer) {
    on_seed(index, seed_result_from_bytes(answer));
  };
  run_in_order(tasks.size(), jobs, drive_task, hand_on, [&](double done) { progress.show(done); });
}

void drive_into(AnswerStore& store, const std::vector<DriveTask>& tasks, int jobs, const std::string& what,
                const OnSeed& on_seed) {
  std::size_t next = 0;
  const auto hand_on = [&] {
    for (; next < tasks.size() && store.holds(tasks[next].key); ++next)
      on_seed(next, seed_result_from_bytes(store.read(tasks[next].key)));
  };
  std::vector<const DriveTask*> missing;
  for (const DriveTask& task : tasks)
    if (!store.holds(task.key)) missing.push_back(&task);
  hand_on();
  if (missing.empty()) return;
  Progress progress(what, static_cast<double>(missing.size()));
  const auto drive_task = [&](std::size_t index, const std::function<void(double)>& report) {
    return answer_of(*missing[index], report);
  };
  const auto keep = [&](std::size_t index, const std::string& answer) {
    store.append(missing[index]->key, answer);
    hand_on();
  };
  run_in_processes(missing.size(), jobs, drive_task, keep, [&](double done) { progress.show(done); });
}

}  // namespace stereobench::harness
