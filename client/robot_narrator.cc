// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/robot_narrator.h"

#include <cstdio>

#include "absl/strings/str_cat.h"

namespace plumescout::client {

void RobotNarrator::OnPlan(const PlanArrival& arrival) {
  Say(absl::StrCat("plan ", arrival.plan.id, " at ", arrival.elapsed_s,
                   " s: ", arrival.plan.explanation));
}

void RobotNarrator::OnReport(PlanId plan, ProgressOutcome outcome) {
  const char* what = outcome == ProgressOutcome::kReached   ? "reached"
                     : outcome == ProgressOutcome::kBlocked ? "blocked"
                                                            : "given up";
  Say(absl::StrCat("plan ", plan, ": ", what));
}

void RobotNarrator::OnPlanFailure(const absl::Status& status) {
  Warn(absl::StrCat("no plan: ", status.ToString()));
}

void RobotNarrator::OnPlaceDoubted(bool doubted) {
  if (!doubted) return Say("scans fit the map again, or poses were corrected");
  Warn(
      "scans contradict the map: the robot may not be where it says it is, and nothing that it "
      "senses counts until its poses are corrected or its scans fit again");
}

void RobotNarrator::OnRejected(const ObservationRejected& rejected) {
  Warn(absl::StrCat("observation ", rejected.sequence, " refused: ", rejected.status.ToString()));
}

void RobotNarrator::OnLink(const absl::Status& status) {
  if (status.ok()) return Say("link is up");
  Warn(absl::StrCat("link: ", status.ToString()));
}

void RobotNarrator::OnRolledBack(std::int64_t applied_sequence, std::int64_t forgotten) {
  Warn(absl::StrCat("the server was set back: it has ", applied_sequence,
                    " observations of this robot, although it had more; the rest is sent again",
                    forgotten > 0 ? absl::StrCat(", but for ", forgotten, " that are gone") : ""));
}

void RobotNarrator::OnDisk(const absl::Status& status) {
  if (status.ok()) return Say("the log is written to disk again");
  Warn(absl::StrCat("log on disk: ", status.message()));
}

void RobotNarrator::Tell(bool is_warning, const std::string& text) const {
  std::fprintf(stderr, "%s: %s\n", program_.c_str(), text.c_str());
  if (listener_) listener_(is_warning, text);
}

void RobotNarrator::SayResult(const RobotResult& result) const {
  Say(absl::StrCat("done after ", result.elapsed_s, " s: ", result.plans, " plans, ",
                   result.distance_m, " m, ", result.ingest.applied_sequence, " of ",
                   result.ingest.last_sequence, " observations applied, ",
                   result.ingest.durable_sequence, " durable"));
}

}  // namespace plumescout::client
