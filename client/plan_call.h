// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "client/ingest_session.h"
#include "client/planner_client.h"
#include "core/types/event.h"
#include "core/types/plan.h"

namespace plumescout::client {

// How the last plan ended, still to be told.
struct PlanReport {
  PlanId plan = 0;
  ProgressOutcome outcome = ProgressOutcome::kReached;
};

// What a robot asks of the planner in one go.
struct PlanCall {
  std::optional<PlanReport> report;
  PlanQuery query;  // the lease is filled in when the job runs
};

struct PlanReply {
  absl::StatusOr<Plan> plan;
  bool reported = false;    // the report need not be made again
  absl::Duration rpc_wall;  // of NextBestTrajectory
};

// Tells how a plan ended. A report that the server cannot place (it restarted, or the plan is
// stale) is let go.
absl::Status MakeReport(PlannerClient& client, const RobotSession& session,
                        const PlanReport& report);

// Reports how the last plan ended, once the readings taken on the way are applied, and asks for the
// next.
PlanReply RunPlanCall(PlannerClient& client, IngestSession& ingest, PlanCall job);

// Whether asking again may help: the link is down, the server restarted or has no pose yet. A lease
// that is not in force (LEASE_SUPERSEDED) is for the ingest session to judge: it may have a newer
// one by now, or have ended.
bool MayAskAgain(const absl::Status& status);

}  // namespace plumescout::client
