// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/plan_call.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

#include "client/error_reason.h"
#include "client/join.h"
#include "tests/client/fake_planner_client.h"
#include "tests/client/ingest_traffic.h"

namespace plumescout::client {
namespace plan_call_test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr PlanReport kReached = {.plan = 7, .outcome = ProgressOutcome::kReached};

// A robot in a mission, with `kReadings` of its readings on their way.
class PlanJobTest : public ::testing::Test {
 protected:
  static constexpr int kReadings = 30;

  void SetUp() override {
    server_.Preload(0);
    server_.set_script([this](const PlanQuery& query) {
      queries_.push_back(query);
      return CompletePlan();
    });
    const Participation participation = {.mission = "m", .robot = "r"};
    IngestCallbacks callbacks;
    callbacks.rejoin = [this, participation] { return Join(server_, participation); };
    IngestOptions options;
    options.backoff = {.initial = absl::Milliseconds(1), .maximum = absl::Milliseconds(5)};
    ingest_ = std::make_unique<IngestSession>(server_, *Join(server_, participation),
                                              std::move(callbacks), options);
    for (int i = 0; i < kReadings; ++i) ingest_->Append(i, {}, GasReading{});
  }

  PlanReply Run(std::optional<PlanReport> report, absl::Duration timeout = kPatience) {
    PlanCall job{.report = report, .query = {}};
    job.query.request.robot = "r";
    job.query.min_applied_sequence = kReadings;
    job.query.timeout = timeout;
    return RunPlanCall(server_, *ingest_, std::move(job));
  }

  FakePlannerClient server_;
  std::vector<PlanQuery> queries_;  // that reached the planner
  std::unique_ptr<IngestSession> ingest_;
};

TEST_F(PlanJobTest, ThePlanIsAskedForUnderThePresentLease) {
  const PlanReply answer = Run(std::nullopt);

  ASSERT_TRUE(answer.plan.ok()) << answer.plan.status();
  EXPECT_FALSE(answer.reported);
  EXPECT_GE(answer.rpc_wall, absl::ZeroDuration());
  ASSERT_EQ(queries_.size(), 1U);
  EXPECT_EQ(queries_[0].lease_token, ingest_->session().lease_token);
  EXPECT_THAT(server_.reports(), IsEmpty());
}

TEST_F(PlanJobTest, TheLastPlanIsReportedOnceTheReadingsOfItsWayAreApplied) {
  const PlanReply answer = Run(kReached);

  ASSERT_TRUE(answer.plan.ok()) << answer.plan.status();
  EXPECT_TRUE(answer.reported);
  EXPECT_THAT(server_.reports(),
              ElementsAre(FakePlannerClient::Report{7, ProgressOutcome::kReached, kReadings}));
}

TEST_F(PlanJobTest, AReportThatTheServerCannotPlaceIsLetGo) {
  for (const absl::Status& answer_to_report :
       {absl::NotFoundError("PLAN_NOT_FOUND: plan 7"), absl::FailedPreconditionError("stale")}) {
    server_.set_report_answer(answer_to_report);

    const PlanReply answer = Run(kReached);

    EXPECT_TRUE(answer.plan.ok()) << answer.plan.status();
    EXPECT_TRUE(answer.reported);
  }
}

TEST_F(PlanJobTest, AReportThatDidNotArriveIsKeptAndNoPlanAskedFor) {
  server_.set_report_answer(absl::UnavailableError("busy"));

  const PlanReply answer = Run(kReached);

  EXPECT_TRUE(absl::IsUnavailable(answer.plan.status()));
  EXPECT_FALSE(answer.reported);
  EXPECT_THAT(queries_, IsEmpty());
}

TEST_F(PlanJobTest, ReadingsThatAreNotAppliedInTimeHoldUpTheReport) {
  ASSERT_TRUE(ingest_->WaitApplied(kReadings, kPatience).ok());
  server_.BreakLink();
  ingest_->Append(kReadings, {}, GasReading{});
  PlanCall job{.report = kReached, .query = {}};
  job.query.min_applied_sequence = kReadings + 1;
  job.query.timeout = absl::Milliseconds(20);

  const PlanReply answer = RunPlanCall(server_, *ingest_, std::move(job));

  EXPECT_TRUE(absl::IsDeadlineExceeded(answer.plan.status())) << answer.plan.status();
  EXPECT_FALSE(answer.reported);
  EXPECT_THAT(server_.reports(), IsEmpty());
}

TEST_F(PlanJobTest, ALostLeaseEndsTheJob) {
  ASSERT_TRUE(ingest_->WaitApplied(kReadings, kPatience).ok());
  server_.SupersedeLease();

  EXPECT_EQ(ErrorReason(Run(kReached).plan.status()), kLeaseSuperseded);
  EXPECT_EQ(ErrorReason(Run(std::nullopt).plan.status()), kLeaseSuperseded);
}

TEST_F(PlanJobTest, WhatThePlannerSaysIsPassedOn) {
  server_.set_script([](const PlanQuery&) { return absl::ResourceExhaustedError("too many"); });

  const PlanReply answer = Run(kReached);

  EXPECT_EQ(answer.plan.status(), absl::ResourceExhaustedError("too many"));
  EXPECT_TRUE(answer.reported);  // not to be made again
}

TEST(MayAskAgainTest, AfterWhatMayPassByItself) {
  EXPECT_TRUE(MayAskAgain(absl::UnavailableError("link is down")));
  EXPECT_TRUE(MayAskAgain(absl::DeadlineExceededError("slow")));
  EXPECT_TRUE(MayAskAgain(absl::NotFoundError("ROBOT_NOT_FOUND: the server restarted")));
  EXPECT_TRUE(MayAskAgain(absl::FailedPreconditionError("no pose yet")));
  EXPECT_TRUE(MayAskAgain(absl::UnavailableError("STORE_UNAVAILABLE: the disk is full")));
  EXPECT_TRUE(MayAskAgain(absl::UnavailableError("RECOVERING: 3 missions to go")));
  // The ingest session may have a newer lease by now; if not, it has ended.
  EXPECT_TRUE(MayAskAgain(absl::FailedPreconditionError("LEASE_SUPERSEDED: by another")));
}

TEST(MayAskAgainTest, NotAfterAMistake) {
  EXPECT_FALSE(MayAskAgain(absl::InvalidArgumentError("start.x_m = nan")));
  EXPECT_FALSE(MayAskAgain(absl::PermissionDeniedError("not yours")));
}

}  // namespace plan_call_test
}  // namespace plumescout::client
