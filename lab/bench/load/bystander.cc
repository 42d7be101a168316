// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/load/bystander.h"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <istream>
#include <optional>
#include <sstream>
#include <string>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "absl/time/clock.h"
#include "core/types/status_macros.h"
#include "lab/bench/load/load_watcher.h"

namespace plumescout::lab {
namespace {

constexpr int kLowestPriority = 19;
constexpr absl::Duration kFrameLook = absl::Milliseconds(50);

// A line, without its end; nothing if the other side is gone.
std::optional<std::string> ReadLine(int descriptor) {
  std::string line;
  char letter = 0;
  while (true) {
    const ssize_t size = read(descriptor, &letter, 1);
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) return std::nullopt;
    if (letter == '\n') return line;
    line += letter;
  }
}

// Whether the other side took it.
bool WriteLine(int descriptor, const std::string& text) {
  const std::string line = absl::StrCat(text, "\n");
  return write(descriptor, line.data(), line.size()) == static_cast<ssize_t>(line.size());
}

// The bystander's side: what its orders have done.
class Helper {
 public:
  std::string Answer(const std::string& order) {
    std::istringstream words(order);
    std::string name;
    words >> name;
    if (name == "watch") return BeginWatch(words);
    if (name == "unwatch") return EndWatch();
    return RunFlood(words);
  }

 private:
  using Watchers = std::vector<std::unique_ptr<LoadWatcher>>;

  std::string BeginWatch(std::istream& words) {
    std::string target;
    std::string mission;
    int count = 0;
    double patience_s = 0.0;
    words >> target >> mission >> count >> patience_s;
    for (int i = 0; i < count; ++i) {
      watchers_.push_back(std::make_unique<LoadWatcher>(target, mission, nullptr));
    }
    const auto waits = [](const auto& watcher) { return watcher->frame_count() == 0; };
    const absl::Time deadline = absl::Now() + absl::Seconds(patience_s);
    while (absl::Now() < deadline && std::any_of(watchers_.begin(), watchers_.end(), waits)) {
      absl::SleepFor(kFrameLook);
    }
    return absl::StrCat(count, " ", std::count_if(watchers_.begin(), watchers_.end(), waits));
  }

  std::string EndWatch() {
    int sent_away = 0;
    std::int64_t frames = 0;
    for (const auto& watcher : watchers_) {
      if (watcher->was_sent_away()) ++sent_away;
      frames += watcher->frame_count();
    }
    watchers_.clear();
    return absl::StrCat(sent_away, " ", frames);
  }

  static std::string RunFlood(std::istream& words) {
    std::string target;
    client::RobotSession session;
    FloodOptions options;
    double time_s = 0.0;
    words >> target >> session.mission >> session.robot >> session.lease_token >>
        session.ingest.applied_sequence >> options.plans_per_s >> options.readings_per_s >>
        options.spread_m >> options.seed >> time_s;
    const Flood flood(target, session, options);
    absl::SleepFor(absl::Seconds(time_s));
    const FloodFigures figures = flood.figures();
    return absl::StrCat(figures.plans_asked, " ", figures.plans_made, " ", figures.readings_sent,
                        " ", figures.readings_taken);
  }

  Watchers watchers_;
};

[[noreturn]] void Help(int orders_fd, int answers_fd) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // whoever gives orders may end by a signal
  setpriority(PRIO_PROCESS, 0, kLowestPriority);
  Helper helper;
  while (const auto order = ReadLine(orders_fd)) {
    if (!WriteLine(answers_fd, helper.Answer(*order))) break;
  }
  _exit(0);  // without what the parent would do at its end
}

}  // namespace

absl::StatusOr<std::unique_ptr<Bystander>> Bystander::Fork() {
  std::array<int, 2> orders{};
  std::array<int, 2> answers{};
  if (pipe(orders.data()) != 0 || pipe(answers.data()) != 0) {
    return absl::UnavailableError(absl::StrCat("no pipe: ", strerror(errno)));
  }
  const pid_t pid = fork();
  if (pid < 0) return absl::UnavailableError(absl::StrCat("no process: ", strerror(errno)));
  if (pid == 0) {
    close(orders[1]);
    close(answers[0]);
    Help(orders[0], answers[1]);
  }
  close(orders[0]);
  close(answers[1]);
  return std::make_unique<Bystander>(Private(), pid, orders[1], answers[0]);
}

Bystander::~Bystander() {
  close(orders_fd_);
  close(answers_fd_);
  kill(pid_, SIGKILL);
  waitpid(pid_, nullptr, 0);
}

absl::StatusOr<std::vector<double>> Bystander::Ask(const std::string& order, std::size_t count) {
  if (!WriteLine(orders_fd_, order)) return absl::UnavailableError("the bystander is gone");
  const auto answer = ReadLine(answers_fd_);
  if (!answer.has_value()) return absl::UnavailableError("the bystander is gone");
  std::vector<double> numbers;
  for (const absl::string_view word : absl::StrSplit(*answer, ' ')) {
    double number = 0.0;
    if (absl::SimpleAtod(word, &number)) numbers.push_back(number);
  }
  if (numbers.size() == count) return numbers;
  return absl::UnavailableError(absl::StrCat("the bystander says \"", *answer, "\""));
}

absl::StatusOr<Bystander::Watch> Bystander::BeginWatch(const std::string& target,
                                                       const MissionId& mission, int watchers,
                                                       absl::Duration patience) {
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const auto numbers, Ask(absl::StrCat("watch ", target, " ", mission, " ", watchers, " ",
                                           absl::ToDoubleSeconds(patience)),
                              2));
  return Watch{static_cast<int>(numbers[0]), static_cast<int>(numbers[1])};
}

absl::StatusOr<Bystander::Watched> Bystander::EndWatch() {
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto numbers, Ask("unwatch", 2));
  return Watched{static_cast<int>(numbers[0]), numbers[1]};
}

absl::StatusOr<FloodFigures> Bystander::RunFlood(const std::string& target,
                                                 const client::RobotSession& session,
                                                 const FloodOptions& options, absl::Duration time) {
  const std::string order =
      absl::StrCat("flood ", target, " ", session.mission, " ", session.robot, " ",
                   session.lease_token, " ", session.ingest.applied_sequence, " ",
                   options.plans_per_s, " ", options.readings_per_s, " ", options.spread_m, " ",
                   options.seed, " ", absl::ToDoubleSeconds(time));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto numbers, Ask(order, 4));
  const auto whole = [&](std::size_t i) { return static_cast<std::int64_t>(numbers[i]); };
  return FloodFigures{whole(0), whole(1), whole(2), whole(3)};
}

}  // namespace plumescout::lab
