#include "harness/process/process_pool.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <new>
#include <optional>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "harness/process/interruption.h"

namespace stereobench::harness {
namespace {

enum class MessageKind : std::uint32_t { kStarted, kProgress, kAnswer, kError, kCrash };

/// What travels through a worker's pipe before its `size` bytes of payload.
struct MessageHeader {
  MessageKind kind = MessageKind::kStarted;
  std::uint64_t index = 0;
  double fraction = 0.0;
  std::uint64_t size = 0;
};

struct Worker {
  pid_t pid = -1;
  int pipe = -1;
  std::string received;                ///< bytes that do not yet make a whole message
  std::optional<std::size_t> current;  ///< the task it is at
};

void write_all(int file, const char* bytes, std::size_t size) {
  while (size > 0) {
    const ssize_t written = ::write(file, bytes, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) ::_exit(EXIT_FAILURE);  // the parent is gone
    bytes += written;
    size -= static_cast<std::size_t>(written);
  }
}

void send(int file, const MessageHeader& header, const std::string& payload) {
  std::string message(sizeof(MessageHeader), '\0');
  std::memcpy(message.data(), &header, sizeof(MessageHeader));
  message += payload;
  write_all(file, message.data(), message.size());
}

/// The next task that nobody has taken, shared by all workers.
class SharedCounter {
 public:
  SharedCounter()
      : memory_(::mmap(nullptr, sizeof(std::atomic<std::size_t>), PROT_READ | PROT_WRITE,
                       MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {
    if (memory_ == MAP_FAILED) throw std::runtime_error("cannot share memory with worker processes");
    new (memory_) std::atomic<std::size_t>(0);
  }
  ~SharedCounter() { ::munmap(memory_, sizeof(std::atomic<std::size_t>)); }
  SharedCounter(const SharedCounter&) = delete;
  SharedCounter& operator=(const SharedCounter&) = delete;
  std::size_t next() { return static_cast<std::atomic<std::size_t>*>(memory_)->fetch_add(1); }

 private:
  void* memory_;
};

/// @param goes_on after a task that failed
[[noreturn]] void work(SharedCounter& counter, std::size_t tasks, const Task& task, bool goes_on, int file) {
  for (std::size_t index = counter.next(); index < tasks; index = counter.next()) {
    send(file, {MessageKind::kStarted, index, 0.0, 0}, {});
    const auto report = [&](double fraction) {
      send(file, {MessageKind::kProgress, index, fraction, 0}, {});
    };
    const auto give_up = [&](MessageKind kind, const std::string& message) {
      send(file, {kind, index, 1.0, message.size()}, message);
      if (!goes_on) ::_exit(EXIT_SUCCESS);
    };
    try {
      const std::string answer = task(index, report);
      send(file, {MessageKind::kAnswer, index, 1.0, answer.size()}, answer);
    } catch (const RunCrash& crash) {
      give_up(MessageKind::kCrash, crash.what());
    } catch (const std::exception& error) {
      give_up(MessageKind::kError, error.what());
    }
  }
  ::_exit(EXIT_SUCCESS);
}

/// The parent's side: starts workers, gathers answers, and leaves no process behind.
class Pool {
 public:
  /// @param on_fault empty: the first fault ends all
  Pool(std::size_t tasks, const Task& task, const OnAnswer& on_answer, const OnFault& on_fault,
       const OnProgress& on_progress)
      : task_(task),
        fractions_(tasks, 0.0),
        on_answer_(on_answer),
        on_fault_(on_fault),
        on_progress_(on_progress) {}
  ~Pool() {
    for (Worker& worker : workers_) {
      if (worker.pid > 0) ::kill(worker.pid, SIGKILL);
      retire(worker);
    }
  }
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  void start_worker() {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0)  // a program that a worker starts shall not hold it open
      throw std::runtime_error(fmt::format("cannot start a worker: {}", std::strerror(errno)));
    std::fflush(nullptr);  // or the child would print the parent's buffered text again
    const pid_t parent = ::getpid();
    const pid_t pid = ::fork();
    if (pid == 0) {
      follow_parent(parent);
      ::close(ends[0]);
      work(counter_, fractions_.size(), task_, static_cast<bool>(on_fault_), ends[1]);
    }
    ::close(ends[1]);
    if (pid < 0) {
      ::close(ends[0]);
      throw std::runtime_error(fmt::format("cannot start a worker: {}", std::strerror(errno)));
    }
    workers_.push_back({pid, ends[0], {}, std::nullopt});
  }

  void gather() {
    while (!error_ && !crash_ && wait_for_input()) {
    }
    if (crash_) throw RunCrash(*crash_);
    if (error_) throw std::runtime_error(*error_);
  }

 private:
  bool wait_for_input() {
    std::vector<pollfd> polled;
    for (const Worker& worker : workers_)
      polled.push_back({worker.pipe, POLLIN, 0});  // -1 is skipped by poll
    if (std::all_of(workers_.begin(), workers_.end(), [](const Worker& w) { return w.pipe < 0; }))
      return false;
    if (::poll(polled.data(), polled.size(), -1) < 0 && errno != EINTR)
      throw std::runtime_error(fmt::format("cannot wait for workers: {}", std::strerror(errno)));
    for (std::size_t i = 0; i < polled.size(); ++i)
      if (polled[i].revents != 0) receive(i);
    return true;
  }

  void receive(std::size_t place) {
    Worker& worker = workers_[place];
    char buffer[65536];
    const ssize_t count = ::read(worker.pipe, buffer, sizeof(buffer));
    if (count < 0 && errno == EINTR) return;
    if (count <= 0) return finish(place);
    worker.received.append(buffer, static_cast<std::size_t>(count));
    while (take_message(worker)) {
    }
  }

  bool take_message(Worker& worker) {
    MessageHeader header;
    if (worker.received.size() < sizeof(MessageHeader)) return false;
    std::memcpy(&header, worker.received.data(), sizeof(MessageHeader));
    if (worker.received.size() < sizeof(MessageHeader) + header.size) return false;
    std::string payload = worker.received.substr(sizeof(MessageHeader), header.size);
    worker.received.erase(0, sizeof(MessageHeader) + header.size);
    apply(worker, header, std::move(payload));
    return true;
  }

  void apply(Worker& worker, const MessageHeader& header, std::string payload) {
    worker.current = header.index;
    fractions_[header.index] = header.fraction;
    if (header.kind == MessageKind::kAnswer) on_answer_(header.index, std::move(payload));
    const bool is_fault = header.kind == MessageKind::kError || header.kind == MessageKind::kCrash;
    if (is_fault && on_fault_)
      on_fault_(header.index, std::move(payload));
    else if (is_fault)
      (header.kind == MessageKind::kCrash ? crash_ : error_) = std::move(payload);
    if (header.kind != MessageKind::kStarted && header.kind != MessageKind::kProgress) worker.current.reset();
    double done = 0.0;
    for (const double fraction : fractions_) done += fraction;
    on_progress_(done);
  }

  void finish(std::size_t place) {
    const std::optional<std::size_t> unfinished = workers_[place].current;
    const int status = retire(workers_[place]);
    if (!unfinished && WIFEXITED(status) && WEXITSTATUS(status) == EXIT_SUCCESS) return;
    const std::string cause = WIFSIGNALED(status) ? fmt::format("signal {}", WTERMSIG(status))
                                                  : fmt::format("exit status {}", WEXITSTATUS(status));
    if (!on_fault_ || !unfinished)
      throw WorkerCrash(
          fmt::format("a worker process ended with {} {}", cause,
                      unfinished ? fmt::format("in task {}", *unfinished) : "between two tasks"));
    on_fault_(*unfinished, fmt::format("a worker process ended with {}", cause));
    start_worker();  // it ends at once where no task is left
  }

  static int retire(Worker& worker) {
    int status = 0;
    if (worker.pipe >= 0) ::close(worker.pipe);
    worker.pipe = -1;
    if (worker.pid > 0)
      while (::waitpid(worker.pid, &status, 0) < 0 && errno == EINTR) {
      }
    worker.pid = -1;
    return status;
  }

  const Task& task_;
  SharedCounter counter_;
  std::vector<Worker> workers_;
  std::vector<double> fractions_;
  const OnAnswer& on_answer_;
  const OnFault& on_fault_;
  const OnProgress& on_progress_;
  std::optional<std::string> error_;
  std::optional<std::string> crash_;
};

}  // namespace

void run_all_in_processes(std::size_t tasks, int jobs, const Task& task, const OnAnswer& on_answer,
                          const OnFault& on_fault, const OnProgress& on_progress) {
  if (jobs < 1) throw std::invalid_argument("run_in_processes: jobs must be at least 1");
  Pool pool(tasks, task, on_answer, on_fault, on_progress);
  const std::size_t workers = std::min(tasks, static_cast<std::size_t>(jobs));
  for (std::size_t i = 0; i < workers; ++i) pool.start_worker();
  pool.gather();
}

void run_in_processes(std::size_t tasks, int jobs, const Task& task, const OnAnswer& on_answer,
                      const OnProgress& on_progress) {
  run_all_in_processes(tasks, jobs, task, on_answer, {}, on_progress);
}

void run_in_order(std::size_t tasks, int jobs, const Task& task, const OnAnswer& on_answer,
                  const OnProgress& on_progress) {
  std::map<std::size_t, std::string> early;
  std::size_t next = 0;
  const auto hand_on = [&](std::size_t index, std::string answer) {
    early.emplace(index, std::move(answer));
    for (auto first = early.begin(); first != early.end() && first->first == next; first = early.begin()) {
      on_answer(next++, std::move(first->second));
      early.erase(first);
    }
  };
  run_in_processes(tasks, jobs, task, hand_on, on_progress);
}

std::vector<std::string> run_in_processes(std::size_t tasks, int jobs, const Task& task,
                                          const OnProgress& on_progress) {
  std::vector<std::string> answers(tasks);
  const auto keep = [&](std::size_t index, std::string answer) { answers[index] = std::move(answer); };
  run_in_processes(tasks, jobs, task, keep, on_progress);
  return answers;
}

}  // namespace stereobench::harness
