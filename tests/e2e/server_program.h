// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

#include "absl/time/time.h"

namespace plumescout::e2e {

// The real plumescout-server in a process of its own, on free ports of loopback.
class ServerProgram {
 public:
  // Starts it with these arguments besides, and `stderr_fd` as its standard error; waits until it
  // listens.
  ServerProgram(std::vector<std::string> arguments, int stderr_fd);
  // Kills it if it still runs.
  ~ServerProgram();
  ServerProgram(const ServerProgram&) = delete;
  ServerProgram& operator=(const ServerProgram&) = delete;

  bool listens() const { return !target_.empty(); }
  const std::string& target() const { return target_; }  // host:port
  int http_port() const { return http_port_; }           // 0: none
  int console_port() const { return console_port_; }     // 0: none

  void Terminate();  // by SIGTERM
  // Its exit code once it has ended, -1 if a signal ended it; nothing if it has not by then.
  std::optional<int> AwaitExit(absl::Duration patience);

 private:
  void ReadAddresses(int stdout_fd);

  pid_t pid_ = 0;
  std::string target_;
  int http_port_ = 0;
  int console_port_ = 0;
};

}  // namespace plumescout::e2e
