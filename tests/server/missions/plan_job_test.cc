// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/plan_job.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/synchronization/blocking_counter.h"
#include "absl/synchronization/notification.h"
#include "core/types/error_reason.h"
#include "tests/server/host_parts.h"

namespace plumescout::server {
namespace plan_job_test {

constexpr std::int64_t kLease = 7;
constexpr int kPoolThreads = 2;

// One order, and the answer to it.
class PlanJobTest : public testing::Test {
 protected:
  void StartHost(ScriptedStrategy::Script script) { StartHost(HostParts(std::move(script))); }
  void StartHost(MissionHost::Parts parts) {
    host_ = std::make_shared<MissionHost>(std::move(parts), HostOptions{});
    ASSERT_TRUE(host_
                    ->Post([](MissionWriter& writer) {
                      EXPECT_TRUE(writer.conduct().Register({"r1", 0.2, kLease}).ok());
                      EXPECT_TRUE(writer.conduct().Register({"r2", 0.2, kLease + 1}).ok());
                    })
                    .ok());
  }
  void TearDown() override {
    if (host_ != nullptr) host_->Stop(absl::NotFoundError("over"));
  }

  static PlanOrder OrderOf(PlanOrder order) {
    order.request.robot = "r1";
    order.lease_token = kLease;
    return order;
  }
  PlanJob::Done Taker() {
    return [this](absl::StatusOr<PlanAnswer> answer) {
      answer_ = std::move(answer);
      answered_.Notify();
    };
  }
  std::shared_ptr<PlanJob> Start(PlanOrder order) {
    auto job = std::make_shared<PlanJob>(
        PlanJob::Parts{host_, &pool_, OrderOf(std::move(order)), Taker()});
    job->Start();
    return job;
  }
  // Robot r2 gets a plan to (1, 0). Returns when it is committed.
  void TakeGoalForTheOtherRobot() {
    absl::Notification committed;
    const absl::Status posted = host_->Post([&](MissionWriter& writer) {
      EXPECT_TRUE(writer.conduct()
                      .Commit(PlanTo(*writer.conduct().Snapshot(), "r2", 1.0), kLease + 1)
                      .ok());
      committed.Notify();
    });
    ASSERT_TRUE(posted.ok());
    committed.WaitForNotification();
  }
  // Busies every worker, and only then every place in the queue: a worker that took its task later
  // would leave a place free.
  void FillPool() {
    absl::BlockingCounter busy(kPoolThreads);
    for (int i = 0; i < kPoolThreads; ++i) {
      ASSERT_TRUE(pool_
                      .Submit({absl::StrCat("busy", i), ""}, {[&] {
                                busy.DecrementCount();
                                release_.WaitForNotification();
                              }})
                      .ok());
    }
    busy.Wait();
    for (int i = 0; pool_.Submit({absl::StrCat("queued", i), ""}, {[] {}}).ok(); ++i) {
    }
  }
  const absl::StatusOr<PlanAnswer>& Answer() {
    answered_.WaitForNotification();
    return *answer_;
  }

