// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/e2e/server_program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>

#include "absl/strings/numbers.h"
#include "absl/strings/string_view.h"
#include "absl/strings/strip.h"
#include "tests/support/program_path.h"

namespace plumescout::e2e {

ServerProgram::ServerProgram(std::vector<std::string> arguments, int stderr_fd) {
  // Missions are kept only where a test says.
  arguments.insert(arguments.begin(), {support::ProgramPath("plumescout-server"), "--listen",
                                       "127.0.0.1:0", "--set", "store.engine=none"});
  std::vector<char*> words;
  for (std::string& argument : arguments) words.push_back(argument.data());
  words.push_back(nullptr);
  std::array<int, 2> output{};
  EXPECT_EQ(pipe2(output.data(), O_CLOEXEC), 0);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, output[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, stderr_fd, STDERR_FILENO);
  EXPECT_EQ(posix_spawn(&pid_, words[0], &actions, nullptr, words.data(), environ), 0);
  posix_spawn_file_actions_destroy(&actions);
  close(output[1]);
  ReadAddresses(output[0]);
  close(output[0]);
}

ServerProgram::~ServerProgram() {
  if (pid_ == 0) return;
  kill(pid_, SIGKILL);
  waitpid(pid_, nullptr, 0);
}

void ServerProgram::ReadAddresses(int stdout_fd) {
  std::string line;
  char c = 0;
  while (target_.empty() && read(stdout_fd, &c, 1) == 1) {
    if (c != '\n') {
      line.push_back(c);
      continue;
    }
    absl::string_view address = line;
    if (absl::ConsumePrefix(&address, "metrics on ")) {
      EXPECT_TRUE(absl::SimpleAtoi(address.substr(address.rfind(':') + 1), &http_port_)) << line;
    } else if (absl::ConsumePrefix(&address, "console on ")) {
      EXPECT_TRUE(absl::SimpleAtoi(address.substr(address.rfind(':') + 1), &console_port_)) << line;
    } else if (absl::ConsumePrefix(&address, "listening on ")) {
      target_ = std::string(address);
    }
    line.clear();
  }
}

void ServerProgram::Terminate() { kill(pid_, SIGTERM); }

std::optional<int> ServerProgram::AwaitExit(absl::Duration patience) {
  const int process_fd = static_cast<int>(syscall(SYS_pidfd_open, pid_, 0));
  pollfd ended{process_fd, POLLIN, 0};
  const int count = poll(&ended, 1, static_cast<int>(absl::ToInt64Milliseconds(patience)));
  close(process_fd);
  if (count != 1) return std::nullopt;
  int status = 0;
  waitpid(pid_, &status, 0);
  pid_ = 0;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace plumescout::e2e
