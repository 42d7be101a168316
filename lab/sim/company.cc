// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/company.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumescout::lab {

Company::Company(int robots, bool lockstep)
    : lockstep_(lockstep),
      members_(static_cast<std::size_t>(robots)),
      closest_m_(std::numeric_limits<double>::infinity()) {}

void Company::AwaitTurn(int robot, std::int64_t time_ns) {
  absl::MutexLock lock(&mutex_);
  members_[static_cast<std::size_t>(robot)].time_ns = time_ns;
  if (!lockstep_) return;
  const auto mine = [this, robot]() ABSL_SHARED_LOCKS_REQUIRED(mutex_) { return IsTurnOf(robot); };
  mutex_.Await(absl::Condition(&mine));
}

void Company::Leave(int robot) {
  absl::MutexLock lock(&mutex_);
  members_[static_cast<std::size_t>(robot)].left = true;
}

void Company::Stand(int robot, const Body& body) {
  absl::MutexLock lock(&mutex_);
  const auto index = static_cast<std::size_t>(robot);
  members_[index].body = body;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (i == index || !members_[i].body) continue;
    closest_m_ = std::min(closest_m_, Distance_m(body.center, members_[i].body->center));
  }
}

bool Company::MayMoveTo(int robot, Point2 center, std::int64_t now_ns) {
  absl::MutexLock lock(&mutex_);
  Member& me = members_[static_cast<std::size_t>(robot)];
  if (now_ns < me.held_until_ns) return false;
  if (!me.body) return true;
  for (Member& other : members_) {
    if (&other == &me || !other.body) continue;
    const double next_m = Distance_m(center, other.body->center);
    const bool nearer = next_m < Distance_m(me.body->center, other.body->center);
    if (!nearer || next_m >= me.body->radius_m + other.body->radius_m) continue;
    constexpr double kNanosecondsPerSecond = 1e9;
    me.held_until_ns = now_ns + std::llround(kContactPause_s * kNanosecondsPerSecond);
    other.held_until_ns = me.held_until_ns;
    ++contacts_;
    return false;
  }
  return true;
}

int Company::contacts() const {
  absl::MutexLock lock(&mutex_);
  return contacts_;
}

std::vector<Body> Company::Others(int robot) const {
  absl::MutexLock lock(&mutex_);
  std::vector<Body> others;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (i != static_cast<std::size_t>(robot) && members_[i].body) {
      others.push_back(*members_[i].body);
    }
  }
  return others;
}

double Company::Nearest_m(int robot) const {
  absl::MutexLock lock(&mutex_);
  const auto index = static_cast<std::size_t>(robot);
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (i == index || !members_[i].body || !members_[index].body) continue;
    nearest_m =
        std::min(nearest_m, Distance_m(members_[index].body->center, members_[i].body->center));
  }
  return nearest_m;
}

double Company::closest_m() const {
  absl::MutexLock lock(&mutex_);
  return closest_m_;
}

bool Company::IsTurnOf(int robot) const {
  const Member& me = members_[static_cast<std::size_t>(robot)];
  for (int i = 0; i < static_cast<int>(members_.size()); ++i) {
    const Member& other = members_[static_cast<std::size_t>(i)];
    if (i == robot || other.left) continue;
    const bool before = i < robot ? other.time_ns <= me.time_ns : other.time_ns < me.time_ns;
    if (before) return false;
  }
  return true;
}

}  // namespace plumescout::lab