  std::shared_ptr<MissionHost> host_;
  std::optional<absl::StatusOr<PlanAnswer>> answer_;
  absl::Notification answered_;
  absl::Notification release_;  // of tasks that FillPool holds; outlives the pool
  FairPool pool_{{.name = "planning", .threads = kPoolThreads, .max_queued = 4}};
};

ScriptedStrategy::Script DriveTo(double x_m) {
  return [x_m](const Belief& belief, const PlanRequest& request, const StopFn&) {
    return PlanTo(belief, request.robot, x_m);
  };
}

// Never finds anything by itself.
absl::StatusOr<Plan> SearchUntilStopped(const Belief& belief, const PlanRequest& request,
                                        const StopFn& stop) {
  while (!stop()) {
  }
  return PlanTo(belief, request.robot, 1.0);
}

TEST_F(PlanJobTest, AnswersWithACommittedPlan) {
  StartHost(DriveTo(1.0));
  Start({});
  ASSERT_TRUE(Answer().ok()) << Answer().status();
  EXPECT_EQ(Answer()->plan.id, 1);
  EXPECT_EQ(Answer()->plan.robot, "r1");
}

TEST_F(PlanJobTest, PlansOnABeliefThatHoldsTheRobotsReadings) {
  std::atomic<std::int64_t> applied = -1;
  StartHost([&](const Belief& belief, const PlanRequest& request, const StopFn&) {
    applied = belief.robots.at("r1").state.applied_sequence;
    return PlanTo(belief, request.robot, 1.0);
  });
  Start({.min_applied_sequence = 3});
  ASSERT_TRUE(host_
                  ->Post([](MissionWriter& writer) {
                    writer.conduct().Ingest("r1", kLease, GasBatch(1, 3));
                  })
                  .ok());
  ASSERT_TRUE(Answer().ok());
  EXPECT_EQ(applied, 3);
}

TEST_F(PlanJobTest, BudgetStopsTheSearchAndItsResultCounts) {
  StartHost(SearchUntilStopped);
  Start({.budget = absl::Milliseconds(5)});
  EXPECT_TRUE(Answer().ok());
  EXPECT_GT(Answer()->cpu_time, absl::ZeroDuration());
}

TEST_F(PlanJobTest, DeadlineStopsTheSearchBeforeTheBudget) {
  StartHost(SearchUntilStopped);
  Start({.budget = absl::Hours(1), .deadline = SteadyNow() + std::chrono::milliseconds(5)});
  EXPECT_TRUE(Answer().ok());
}

TEST_F(PlanJobTest, PlansOnTheWayAreToldAndNotCommitted) {
  auto parts = HostParts();
  parts.strategy = std::make_unique<const ScriptedStrategy>(
      ScriptedStrategy::AnytimeScript([](const Belief& belief, const PlanRequest& request,
                                         const StopFn&, const PlanListener& improved) {
        improved(PlanTo(belief, request.robot, 5.0));
        return PlanTo(belief, request.robot, 1.0);
      }));
  StartHost(std::move(parts));
  std::vector<Plan> told;
  auto job = std::make_shared<PlanJob>(PlanJob::Parts{
      host_, &pool_, OrderOf({}), Taker(), [&](const Plan& plan) { told.push_back(plan); }});
  job->Start();
  ASSERT_TRUE(Answer().ok()) << Answer().status();
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].id, 0);
  EXPECT_EQ(told[0].candidates[0].goal.position.x_m, 5.0);
  EXPECT_EQ(Answer()->plan.id, 1);
}

TEST_F(PlanJobTest, CancelStopsTheSearchAndCommitsNothing) {
  absl::Notification searching;
  StartHost([&](const Belief& belief, const PlanRequest& request, const StopFn& stop) {
    searching.Notify();
    return SearchUntilStopped(belief, request, stop);
  });
  const auto job = Start({.budget = absl::Hours(1)});
  searching.WaitForNotification();
  job->Cancel();
  EXPECT_TRUE(absl::IsCancelled(Answer().status()));
  host_->Stop(absl::NotFoundError("over"));
  EXPECT_EQ(host_->summary().revision, 2);  // the two registrations
}

TEST_F(PlanJobTest, CancelAnswersThoughTheSearchGoesOn) {
  absl::Notification searching;
  StartHost([&](const Belief& belief, const PlanRequest& request, const StopFn&) {
    searching.Notify();
    release_.WaitForNotification();
    return PlanTo(belief, request.robot, 1.0);
  });
  const auto job = Start({});
  searching.WaitForNotification();
  job->Cancel();
  EXPECT_TRUE(absl::IsCancelled(Answer().status()));
  release_.Notify();
}

