// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "client/robot_loop.h"
#include "client/robot_observer.h"

namespace plumescout::client {

// Says on standard error what happens to a robot, in lines that begin with the program's name.
// Thread-safe.
class RobotNarrator : public RobotObserver {
 public:
  using Listener = std::function<void(bool is_warning, const std::string& line)>;

  // `listener`, who may be none, hears what is said, without the program's name.
  explicit RobotNarrator(std::string program, Listener listener = nullptr)
      : program_(std::move(program)), listener_(std::move(listener)) {}

  void OnPlan(const PlanArrival& arrival) override;
  void OnReport(PlanId plan, ProgressOutcome outcome) override;
  void OnPlanFailure(const absl::Status& status) override;
  void OnPlaceDoubted(bool doubted) override;
  void OnRejected(const ObservationRejected& rejected) override;
  void OnLink(const absl::Status& status) override;
  void OnRolledBack(std::int64_t applied_sequence, std::int64_t forgotten) override;
  void OnDisk(const absl::Status& status) override;

  void Say(const std::string& text) const { Tell(/*is_warning=*/false, text); }
  void Warn(const std::string& text) const { Tell(/*is_warning=*/true, text); }
  void SayResult(const RobotResult& result) const;
  const std::string& program() const { return program_; }

 private:
  void Tell(bool is_warning, const std::string& text) const;

  const std::string program_;
  const Listener listener_;
};

}  // namespace plumescout::client
