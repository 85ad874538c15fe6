#include "harness/io/answer_store.h"
#include "harness/json/cbor.h"
#include "harness/process/process_pool.h"
#include "harness/process/progress.h"
#include "harness/run/seed_result.h"

namespace stereobench::harness {
namespace {

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

  void keep(const Group& group, const std::string& bytes) {
    const nlohmann::json answers = json_of(bytes);
    for (std::size_t i = 0; i < group.size(); ++i) {
      const std::string fault = answers[i].at("fault");
      if (fault.empty())
        store.append(group[i].key, answers[i].at("result").get<std::string>());
      else
        faults[group[i].key] = fault;
    }
  }

  void note_fault(const Group& group, const std::string& message) {
    if (group.size() == 1)
      faults[group.front().key] = message;
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

}  // namespace

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
