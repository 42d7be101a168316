// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "client/planner_client.h"
#include "core/types/ids.h"
#include "lab/bench/load/flood.h"

namespace plumescout::lab {

// A process of the lowest priority beside the one that measures. Whoever watches or floods a server
// brings a machine of their own; here they have what CPU the others leave, so that what they cost
// is what they cost the server. One order at a time; not thread-safe.
class Bystander {
  struct Private {
    explicit Private() = default;
  };

 public:
  struct Watch {
    int watchers = 0;
    int without_frame = 0;  // of these, when the patience was over
  };
  struct Watched {
    int sent_away = 0;
    double frames = 0.0;  // of all watchers
  };

  Bystander(Private, pid_t pid, int orders_fd, int answers_fd)
      : pid_(pid), orders_fd_(orders_fd), answers_fd_(answers_fd) {}
  // REQUIRES: the process has no thread but this, and gRPC was not used. kUnavailable.
  static absl::StatusOr<std::unique_ptr<Bystander>> Fork();
  ~Bystander();
  Bystander(const Bystander&) = delete;
  Bystander& operator=(const Bystander&) = delete;

  // Returns once each of them has a frame, or after `patience`. All errors: kUnavailable.
  absl::StatusOr<Watch> BeginWatch(const std::string& target, const MissionId& mission,
                                   int watchers, absl::Duration patience);
  absl::StatusOr<Watched> EndWatch();

  // As Flood, for as long as `time`.
  absl::StatusOr<FloodFigures> RunFlood(const std::string& target,
                                        const client::RobotSession& session,
                                        const FloodOptions& options, absl::Duration time);

 private:
  // Numbers as many as `count`.
  absl::StatusOr<std::vector<double>> Ask(const std::string& order, std::size_t count);

  const pid_t pid_;
  const int orders_fd_;
  const int answers_fd_;
};

}  // namespace plumescout::lab
