// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "client/planner_client.h"
#include "lab/local/local_mission.h"

namespace plumescout::lab {

// A watch within the process. The mission's plans are looked at when a robot reads, so robots that
// act one at a time are told the same in every run.
class LocalRobotWatch final : public client::RobotWatch {
 public:
  LocalRobotWatch(std::shared_ptr<LocalMission> mission, const client::RobotSession& session)
      : mission_(std::move(mission)), robot_(session.robot), lease_token_(session.lease_token) {}

  absl::StatusOr<RobotNotice> Read(absl::Duration timeout) override;
  void Cancel() override;

 private:
  // The first of the news that was not told yet.
  std::optional<RobotNotice> FirstOf(const RobotNews& news);

  const std::shared_ptr<LocalMission> mission_;
  const RobotId robot_;
  const std::int64_t lease_token_;
  std::atomic<bool> cancelled_ = false;
  RobotNews told_;
};

}  // namespace plumescout::lab
