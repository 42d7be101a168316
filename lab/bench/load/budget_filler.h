// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "client/planner_client.h"
#include "core/types/ids.h"

namespace plumescout::lab {

// Makes a server hold as much as it allows: missions until there is room for none, each filled
// until it refuses more, in one of the ways in which missions grow. Then those who look on and read
// nothing.
class BudgetFiller {
 public:
  // What becomes full.
  enum class Way { kKnownMap, kFarScans, kScatteredReadings, kSeveralGases };
  static constexpr std::size_t kWays = 4;

  // `go_on` is asked between requests.
  BudgetFiller(const std::string& target, std::function<bool()> go_on);
  ~BudgetFiller();

  // From `first` on, one way after another. Returns how many missions there was room for.
  int Fill(Way first);
  // Plans and maps of every mission, and watchers that read nothing.
  void Look();
  // All missions and watchers are gone.
  void Clear();

  double requests() const { return requests_; }
  double refused() const { return refused_; }

 private:
  struct UnreadWatch;

  absl::Status Make(const MissionId& mission, Way way);
  void Fill(const client::RobotSession& session, Way way);
  bool Send(const client::RobotSession& session, const std::vector<Observation>& batch);
  bool Took(const absl::Status& status);

  const std::string target_;
  const std::function<bool()> go_on_;
  const std::unique_ptr<client::PlannerClient> client_;
  std::vector<client::RobotSession> sessions_;
  std::vector<std::unique_ptr<UnreadWatch>> watches_;
  int made_ = 0;
  double requests_ = 0.0;
  double refused_ = 0.0;
};

}  // namespace plumescout::lab
