// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/server_process.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <vector>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "absl/strings/strip.h"
#include "core/types/status_macros.h"

namespace plumescout::lab {
namespace {

constexpr char kAddressPrefix[] = "listening on ";
constexpr double kKibPerMb = 1024.0;

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

absl::StatusOr<double> PeakRss_mb(const std::string& status) {
  for (absl::string_view line : absl::StrSplit(status, '\n')) {
    double kib = 0.0;
    if (absl::ConsumePrefix(&line, "VmHWM:") && absl::ConsumeSuffix(&line, "kB") &&
        absl::SimpleAtod(line, &kib)) {
      return kib / kKibPerMb;
    }
  }
  return absl::InternalError("/proc/PID/status has no VmHWM");
}

}  // namespace

absl::StatusOr<std::unique_ptr<ServerProcess>> ServerProcess::Start(const std::string& program) {
  if (access(program.c_str(), X_OK) != 0) {
    return absl::NotFoundError(absl::StrCat(program, " is not a program"));
  }
  std::array<int, 2> output{};
  if (pipe2(output.data(), O_CLOEXEC) != 0) return absl::ResourceExhaustedError("no pipe");
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, output[1], STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  std::string name = program;
  std::string flag = "--listen";
  std::string address = "127.0.0.1:0";
  std::array<char*, 4> arguments = {name.data(), flag.data(), address.data(), nullptr};
  pid_t pid = 0;
  const int error =
      posix_spawn(&pid, program.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(output[1]);
  if (error != 0) {
    close(output[0]);
    return absl::ErrnoToStatus(error, program);
  }
  auto server = std::make_unique<ServerProcess>(Private(), pid, output[0]);
  PLUMESCOUT_RETURN_IF_ERROR(server->AwaitAddress());
  return server;
}

ServerProcess::~ServerProcess() {
  kill(pid_, SIGTERM);
  waitpid(pid_, nullptr, 0);
  close(output_fd_);
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
  PLUMESCOUT_ASSIGN_OR_RETURN(usage.peak_rss_mb, PeakRss_mb(ReadFile(proc + "/status")));
  return usage;
}

std::string SiblingProgram(const std::string& name) {
  return std::filesystem::read_symlink("/proc/self/exe").replace_filename(name).string();
}

}  // namespace plumescout::lab
