#include <algorithm>
#include <future>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "harness/json/cbor.h"
#include "harness/process/process_pool.h"
#include "harness/process/progress.h"
#include "harness/process/standard_streams.h"
#include "harness/run/seed_result.h"
#include "harness/store/answer_store.h"

namespace stereobench::harness {
namespace {

std::string answer_of(const DriveTask& task, const std::function<void(double)>& report) {
  return to_bytes(score_seed(drive_seed(task, report), task.parts));
}

/// How many of some tasks have the same sight.
std::map<std::string, std::size_t> sharers_of(const std::vector<DriveTask>& tasks) {
  std::map<std::string, std::size_t> sharers;
  for (const DriveTask& task : tasks)
    if (!task.sight.empty()) ++sharers[task.sight];
  return sharers;
}

/// A task's answer, where its detector has answered already. @param sharers among which the time that this
/// took is divided
std::string answer_by_sight(const DriveTask& task, const AnswerStore& store, std::size_t sharers) {
  const SeenDrive seen = seen_drive_from_bytes(store.read(task.sight));
  SeedDrive drive = drive_seen(task, seen);
  for (const auto& [stage, seconds] : seen.timing)
    drive.recording.timing[stage] += seconds / static_cast<double>(sharers);
  return to_bytes(score_seed(drive, task.parts));
}

using Group = std::vector<DriveTask>;

/// An entry a task: its result's bytes, or why there is none.
std::string answers_of(const Group& group, const std::function<void(double)>& report) {
  nlohmann::json answers = nlohmann::json::array();
  const std::vector<SharedSeedDrive> drives = drive_together(group, report);
  for (std::size_t i = 0; i < group.size(); ++i)
    answers.push_back(
        {{"fault", drives[i].fault},
         {"result",
          drives[i].fault.empty() ? to_bytes(score_seed(drives[i].drive, group[i].parts)) : std::string()}});
  return bytes_of(answers);
}

/// For each sight that a store lacks a task that has it, in groups that are shown the same pictures.
std::vector<Group> unseen_of(const std::vector<const DriveTask*>& tasks, const AnswerStore& store) {
  std::set<std::string> sights;
  std::map<std::string, std::size_t> places;
  std::vector<Group> groups;
  for (const DriveTask* task : tasks) {
    if (task->sight.empty() || store.holds(task->sight) || !sights.insert(task->sight).second) continue;
    const auto [place, is_new] = places.try_emplace(task->pictures, groups.size());
    if (is_new) groups.emplace_back();
    groups[place->second].push_back(*task);
  }
  return groups;
}

/// What the detectors of a group saw: an entry a task.
std::string sights_of(const Group& group, const std::function<void(double)>& report) {
  std::vector<const Experiment*> experiments;
  for (const DriveTask& task : group) experiments.push_back(task.experiment);
  nlohmann::json sights = nlohmann::json::array();
  for (const SeenDrive& seen :
       see_together(experiments, group.front().seeds(), group.front().backend, report))
    sights.push_back(to_bytes(seen));
  return bytes_of(sights);
}

/// Lets detectors look that have not yet, and keeps their answers.
void look(AnswerStore& store, const std::vector<const DriveTask*>& tasks, int jobs, const std::string& what) {
  const std::vector<Group> groups = unseen_of(tasks, store);
  if (groups.empty()) return;
  Progress progress(what + ": pictures", static_cast<double>(groups.size()));
  run_in_processes(
      groups.size(), jobs,
      [&](std::size_t index, const std::function<void(double)>& report) {
        return sights_of(groups[index], report);
      },
      [&](std::size_t index, const std::string& bytes) {
        const nlohmann::json sights = json_of(bytes);
        for (std::size_t i = 0; i < groups[index].size(); ++i)
          store.append(groups[index][i].sight, sights[i].get<std::string>());
      },
      [&](double done) { progress.show(done); });
}

/// The tasks that a store has no result of. Groups without any are left out.
std::vector<Group> missing_of(const std::vector<Group>& groups, const AnswerStore& store) {
  std::vector<Group> missing;
  for (const Group& group : groups) {
    Group rest;
    for (const DriveTask& task : group)
      if (!store.holds(task.key)) rest.push_back(task);
    if (!rest.empty()) missing.push_back(rest);
  }
  return missing;
}

/// Groups that are driven, and what became of them.
struct GroupDrive {
  AnswerStore& store;
  std::map<std::string, std::string> faults;  ///< by the key of the task
  std::vector<Group> broken;                  ///< one of several tasks took the others with it
  std::set<const Experiment*> told = {};      ///< those that have a fault

