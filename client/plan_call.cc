// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/plan_call.h"

#include <utility>

#include "absl/time/clock.h"
#include "client/error_reason.h"
#include "core/types/status_macros.h"

namespace plumescout::client {
namespace {

absl::Status ReportOfJob(PlannerClient& client, IngestSession& ingest, const PlanCall& job) {
  PLUMESCOUT_RETURN_IF_ERROR(ingest.WaitApplied(job.query.min_applied_sequence, job.query.timeout));
  return MakeReport(client, ingest.session(), *job.report);
}

}  // namespace

absl::Status MakeReport(PlannerClient& client, const RobotSession& session,
                        const PlanReport& report) {
  const absl::Status status = client.ReportProgress(session, report.plan, report.outcome);
  const bool lease_lost = ErrorReason(status) == kLeaseSuperseded;
  return IsRetriable(status) || lease_lost ? status : absl::OkStatus();
}

PlanReply RunPlanCall(PlannerClient& client, IngestSession& ingest, PlanCall job) {
  PlanReply answer;
  if (job.report.has_value()) {
    if (absl::Status status = ReportOfJob(client, ingest, job); !status.ok()) {
      answer.plan = std::move(status);
      return answer;
    }
    answer.reported = true;
  }
  const RobotSession session = ingest.session();
  job.query.lease_token = session.lease_token;
  const absl::Time start = absl::Now();
  answer.plan = client.NextBestTrajectory(session.mission, job.query);
  answer.rpc_wall = absl::Now() - start;
  return answer;
}

bool MayAskAgain(const absl::Status& status) {
  return IsRetriable(status) || absl::IsNotFound(status) || absl::IsFailedPrecondition(status);
}

}  // namespace plumescout::client
