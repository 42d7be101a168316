// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/robot_notices.h"

#include <algorithm>
#include <chrono>
#include <utility>
#include <variant>

#include "absl/strings/str_cat.h"
#include "core/mission/conduct/conduct_errors.h"
#include "core/types/status_macros.h"
#include "server/base/errors.h"

namespace plumescout::server {
namespace {

constexpr std::int64_t kNoLease = 0;  // tokens are above it

}  // namespace

absl::Status RobotNotices::Join(const std::shared_ptr<RobotWatcher>& watcher, const RobotId& robot,
                                std::optional<std::int64_t> lease_token, Submit submit,
                                const Belief& belief, const LeaseTable& leases,
                                MissionState state) {
  if (belief.robots.count(robot) == 0) return RobotNotFound(robot);
  if (lease_token) PLUMESCOUT_RETURN_IF_ERROR(leases.Check(robot, *lease_token));
  absl::MutexLock lock(&mutex_);
  PLUMESCOUT_RETURN_IF_ERROR(CheckRoom(robot, lease_token.has_value()));
  state_ = state;
  book_.Follow(belief);
  leased_[robot] = leases.Standing(robot).held;
  Place place{watcher, robot, lease_token, std::move(submit), {}};
  place.standing = StandingOf(place);
  PlanNews plan = book_.PlanNewsOf(robot);
  place.invalidated = std::move(plan.invalidated);
  place.assigned = plan.assigned;
  places_[watcher.get()] = std::move(place);
  return absl::OkStatus();
}

absl::Status RobotNotices::CheckRoom(const RobotId& robot, bool has_lease) const {
  const auto count = std::count_if(places_.begin(), places_.end(), [&](const auto& entry) {
    return entry.second.robot == robot && entry.second.lease_token.has_value() == has_lease;
  });
  if (count < max_per_robot_) return absl::OkStatus();
  return LimitReached(absl::StrCat(
      "robot ", robot, " is watched by limits.max_watchers_per_robot = ", max_per_robot_,
      " streams with", has_lease ? "" : "out", " its lease"));
}

void RobotNotices::Leave(const RobotWatcher* watcher) {
  absl::MutexLock lock(&mutex_);
  places_.erase(watcher);
}

std::optional<RobotNotice> RobotNotices::Next(const RobotWatcher* watcher) {
  absl::MutexLock lock(&mutex_);
  const auto found = places_.find(watcher);
  if (found == places_.end()) return std::nullopt;
  Place& place = found->second;
  if (std::exchange(place.standing_is_news, false)) return place.standing;
  if (place.invalidated) return *std::exchange(place.invalidated, std::nullopt);
  if (place.assigned) return *std::exchange(place.assigned, std::nullopt);
  return std::nullopt;
}

int RobotNotices::watcher_count() const {
  absl::MutexLock lock(&mutex_);
  return static_cast<int>(places_.size());
}

void RobotNotices::Follow(const LeaseTable& leases, MissionState state) {
  Woken woken;
  std::vector<std::pair<std::shared_ptr<RobotWatcher>, absl::Status>> ended;
  {
    absl::MutexLock lock(&mutex_);
    state_ = state;
    for (auto place = places_.begin(); place != places_.end();) {
      const RobotId& robot = place->second.robot;
      const std::optional<std::int64_t> token = place->second.lease_token;
      const absl::Status status = leases.Check(robot, token.value_or(kNoLease));
      leased_[robot] = leases.Standing(robot).held;
      if (status.ok() || (!token && !absl::IsNotFound(status))) {
        ++place;
        continue;
      }
      if (auto watcher = place->second.watcher.lock()) ended.emplace_back(watcher, status);
      place = places_.erase(place);
    }
    UpdateStandings(woken);
  }
  for (const auto& [watcher, status] : ended) watcher->End(status);
  for (const auto& watcher : woken) watcher->Wake();
}

SteadyTime RobotNotices::next_follow(const LeaseTable& leases, SteadyTime now) const {
  absl::MutexLock lock(&mutex_);
  absl::Duration left = absl::InfiniteDuration();
  for (const auto& [key, place] : places_) {
    const auto leased = leased_.find(place.robot);
    const bool was_told = leased == leased_.end() || !leased->second;
    if (!was_told) left = std::min(left, leases.TimeLeft(place.robot));
  }
  return After(now, left);
}

SteadyTime RobotNotices::next_look(std::int64_t revision) const {
  absl::MutexLock lock(&mutex_);
  const bool idle = places_.empty() || revision == looked_at_;
  return idle ? SteadyTime::max() : SteadyTime(std::chrono::nanoseconds(book_.next_look_ns()));
}

void RobotNotices::Look(BeliefPtr belief, SteadyTime now) {
  Woken woken;
  {
    absl::MutexLock lock(&mutex_);
    if (places_.empty()) return;
    book_.NoteLook(ToNanoseconds(now));
    book_.Follow(*belief);
    UpdateStandings(woken);
    if (!is_looking_) {
      const Submit& submit = places_.begin()->second.submit;
      is_looking_ = submit([self = shared_from_this(), belief] { self->LookAtPlans(belief); }).ok();
      if (is_looking_) looked_at_ = belief->revision;
    }
  }
  for (const auto& watcher : woken) watcher->Wake();
}

void RobotNotices::LookAtPlans(const BeliefPtr& belief) {
  const std::vector<PlanWatch::News> news = plan_watch_.Look(*belief);
  Tell(news);
  absl::MutexLock lock(&mutex_);
  is_looking_ = false;
}

void RobotNotices::Tell(const std::vector<PlanWatch::News>& news) {
  Woken woken;
  {
    absl::MutexLock lock(&mutex_);
    for (const PlanWatch::News& one : news) {
      const auto* invalidated = std::get_if<PlanInvalidated>(&one.notice);
      const auto* assigned = std::get_if<PlanAssigned>(&one.notice);
      if (invalidated != nullptr) metrics_.NotePlanInvalidated(invalidated->reason);
      book_.Note(one.robot, one.notice);
      for (auto& [key, place] : places_) {
        if (place.robot != one.robot) continue;
        if (invalidated != nullptr) place.invalidated = *invalidated;
        if (assigned != nullptr) place.assigned = *assigned;
        if (auto watcher = place.watcher.lock()) woken.push_back(std::move(watcher));
      }
    }
  }
  for (const auto& watcher : woken) watcher->Wake();
}

RobotStanding RobotNotices::StandingOf(const Place& place) const {
  RobotStanding standing = book_.StandingOf(place.robot);
  standing.paused = state_ == MissionState::kPaused;
  standing.finished = state_ == MissionState::kFinished;
  const auto leased = leased_.find(place.robot);
  standing.leased = leased != leased_.end() && leased->second;
  return standing;
}

void RobotNotices::UpdateStandings(Woken& woken) {
  for (auto& [key, place] : places_) {
    const RobotStanding standing = StandingOf(place);
    if (standing == place.standing) continue;
    place.standing = standing;
    place.standing_is_news = true;
    if (auto watcher = place.watcher.lock()) woken.push_back(std::move(watcher));
  }
}

}  // namespace plumescout::server