  void keep(const Group& group, const std::string& bytes) {
    const nlohmann::json answers = json_of(bytes);
    for (std::size_t i = 0; i < group.size(); ++i) {
      const std::string fault = answers[i].at("fault");
      if (fault.empty())
        store.append(group[i].key, answers[i].at("result").get<std::string>());
      else
        add_fault(group[i], fault);
    }
  }

  /// The first fault of an experiment is told at once: nobody has to wait for the end.
  void add_fault(const DriveTask& task, const std::string& message) {
    faults[task.key] = message;
    if (told.insert(task.experiment).second) note(message.substr(0, message.find('\n')));
  }

  void note_fault(const Group& group, const std::string& message) {
    if (group.size() == 1)
      add_fault(group.front(), message);
    else
      broken.push_back(group);
  }

  void run(const std::vector<Group>& groups, int jobs, const std::string& what) {
    if (groups.empty()) return;
    Progress progress(what, static_cast<double>(groups.size()));
    run_all_in_processes(
        groups.size(), jobs,
        [&](std::size_t index, const std::function<void(double)>& report) {
          return answers_of(groups[index], report);
        },
        [&](std::size_t index, const std::string& bytes) { keep(groups[index], bytes); },
        [&](std::size_t index, const std::string& message) { note_fault(groups[index], message); },
        [&](double done) { progress.show(done); });
  }
};

/// Results that a store has, read by several threads: they are many, and take longer to read than to add up.
std::vector<SeedResult> read_results(const AnswerStore& store, std::span<const DriveTask> tasks,
                                     std::size_t threads) {
  std::vector<SeedResult> results(tasks.size());
  const auto read_every = [&](std::size_t first) {
    for (std::size_t i = first; i < tasks.size(); i += threads)
      results[i] = seed_result_from_bytes(store.read(tasks[i].key));
  };
  std::vector<std::future<void>> others;
  for (std::size_t thread = 1; thread < std::min(threads, tasks.size()); ++thread)
    others.push_back(std::async(std::launch::async, read_every, thread));
  read_every(0);
  for (std::future<void>& other : others) other.get();
  return results;
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
  constexpr std::size_t kResultsOfAThread = 8;  // a result of `run` has a megabyte
  const auto threads = static_cast<std::size_t>(std::max(1, jobs));
  std::size_t next = 0;
  const auto hand_on = [&] {
    while (next < tasks.size() && store.holds(tasks[next].key)) {
      std::size_t end = next + 1;
      const std::size_t most = std::min(tasks.size(), next + kResultsOfAThread * threads);
      while (end < most && store.holds(tasks[end].key)) ++end;
      for (const SeedResult& seed : read_results(store, std::span(tasks).subspan(next, end - next), threads))
        on_seed(next++, seed);
    }
  };
  std::vector<const DriveTask*> missing;
  for (const DriveTask& task : tasks)
    if (!store.holds(task.key)) missing.push_back(&task);
  hand_on();
  if (missing.empty()) return;
  look(store, missing, jobs, what);
  Progress progress(what, static_cast<double>(missing.size()));
  const auto drive_task = [&, sharers = sharers_of(tasks)](std::size_t index,
                                                           const std::function<void(double)>& report) {
    const DriveTask& task = *missing[index];
    return task.sight.empty() ? answer_of(task, report)
                              : answer_by_sight(task, store, sharers.at(task.sight));
  };
  const auto keep = [&](std::size_t index, const std::string& answer) {
    store.append(missing[index]->key, answer);
    hand_on();
  };
  run_in_processes(missing.size(), jobs, drive_task, keep, [&](double done) { progress.show(done); });
}

std::map<std::string, std::string> drive_groups(AnswerStore& store, const std::vector<Group>& groups,
                                                int jobs, const std::string& what) {
  GroupDrive drive{.store = store};
  drive.run(missing_of(groups, store), jobs, what);
  std::vector<Group> single;
  for (const Group& group : drive.broken)
    for (const DriveTask& task : group) single.push_back({task});
  drive.run(single, jobs, what);
  return drive.faults;
}

}  // namespace stereobench::harness
