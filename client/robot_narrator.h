// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "client/robot_loop.h"
#include "client/robot_observer.h"

namespace plumescout::client {

// Says on standard error what happens to a robot, in lines that begin with the program's name.
// Thread-safe.
class RobotNarrator : public RobotObserver {
 public:
  explicit RobotNarrator(std::string program) : program_(std::move(program)) {}

  void OnPlan(const PlanArrival& arrival) override;
  void OnReport(PlanId plan, ProgressOutcome outcome) override;
  void OnPlanFailure(const absl::Status& status) override;
  void OnRejected(const ObservationRejected& rejected) override;
  void OnLink(const absl::Status& status) override;
  void OnRolledBack(std::int64_t applied_sequence, std::int64_t forgotten) override;
  void OnDisk(const absl::Status& status) override;

  void Say(const std::string& text) const;
  void SayResult(const RobotResult& result) const;

 private:
  const std::string program_;
};

}  // namespace plumescout::client
