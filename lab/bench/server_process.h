// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <memory>
#include <string>

#include "absl/status/statusor.h"

namespace plumescout::lab {

// What a process has used so far.
struct ProcessUsage {
  double cpu_s = 0.0;        // all threads, user and system
  double peak_rss_mb = 0.0;  // 2^20 bytes
};

// A plumescout-server in a process of its own, so that its figures are the server's alone.
class ServerProcess {
  struct Private {
    explicit Private() = default;
  };

 public:
  ServerProcess(Private, pid_t pid, int output_fd) : pid_(pid), output_fd_(output_fd) {}
  // Starts `program` on a free port of the loopback interface and waits until it listens.
  // kNotFound if there is no such program; kUnavailable if it ends instead.
  static absl::StatusOr<std::unique_ptr<ServerProcess>> Start(const std::string& program);
  // Stops the server and waits for its end.
  ~ServerProcess();
  ServerProcess(const ServerProcess&) = delete;
  ServerProcess& operator=(const ServerProcess&) = delete;

  const std::string& target() const { return target_; }  // host:port
  absl::StatusOr<ProcessUsage> Usage() const;

 private:
  absl::Status AwaitAddress();

  const pid_t pid_;
  const int output_fd_;
  std::string target_;
};

// The program `name` beside the one that runs.
std::string SiblingProgram(const std::string& name);

}  // namespace plumescout::lab
