// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/map_judge.h"

#include <algorithm>
#include <utility>

#include "absl/time/clock.h"
#include "absl/time/time.h"
#include "core/types/status_macros.h"

namespace plumescout::lab {
namespace {

// How long a map is waited for that holds what the planner has acknowledged, and between looks.
constexpr absl::Duration kMapPatience = absl::Seconds(10);
constexpr absl::Duration kMapPause = absl::Milliseconds(2);

std::int64_t AppliedSequence(const MapSnapshot& map, const RobotId& robot) {
  const auto state = std::find_if(map.robots.begin(), map.robots.end(),
                                  [&](const RobotState& r) { return r.id == robot; });
  return state == map.robots.end() ? 0 : state->applied_sequence;
}

bool Holds(const MapSnapshot& map, const AppliedSequences& least) {
  return std::all_of(least.begin(), least.end(), [&](const auto& robot) {
    return AppliedSequence(map, robot.first) >= robot.second;
  });
}

}  // namespace

absl::StatusOr<MapSnapshot> AwaitMap(client::PlannerClient& planner, const MissionId& mission,
                                     const AppliedSequences& least) {
  const absl::Time give_up = absl::Now() + kMapPatience;
  while (true) {
    absl::StatusOr<MapSnapshot> map = planner.GetMap(mission);
    if (map.ok() && Holds(*map, least)) return map;
    const absl::Status why =
        map.ok() ? absl::UnavailableError("the map lags behind") : map.status();
    const bool may_come = absl::IsUnavailable(why) || absl::IsNotFound(why);
    if (!may_come || absl::Now() > give_up) return why;
    absl::SleepFor(kMapPause);
  }
}

MapJudge::MapJudge(client::PlannerClient& planner, MissionId mission, double period_s,
                   MapEvaluator evaluator, Listener listener)
    : planner_(planner),
      mission_(std::move(mission)),
      period_s_(period_s),
      evaluator_(std::move(evaluator)),
      listener_(std::move(listener)) {}

void MapJudge::TakeIfDue(double time_s, const AppliedSequences& least) {
  absl::MutexLock lock(&mutex_);
  const double due_s = static_cast<double>(samples_.size()) * period_s_;
  if (time_s < due_s || !status_.ok()) return;
  status_ = TakeLocked(time_s, least);
}

absl::Status MapJudge::Take(double time_s, const AppliedSequences& least) {
  absl::MutexLock lock(&mutex_);
  return TakeLocked(time_s, least);
}

absl::Status MapJudge::status() const {
  absl::MutexLock lock(&mutex_);
  return status_;
}

std::vector<MetricSample> MapJudge::samples() const {
  absl::MutexLock lock(&mutex_);
  return samples_;
}

absl::Status MapJudge::TakeLocked(double time_s, const AppliedSequences& least) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const MapSnapshot map, AwaitMap(planner_, mission_, least));
  samples_.push_back({time_s, map.revision, evaluator_.Evaluate(map)});
  if (listener_) listener_(samples_.back(), map);
  return absl::OkStatus();
}

}  // namespace plumescout::lab
