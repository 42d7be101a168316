// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "core/mission/conduct/commit_race.h"
#include "core/types/plan.h"
#include "core/types/plan_request.h"
#include "server/base/clock.h"
#include "server/base/fair_pool.h"
#include "server/base/stage_times.h"
#include "server/missions/commit_guard.h"
#include "server/missions/mission_host.h"

namespace plumescout::server {

// A robot's wish for a plan.
struct PlanOrder {
  PlanRequest request = {};
  std::int64_t lease_token = 0;
  std::int64_t min_applied_sequence = 0;
  absl::Duration budget = absl::Seconds(1);  // for the search
  SteadyTime deadline = SteadyTime::max();   // of everything, the reply's way back left out
};

struct PlanAnswer {
  Plan plan;                // committed
  absl::Duration cpu_time;  // of all searches
};

// One line for the server's log.
void LogPlan(const MissionId& mission, const PlanAnswer& answer, const std::string& request_id);

// One order on its way: wait for the robot's own readings, search on a pool, commit, wait for the
// disk; once more if another robot claimed the goal in the meantime. A plan that was assigned to
// the robot is answered instead, and nothing is committed. Keeps itself alive while it runs. It
// ends with its mission, at once, whatever the search does. Thread-safe.
class PlanJob : public std::enable_shared_from_this<PlanJob> {
 public:
  using Done = std::function<void(absl::StatusOr<PlanAnswer>)>;

  struct Parts {
    std::shared_ptr<MissionHost> host;
    FairPool* pool = nullptr;  // not owned; outlives the job
    PlanOrder order;
    Done done;                        // called exactly once, on any thread
    PlanListener improved = nullptr;  // told of plans on the way, on a thread of the pool
    std::shared_ptr<StageTimes> stage_times = nullptr;  // told what the order waits for
    // In place of `done`: a plan that is not durable in time. Null: `done` hears.
    std::function<void(PlanAnswer, const absl::Status& durable)> late = nullptr;
  };
  explicit PlanJob(Parts parts) : parts_(std::move(parts)) {}

  void Start();
  // Answers at once, and stops the search soon, unless something is committed already: then all
  // goes on, for whoever asks again. Otherwise nothing is committed after it.
  void Cancel();

 private:
  void AwaitBelief();
  void Enqueue(std::shared_ptr<const Belief> belief);
  void Search(const Belief& belief);
  void Commit(Plan plan);
  void Committed(Plan plan, absl::StatusOr<PlanId> id);
  void AnswerOnceDurable(Plan plan);
  // The stage is over, the next begins.
  void EndStage(Stage stage);
  void AnswerAfter(PlanAnswer answer, const absl::Status& durable);
  // True for the first only: its answer counts.
  bool TakeAnswer();
  void Finish(absl::StatusOr<PlanAnswer> answer);

  const Parts parts_;
  std::atomic<bool> answered_ = false;
  CommitGuard guard_;
  std::atomic<EndListeners::Id> listener_ = 0;  // at the host
  // Touched by one stage at a time; the queues between the stages order them.
  CommitRace race_;
  SteadyTime stage_began_;
  absl::Duration cpu_time_;
};

}  // namespace plumescout::server
