// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/plan_job.h"

#include <utility>

#include "absl/time/clock.h"
#include "client/error_reason.h"
#include "core/types/status_macros.h"

namespace plumescout::client {
namespace {

absl::Status Report(PlannerClient& client, IngestSession& ingest, const PlanJob& job) {
  PLUMESCOUT_RETURN_IF_ERROR(ingest.WaitApplied(job.query.min_applied_sequence, job.query.timeout));
  const absl::Status status =
      client.ReportProgress(ingest.session(), job.report->plan, job.report->outcome);
  const bool lease_lost = ErrorReason(status) == kLeaseSuperseded;
  return IsRetriable(status) || lease_lost ? status : absl::OkStatus();
}

}  // namespace

PlanAnswer RunPlanJob(PlannerClient& client, IngestSession& ingest, PlanJob job) {
  PlanAnswer answer;
  if (job.report.has_value()) {
    if (absl::Status status = Report(client, ingest, job); !status.ok()) {
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
  if (ErrorReason(status) == kLeaseSuperseded) return false;
  return IsRetriable(status) || absl::IsNotFound(status) || absl::IsFailedPrecondition(status);
}

}  // namespace plumescout::client