TEST_F(PlanJobTest, EndOfTheMissionAnswersThoughTheSearchGoesOn) {
  absl::Notification searching;
  StartHost([&](const Belief& belief, const PlanRequest& request, const StopFn&) {
    searching.Notify();
    release_.WaitForNotification();
    return PlanTo(belief, request.robot, 1.0);
  });
  Start({});
  searching.WaitForNotification();
  host_->EndWaits(absl::UnavailableError("draining"));
  EXPECT_TRUE(absl::IsUnavailable(Answer().status()));
  release_.Notify();
}

TEST_F(PlanJobTest, AnsweredJobsListenToNobody) {
  StartHost(DriveTo(1.0));
  Start({});
  ASSERT_TRUE(Answer().ok());
  EXPECT_EQ(host_->end_listeners().size(), 0);
  // One that is cancelled before it starts does not begin.
  int answers = 0;
  const auto job = std::make_shared<PlanJob>(PlanJob::Parts{
      host_, &pool_, OrderOf({}), [&](const absl::StatusOr<PlanAnswer>&) { ++answers; }});
  job->Cancel();
  job->Start();
  EXPECT_EQ(answers, 1);
  EXPECT_EQ(host_->end_listeners().size(), 0);
}

TEST_F(PlanJobTest, CancelEndsTheWaitForReadings) {
  StartHost(DriveTo(1.0));
  const auto job = Start({.min_applied_sequence = 1000});
  job->Cancel();
  EXPECT_TRUE(absl::IsCancelled(Answer().status()));
}

TEST_F(PlanJobTest, ClaimedGoalIsPlannedOnceMore) {
  std::atomic<int> searches = 0;
  StartHost([&](const Belief& belief, const PlanRequest& request, const StopFn&) {
    if (++searches == 1) TakeGoalForTheOtherRobot();
    return PlanTo(belief, request.robot, belief.claims.empty() ? 1.0 : 5.0);
  });
  Start({});
  ASSERT_TRUE(Answer().ok()) << Answer().status();
  EXPECT_EQ(searches, 2);
  EXPECT_EQ(Answer()->plan.candidates[0].goal.position.x_m, 5.0);
}

TEST_F(PlanJobTest, AFourthLostRaceIsTheCallersToRetry) {
  StartHost(DriveTo(1.0));
  TakeGoalForTheOtherRobot();
  Start({});
  EXPECT_TRUE(absl::IsAborted(Answer().status()));
}

TEST_F(PlanJobTest, ErrorOfTheStrategyIsTheAnswer) {
  StartHost([](const Belief&, const PlanRequest&, const StopFn&) {
    return absl::FailedPreconditionError("robot \"r1\" has no pose yet");
  });
  Start({});
  EXPECT_TRUE(absl::IsFailedPrecondition(Answer().status()));
}

TEST_F(PlanJobTest, FullPoolRefuses) {
  StartHost(DriveTo(1.0));
  FillPool();
  Start({});
  EXPECT_TRUE(absl::IsResourceExhausted(Answer().status()));
  release_.Notify();
}

TEST_F(PlanJobTest, StoppedMissionAnswersToo) {
  StartHost(DriveTo(1.0));
  Start({.min_applied_sequence = 1000});
  host_->Stop(absl::NotFoundError("MISSION_NOT_FOUND: missions/hall"));
  EXPECT_TRUE(absl::IsNotFound(Answer().status()));
}

TEST_F(PlanJobTest, NothingIsCommittedUnderALeaseThatWasReleasedMeanwhile) {
  StartHost([this](const Belief& belief, const PlanRequest& request, const StopFn&) {
    EXPECT_TRUE(host_->leases().Release("r1", kLease).ok());
    return PlanTo(belief, request.robot, 1.0);
  });
  host_->leases().Grant("r1", kLease);
  Start({});
  EXPECT_EQ(ErrorReason(Answer().status()), reason::kLeaseSuperseded);
}

}  // namespace plan_job_test
}  // namespace plumescout::server
