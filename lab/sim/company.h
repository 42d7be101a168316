// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/synchronization/mutex.h"
#include "lab/sim/lidar.h"

namespace plumescout::lab {

// Whom a robot runs into is as startled as itself.
inline constexpr double kContactPause_s = 1.0;

// Robots that share one world, each on a thread of its own: whose turn it is, and where the others
// stand. In lockstep the robot whose clock is furthest behind acts, the first of them if several
// are, and all others wait; so what they do comes in one order, that of simulated time, however
// threads are scheduled. Thread-safe.
class Company {
 public:
  // robots >= 1. Not in lockstep: nobody waits for anybody.
  Company(int robots, bool lockstep);

  // This robot has nothing more to do before `time_ns` of the shared clock. Returns when it is its
  // turn. Times of one robot must not fall.
  void AwaitTurn(int robot, std::int64_t time_ns);
  // It acts no more; the others do not wait for it. Its body stays.
  void Leave(int robot);

  void Stand(int robot, const Body& body);
  // Whether the robot may move its body from where it stands to `center`. Not into another body,
  // unless that leads away from it: then the two are in contact, and neither may move for
  // kContactPause_s. What `now_ns` is compared with are times of the other calls.
  bool MayMoveTo(int robot, Point2 center, std::int64_t now_ns);
  int contacts() const;  // so far
  // All that stand but this one, in the order of the robots.
  std::vector<Body> Others(int robot) const;
  // From this one's centre to the nearest other one's; +infinity without one.
  double Nearest_m(int robot) const;
  // The least distance of two centres so far; +infinity with less than two robots.
  double closest_m() const;

 private:
  struct Member {
    std::int64_t time_ns = 0;
    bool left = false;
    std::optional<Body> body;
    std::int64_t held_until_ns = 0;  // by a contact
  };

  bool IsTurnOf(int robot) const ABSL_SHARED_LOCKS_REQUIRED(mutex_);

  const bool lockstep_;
  mutable absl::Mutex mutex_;
  std::vector<Member> members_ ABSL_GUARDED_BY(mutex_);
  double closest_m_ ABSL_GUARDED_BY(mutex_);
  int contacts_ ABSL_GUARDED_BY(mutex_) = 0;
};

// A robot's place in a company, which outlives it. None: it is alone.
struct Companion {
  Company* company = nullptr;
  int robot = 0;
};

}  // namespace plumescout::lab
