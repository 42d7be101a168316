// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/load/server_process.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <utility>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "absl/strings/strip.h"
#include "absl/time/clock.h"
#include "core/types/status_macros.h"

namespace plumescout::lab {
namespace {

constexpr char kAddressPrefix[] = "listening on ";
constexpr double kKibPerMb = 1024.0;
constexpr absl::Duration kStopPatience = absl::Seconds(30);
constexpr absl::Duration kLook = absl::Milliseconds(2);

std::string ReadFile(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

// CPU time from /proc/PID/stat, where utime and stime are fields 14 and 15, counted from 1.
absl::StatusOr<double> Cpu_s(const std::string& stat) {
  // Field 2 is a name in brackets that may hold anything.
  const std::size_t name_end = stat.rfind(')');
  if (name_end == std::string::npos) return absl::UnavailableError("the server has ended");
  const std::vector<std::string> fields = absl::StrSplit(stat.substr(name_end + 2), ' ');
  constexpr std::size_t kUserTime = 14 - 3;
  double user_ticks = 0.0;
  double system_ticks = 0.0;
  if (fields.size() <= kUserTime + 1 || !absl::SimpleAtod(fields[kUserTime], &user_ticks) ||
      !absl::SimpleAtod(fields[kUserTime + 1], &system_ticks)) {
    return absl::InternalError("/proc/PID/stat is not as expected");
  }
  return (user_ticks + system_ticks) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

// A line of /proc/PID/status such as "VmHWM:  1234 kB".
absl::StatusOr<double> Memory_mb(const std::string& status, absl::string_view name) {
  for (absl::string_view line : absl::StrSplit(status, '\n')) {
    double kib = 0.0;
    if (absl::ConsumePrefix(&line, name) && absl::ConsumeSuffix(&line, "kB") &&
        absl::SimpleAtod(line, &kib)) {
      return kib / kKibPerMb;
    }
  }
  return absl::UnavailableError("the server has ended");
}

// A pipe whose ends no other child inherits.
absl::StatusOr<std::array<int, 2>> MakePipe() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) return absl::ResourceExhaustedError("no pipe");
  return ends;
}

std::vector<std::string> CommandLine(const ServerStart& start) {
  std::vector<std::string> words;
  if (start.max_descriptors.has_value()) {
    words = {"/usr/bin/prlimit", absl::StrCat("--nofile=", *start.max_descriptors, ":")};
  }
  words.insert(words.end(),
               {start.program, "--listen", "127.0.0.1:0", "--set", "store.engine=none"});
  for (const std::string& setting : start.settings) {
    words.insert(words.end(), {"--set", setting});
  }
  return words;
}

absl::StatusOr<pid_t> Spawn(std::vector<std::string> words, int output, int log) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  if (log >= 0) {
    posix_spawn_file_actions_adddup2(&actions, log, STDERR_FILENO);
  } else {
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  }
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t pid = 0;
  const int error = posix_spawn(&pid, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) return absl::ErrnoToStatus(error, words[0]);
  return pid;
}

}  // namespace

absl::StatusOr<std::unique_ptr<ServerProcess>> ServerProcess::Start(const ServerStart& start) {
  if (access(start.program.c_str(), X_OK) != 0) {
    return absl::NotFoundError(absl::StrCat(start.program, " is not a program"));
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto output, MakePipe());
  std::array<int, 2> log = {-1, -1};
  if (start.log_unread) {
    PLUMESCOUT_ASSIGN_OR_RETURN(log, MakePipe());
  }
  const absl::StatusOr<pid_t> pid = Spawn(CommandLine(start), output[1], log[1]);
  close(output[1]);
  if (log[1] >= 0) close(log[1]);
  if (!pid.ok()) {
    close(output[0]);
    if (log[0] >= 0) close(log[0]);
    return pid.status();
  }
  auto server = std::make_unique<ServerProcess>(Private(), *pid, output[0], log[0]);
  PLUMESCOUT_RETURN_IF_ERROR(server->AwaitAddress());
  return server;
}

ServerProcess::~ServerProcess() {
  Stop(kStopPatience).status().IgnoreError();
  close(output_fd_);
  HangUpLog();
}

bool ServerProcess::IsAlive() {
  if (!ended_) ended_ = waitpid(pid_, nullptr, WNOHANG) == pid_;
  return !ended_;
}

absl::StatusOr<absl::Duration> ServerProcess::Stop(absl::Duration patience) {
  if (!IsAlive()) return absl::UnavailableError("the server has ended");
  const absl::Time asked = absl::Now();
  kill(pid_, SIGTERM);
  while (IsAlive()) {
    if (absl::Now() - asked > patience) {
      Kill();
      return absl::DeadlineExceededError("the server did not stop");
    }
    absl::SleepFor(kLook);
  }
  return absl::Now() - asked;
}

void ServerProcess::Kill() {
  if (!IsAlive()) return;
  kill(pid_, SIGKILL);
  waitpid(pid_, nullptr, 0);
  ended_ = true;
}

void ServerProcess::HangUpLog() {
  if (log_fd_ >= 0) close(log_fd_);
  log_fd_ = -1;
}

absl::Status ServerProcess::AwaitAddress() {
  std::string line;
  char c = 0;
  while (read(output_fd_, &c, 1) == 1) {
    if (c != '\n') {
      line.push_back(c);
      continue;
    }
    absl::string_view address = line;
    if (absl::ConsumePrefix(&address, kAddressPrefix)) {
      target_ = std::string(address);
      return absl::OkStatus();
    }
    line.clear();
  }
  return absl::UnavailableError("the server ended before it listened");
}

absl::StatusOr<ProcessUsage> ServerProcess::Usage() const {
  const std::string proc = absl::StrCat("/proc/", pid_);
  ProcessUsage usage;
  PLUMESCOUT_ASSIGN_OR_RETURN(usage.cpu_s, Cpu_s(ReadFile(proc + "/stat")));
  const std::string status = ReadFile(proc + "/status");
  PLUMESCOUT_ASSIGN_OR_RETURN(usage.rss_mb, Memory_mb(status, "VmRSS:"));
  PLUMESCOUT_ASSIGN_OR_RETURN(usage.peak_rss_mb, Memory_mb(status, "VmHWM:"));
  return usage;
}

std::string SiblingProgram(const std::string& name) {
  return std::filesystem::read_symlink("/proc/self/exe").replace_filename(name).string();
}

std::optional<std::string> DefaultOf(const std::string& server_program, const std::string& key) {
  FILE* const help = popen(absl::StrCat("'", server_program, "' --help").c_str(), "r");
  if (help == nullptr) return std::nullopt;
  std::string text;
  std::array<char, 4096> piece{};
  while (const std::size_t count = fread(piece.data(), 1, piece.size(), help)) {
    text.append(piece.data(), count);
  }
  pclose(help);
  const std::string prefix = absl::StrCat("  ", key, " = ");
  for (absl::string_view line : absl::StrSplit(text, '\n')) {
    if (absl::ConsumePrefix(&line, prefix)) return std::string(line);
  }
  return std::nullopt;
}

}  // namespace plumescout::lab
