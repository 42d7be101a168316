// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <utility>

#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "core/mission/conduct/team_commit.h"
#include "core/plan/team/team_plan.h"
#include "server/base/clock.h"
#include "server/base/fair_pool.h"
#include "server/missions/commit_guard.h"
#include "server/missions/mission_host.h"

namespace plumescout::server {

// An operator's wish for plans for a team.
struct TeamOrder {
  TeamRequest request = {};
  absl::Duration budget = absl::Seconds(1);  // for all searches
  SteadyTime deadline = SteadyTime::max();   // of everything, the reply's way back left out
};

// One order on its way: search on a pool, commit one plan after the other, wait for the disk. What
// is refused at its commit is left out. Keeps itself alive while it runs; ends with its mission, at
// once, whatever the search does. Thread-safe.
class TeamJob : public std::enable_shared_from_this<TeamJob> {
 public:
  using Done = std::function<void(absl::StatusOr<CommittedTeam>)>;

  struct Parts {
    std::shared_ptr<MissionHost> host;
    FairPool* pool = nullptr;  // not owned; outlives the job
    TeamOrder order;
    Done done;  // called exactly once, on any thread
    // In place of `done`: plans that are not durable in time. Null: `done` hears.
    std::function<void(CommittedTeam, const absl::Status& durable)> late = nullptr;
  };
  explicit TeamJob(Parts parts) : parts_(std::move(parts)) {}

  void Start();
  // Answers at once, and stops the search soon, unless something is committed already: then all
  // goes on, for whoever asks again. Otherwise nothing is committed after it.
  void Cancel();

 private:
  void AwaitBelief();
  void Enqueue(std::shared_ptr<const Belief> belief);
  void Search(const Belief& belief);
  void Commit(TeamPlan team);
  void AnswerAfter(CommittedTeam answer, const absl::Status& durable);
  // True for the first only: its answer counts.
  bool TakeAnswer();
  void Finish(absl::StatusOr<CommittedTeam> answer);

  const Parts parts_;
  std::atomic<bool> answered_ = false;
  CommitGuard guard_;
  std::atomic<EndListeners::Id> listener_ = 0;  // at the host
};

}  // namespace plumescout::server
