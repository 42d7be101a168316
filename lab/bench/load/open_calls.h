// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "absl/time/time.h"
#include "client/planner_client.h"
#include "core/types/ids.h"

namespace plumescout::lab {

// Calls without deadline that are under way, over a connection of their own.
class OpenCalls {
 public:
  // Checks of a way on a belief that will never be: with numbers that the robot has not sent.
  static std::unique_ptr<OpenCalls> WaitForLog(const std::string& target,
                                               const client::RobotSession& session, int count);
  // Plans that may take `budget`.
  static std::unique_ptr<OpenCalls> Plan(const std::string& target,
                                         const client::RobotSession& session, int count,
                                         absl::Duration budget);
  // Maps with the posterior brought up to date.
  static std::unique_ptr<OpenCalls> ReadFreshMap(const std::string& target,
                                                 const MissionId& mission, int count);

  // Cancels what is under way and waits for its end.
  ~OpenCalls();
  OpenCalls(const OpenCalls&) = delete;
  OpenCalls& operator=(const OpenCalls&) = delete;

  void Cancel();
  int ended() const;
  // Whether all calls have ended within `timeout`.
  bool AwaitEnd(absl::Duration timeout) const;

 private:
  struct State;

  explicit OpenCalls(const std::string& target);

  const std::unique_ptr<State> state_;
};

}  // namespace plumescout::lab
