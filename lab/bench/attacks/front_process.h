// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <memory>
#include <string>

#include "absl/status/statusor.h"

namespace plumescout::lab {

// HAProxy with a configuration of ours, but without TLS: its listener is a free port of the
// loopback interface.
class FrontProcess {
  struct Private {
    explicit Private() = default;
  };

 public:
  FrontProcess(Private, pid_t pid, const std::string& target, const std::string& config_path)
      : pid_(pid), target_(target), config_path_(config_path) {}
  // Starts it before `server` and waits until it listens. kUnavailable if it does not, as where
  // there is no HAProxy.
  static absl::StatusOr<std::unique_ptr<FrontProcess>> Start(const std::string& config,
                                                             const std::string& server);
  ~FrontProcess();
  FrontProcess(const FrontProcess&) = delete;
  FrontProcess& operator=(const FrontProcess&) = delete;

  const std::string& target() const { return target_; }

 private:
  const pid_t pid_;
  const std::string target_;
  const std::string config_path_;
};

}  // namespace plumescout::lab
