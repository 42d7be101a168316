// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/time/time.h"

namespace plumescout::lab {

// What a process has used so far.
struct ProcessUsage {
  double cpu_s = 0.0;        // all threads, user and system
  double rss_mb = 0.0;       // 2^20 bytes, now
  double peak_rss_mb = 0.0;  // at most so far
};

struct ServerStart {
  std::string program;
  std::vector<std::string> settings = {};             // KEY=VALUE, as of --set
  std::optional<int> max_descriptors = std::nullopt;  // soft limit, which the server may raise
  bool log_unread = false;  // its log goes into a pipe that nobody reads; else to nowhere
};

// A plumescout-server in a process of its own, so that its figures are the server's alone.
class ServerProcess {
  struct Private {
    explicit Private() = default;
  };

 public:
  ServerProcess(Private, pid_t pid, int output_fd, int log_fd)
      : pid_(pid), output_fd_(output_fd), log_fd_(log_fd) {}
  // Starts `program` on a free port of the loopback interface and waits until it listens.
  // kNotFound if there is no such program; kUnavailable if it ends instead.
  static absl::StatusOr<std::unique_ptr<ServerProcess>> Start(const ServerStart& start);
  // Stops the server, by force if need be, and waits for its end.
  ~ServerProcess();
  ServerProcess(const ServerProcess&) = delete;
  ServerProcess& operator=(const ServerProcess&) = delete;

  const std::string& target() const { return target_; }  // host:port
  // kUnavailable once the server has ended.
  absl::StatusOr<ProcessUsage> Usage() const;
  bool IsAlive();
  // Asks the server to stop and returns how long it took. After `patience` it is killed:
  // kDeadlineExceeded. kUnavailable if it had ended before.
  absl::StatusOr<absl::Duration> Stop(absl::Duration patience);
  // Ends it as a crash would.
  void Kill();
  // Whoever might have read the log is gone.
  void HangUpLog();

 private:
  absl::Status AwaitAddress();

  const pid_t pid_;
  const int output_fd_;
  int log_fd_;  // -1: none
  bool ended_ = false;
  std::string target_;
};

// The program `name` beside the one that runs.
std::string SiblingProgram(const std::string& name);

// The default of an option, as the server's help tells it; nothing if there is no such option.
std::optional<std::string> DefaultOf(const std::string& server_program, const std::string& key);

}  // namespace plumescout::lab
