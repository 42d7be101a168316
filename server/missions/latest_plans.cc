// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/latest_plans.h"

#include <algorithm>
#include <utility>

namespace plumescout::server {

void LatestPlans::Note(Plan plan) {
  const RobotId robot = plan.robot;
  auto noted = std::make_shared<const Plan>(std::move(plan));
  const absl::MutexLock lock(&mutex_);
  entries_[robot] = {std::move(noted), ++count_};
  if (entries_.size() <= kMaxRobots) return;
  entries_.erase(std::min_element(
      entries_.begin(), entries_.end(),
      [](const auto& a, const auto& b) { return a.second.noted < b.second.noted; }));
}

void LatestPlans::Forget(const RobotId& robot) {
  const absl::MutexLock lock(&mutex_);
  entries_.erase(robot);
}

std::vector<LatestPlans::PlanPtr> LatestPlans::All() const {
  const absl::MutexLock lock(&mutex_);
  std::vector<PlanPtr> plans;
  for (const auto& [robot, entry] : entries_) plans.push_back(entry.plan);
  return plans;
}

}  // namespace plumescout::server
