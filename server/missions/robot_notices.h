// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/synchronization/mutex.h"
#include "absl/time/time.h"
#include "core/belief/belief.h"
#include "core/mission/conduct/robot_news_book.h"
#include "core/plan/plan_watch.h"
#include "core/types/robot_notice.h"
#include "server/base/clock.h"
#include "server/missions/lease_table.h"
#include "server/missions/mission_standing.h"
#include "server/observe/mission_metrics.h"

namespace plumescout::server {

// Somebody who watches a robot.
class RobotWatcher {
 public:
  virtual ~RobotWatcher() = default;
  // There may be something for it at RobotNotices::Next. Must not block.
  virtual void Wake() = 0;
  // Nothing comes any more. Must not block.
  virtual void End(const absl::Status& status) = 0;
};

// What those who watch the robots of one mission are to be told. Of each kind of notice a watcher
// has the newest to fetch, so a slow one costs no more than a quick one. Live plans are looked at
// on the watchers' pool, one look at a time, and only while there are watchers; if the pool is
// full, or the look before is not over, that look is made up for later. Thread-safe; nothing
// blocks.
class RobotNotices : public std::enable_shared_from_this<RobotNotices> {
 public:
  using BeliefPtr = std::shared_ptr<const Belief>;
  // Has a task run on a pool; an error if that is full. Must not block.
  using Submit = std::function<absl::Status(std::function<void()>)>;
  // Between looks at the plans.
  static constexpr absl::Duration kLookPeriod = absl::Nanoseconds(RobotNewsBook::kLookPeriod_ns);

  // `metrics` is not owned and outlives the last look. `max_per_robot`: watchers that come with its
  // lease; as many may come without.
  explicit RobotNotices(MissionMetrics* metrics,
                        int max_per_robot = std::numeric_limits<int>::max())
      : metrics_(*metrics), max_per_robot_(max_per_robot) {}

  // The robot's standing, and what is the matter with its plan, are there for the watcher at once.
  // `lease_token`: none: whoever holds it. `submit` is good as long as there are watchers.
  // ROBOT_NOT_FOUND, LEASE_SUPERSEDED, LIMIT_REACHED. Cost: O(watchers).
  absl::Status Join(const std::shared_ptr<RobotWatcher>& watcher, const RobotId& robot,
                    std::optional<std::int64_t> lease_token, Submit submit, const Belief& belief,
                    const LeaseTable& leases, MissionState state) ABSL_LOCKS_EXCLUDED(mutex_);
  void Leave(const RobotWatcher* watcher) ABSL_LOCKS_EXCLUDED(mutex_);
  // The next notice for the watcher; none: it will be woken.
  std::optional<RobotNotice> Next(const RobotWatcher* watcher) ABSL_LOCKS_EXCLUDED(mutex_);
  int watcher_count() const ABSL_LOCKS_EXCLUDED(mutex_);

  // Leases and the mission's state may have changed: ends watchers whose leases are not in force,
  // tells the others. Cost: O(watchers).
  void Follow(const LeaseTable& leases, MissionState state) ABSL_LOCKS_EXCLUDED(mutex_);

  // When Follow will have something to tell though nobody does anything: a lease runs out. Cost: as
  // Follow.
  SteadyTime next_follow(const LeaseTable& leases, SteadyTime now) const
      ABSL_LOCKS_EXCLUDED(mutex_);

  // When a look is due at a mission of this revision; max(): there is nothing new, or nobody to
  // tell.
  SteadyTime next_look(std::int64_t revision) const ABSL_LOCKS_EXCLUDED(mutex_);
  // Takes from the belief how robots stand, and has its plans looked at unless others are just now.
  void Look(BeliefPtr belief, SteadyTime now) ABSL_LOCKS_EXCLUDED(mutex_);

 private:
  struct Place {
    std::weak_ptr<RobotWatcher> watcher;
    RobotId robot;
    std::optional<std::int64_t> lease_token;
    Submit submit = nullptr;
    RobotStanding standing = {};  // the newest
    bool standing_is_news = true;
    std::optional<PlanInvalidated> invalidated = std::nullopt;  // to be fetched, as is the next
    std::optional<PlanAssigned> assigned = std::nullopt;
  };
  using Woken = std::vector<std::shared_ptr<RobotWatcher>>;

  RobotStanding StandingOf(const Place& place) const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  // Brings the places' standings up to date; adds those to whom that is news.
  void UpdateStandings(Woken& woken) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void LookAtPlans(const BeliefPtr& belief) ABSL_LOCKS_EXCLUDED(mutex_);
  void Tell(const std::vector<PlanWatch::News>& news) ABSL_LOCKS_EXCLUDED(mutex_);
  absl::Status CheckRoom(const RobotId& robot, bool has_lease) const
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  MissionMetrics& metrics_;
  const int max_per_robot_;

  mutable absl::Mutex mutex_;
  std::map<const RobotWatcher*, Place> places_ ABSL_GUARDED_BY(mutex_);
  RobotNewsBook book_ ABSL_GUARDED_BY(mutex_);  // for those who come later, too
  std::map<RobotId, bool> leased_ ABSL_GUARDED_BY(mutex_);
  MissionState state_ ABSL_GUARDED_BY(mutex_) = MissionState::kRunning;
  std::int64_t looked_at_ ABSL_GUARDED_BY(mutex_) = 0;  // the revision of the last look
  bool is_looking_ ABSL_GUARDED_BY(mutex_) = false;

  PlanWatch plan_watch_;  // of the look that is under way
};

}  // namespace plumescout::server
