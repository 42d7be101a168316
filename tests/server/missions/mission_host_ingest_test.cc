// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Of the mission host: what it does not let through to the conduct.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include "absl/synchronization/notification.h"
#include "core/types/error_reason.h"
#include "server/missions/mission_host.h"
#include "tests/server/host_parts.h"
#include "tests/support/box_room.h"
#include "tests/support/same_bytes.h"

namespace plumescout::server {
namespace mission_host_ingest_test {

constexpr std::int64_t kLease = 7;

// Returns once every command posted before has run.
void Settle(MissionHost& host) {
  absl::Notification done;
  ASSERT_TRUE(host.Post([&](MissionWriter&) { done.Notify(); }).ok());
  done.WaitForNotification();
}

void AddRobot(MissionHost& host) {
  ASSERT_TRUE(host.Post([](MissionWriter& writer) {
                    EXPECT_TRUE(writer.conduct().Register({"r1", 0.2, kLease}).ok());
                  })
                  .ok());
}

void PostGas(MissionHost& host, std::int64_t first, std::int64_t last) {
  ASSERT_TRUE(host.Post([first, last](MissionWriter& writer) {
                    EXPECT_TRUE(
                        writer.conduct().Ingest("r1", kLease, GasBatch(first, last)).status.ok());
                  })
                  .ok());
}

TEST(MissionHostIngestTest, AFinishedMissionTakesNoBatch) {
  MissionHost host(HostParts(), {});
  AddRobot(host);
  PostGas(host, 1, 2);
  host.standing().Finish();
  ASSERT_TRUE(host.Post([&](MissionWriter& writer) {
                    const IngestResult result = host.Ingest(writer, "r1", kLease, GasBatch(3, 4));
                    EXPECT_EQ(ErrorReason(result.status), reason::kMissionFinished);
                    EXPECT_EQ(result.position.applied_sequence, 2);
                  })
                  .ok());
  Settle(host);
}

TEST(MissionHostIngestTest, ASampleOfAClockThatRunsAheadIsAnEventThatARefusalFollows) {
  HostOptions options;
  options.wall_clock = [] { return std::int64_t{1'000'000'000}; };
  options.max_clock_lead = absl::Seconds(1);
  std::vector<Event> events;
  MissionHost host(HostParts(nullptr, [&](const Event& event) { events.push_back(event); }),
                   options);
  AddRobot(host);
  ASSERT_TRUE(host.Post([&](MissionWriter& writer) {
                    auto batch = GasBatch(1, 3);
                    batch[1].observation.sample_time_ns = 2'000'000'001;
                    const IngestResult result = host.Ingest(writer, "r1", kLease, std::move(batch));
                    EXPECT_TRUE(result.status.ok()) << result.status;
                    EXPECT_EQ(result.position.applied_sequence, 3);
                    ASSERT_EQ(result.refused.size(), 1U);
                    EXPECT_EQ(ErrorReason(result.refused[0].status), reason::kClockAhead);
                  })
                  .ok());
  Settle(host);
  host.Stop(absl::NotFoundError("deleted"));
  Mission replay{MissionOptions{}};
  for (const Event& event : events) EXPECT_TRUE(replay.Apply(event.body).ok());
  EXPECT_EQ(replay.sample_time_ns(), 3'000'000);
  EXPECT_EQ(replay.AppliedSequence("r1").value(), 3);
}

// Readings that arrive with the call would have a refresh made before it, and it another.
TEST(MissionHostIngestTest, WhoWaitsForABeliefHasTheRefreshThatIsDue) {
  int refreshes = 0;
  const auto count = [&](const Event& event) {
    refreshes += std::holds_alternative<PosteriorRefreshed>(event.body) ? 1 : 0;
  };
  MissionHost host(HostParts(nullptr, count), {});
  AddRobot(host);
  const auto send = [&](std::int64_t first, std::int64_t last) {
    ASSERT_TRUE(host.Post([first, last](MissionWriter& writer) {
                      auto batch = GasBatch(first, last);  // a millisecond after the other
                      EXPECT_TRUE(
                          writer.conduct().Ingest("r1", kLease, std::move(batch)).status.ok());
                    })
                    .ok());
  };
  absl::Notification release;
  absl::Notification served;
  ASSERT_TRUE(host.Post([&](MissionWriter&) { release.WaitForNotification(); }).ok());
  send(1, 60);
  ASSERT_TRUE(host.AwaitBelief({.wish = {.robot = "r1", .min_applied_sequence = 2}},
                               [&](const absl::StatusOr<std::shared_ptr<const Belief>>& belief) {
                                 EXPECT_TRUE(belief.ok()) << belief.status();
                                 served.Notify();
                               })
                  .ok());
  send(61, 64);
  release.Notify();
  served.WaitForNotification();
  Settle(host);
  EXPECT_EQ(refreshes, 1);
  send(65, 120);
  Settle(host);
  EXPECT_EQ(refreshes, 2) << "one is due again, and nobody waits for it";
}

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kHour_ns = 3600 * kSecond_ns;
constexpr std::int64_t kNow_ns = 1'800'000'000 * kSecond_ns;

// A host whose clocks a test moves, with a robot for each clock.
class ClocksTest : public testing::Test {
 protected:
  void Start(const std::map<RobotId, std::int64_t>& offsets_ns) {
    offsets_ns_ = offsets_ns;
    HostOptions options;
    options.wall_clock = [] { return kNow_ns; };
    options.clock = [this] { return SteadyTime() + std::chrono::nanoseconds(elapsed_ns_.load()); };
    host_ = std::make_unique<MissionHost>(
        HostParts(nullptr, [this](const Event& event) { events_.push_back(event); }), options);
    Run([this](MissionWriter& writer) {
      for (const auto& [robot, offset_ns] : offsets_ns_) {
        EXPECT_TRUE(writer.conduct().Register({robot, 0.2, kLease + 1 + lease_++}).ok());
        leases_[robot] = kLease + lease_;
      }
    });
  }
  void Run(std::function<void(MissionWriter&)> task) {
    ASSERT_TRUE(host_->Post(std::move(task)).ok());
    Settle(*host_);
  }
  // A scan and a reading of now, by the robot's clock; sent now, and it waits in the queue.
  IngestResult Send(const RobotId& robot, std::int64_t age_ns = 0, bool says_when = true,
                    double queued_s = 0.0) {
    IngestResult result;
    const std::int64_t arrived_ns = host_->clock().now_ns();
    const std::int64_t robot_ns = arrived_ns - offsets_ns_.at(robot);
    Wait(queued_s);
    Run([&](MissionWriter& writer) {
      const std::int64_t next = writer.mission().AppliedSequence(robot).value() + 1;
      const double x_m = 1.0 + 0.01 * static_cast<double>(next);
      const Pose2 pose{x_m, 2.0, 0.0};
      std::vector<IncomingObservation> batch;
      batch.push_back(
          {{next, robot_ns - age_ns, pose, support::ScanInBox(pose, 6.0, 4.0)}, absl::OkStatus()});
      batch.push_back({{next + 1, robot_ns - age_ns, pose, GasReading{10.0 * x_m}}, {}});
      result = host_->Ingest(writer, robot, leases_.at(robot), std::move(batch),
                             {says_when ? robot_ns : 0, arrived_ns});
    });
    EXPECT_TRUE(result.status.ok()) << result.status;
    return result;
  }
  void Wait(double duration_s) { elapsed_ns_ += std::llround(duration_s * 1e9); }
  std::shared_ptr<const Belief> Fresh() {
    std::shared_ptr<const Belief> belief;
    Run([&](MissionWriter& writer) { belief = writer.conduct().BeliefFor({}).value(); });
    return belief;
  }
  std::int64_t OffsetOf(const RobotId& robot) {
    return Fresh()->robots.at(robot).state.clock_offset_ns;
  }
  std::int64_t time_ns() { return Fresh()->sample_time_ns; }

  std::map<RobotId, std::int64_t> offsets_ns_;
  std::atomic<std::int64_t> elapsed_ns_ = 0;
  std::vector<Event> events_;
  std::unique_ptr<MissionHost> host_;
  std::map<RobotId, std::int64_t> leases_;
  std::int64_t lease_ = 0;
};

TEST_F(ClocksTest, WrongClocksMakeTheFieldOfRightOnesAndTheReplayIsExact) {
  std::shared_ptr<const Belief> fields[2];
  for (const bool wrong : {false, true}) {
    events_.clear();
    leases_.clear();
    elapsed_ns_ = 0;
    Start({{"a", wrong ? kHour_ns : 0}, {"b", 0}, {"c", wrong ? -kHour_ns : 0}});
    for (int k = 0; k < 10; ++k) {
      Wait(1.0);
      for (const char* robot : {"a", "b", "c"}) EXPECT_TRUE(Send(robot).refused.empty());
    }
    fields[wrong ? 1 : 0] = Fresh();
    std::uint64_t digest = 0;
    Run([&](MissionWriter& writer) { digest = writer.mission().Digest(); });
    host_->Stop(absl::NotFoundError("over"));
    Mission replay{MissionOptions{}};
    for (const Event& event : events_) ASSERT_TRUE(replay.Apply(event.body).ok());
    EXPECT_EQ(replay.Digest(), digest);
  }
  EXPECT_EQ(fields[0]->sample_time_ns, kNow_ns + 10 * kSecond_ns);
  EXPECT_EQ(fields[1]->sample_time_ns, kNow_ns + 10 * kSecond_ns);
  EXPECT_TRUE(support::SameBytes(*fields[0]->gas_mean_ppm, *fields[1]->gas_mean_ppm));
  EXPECT_TRUE(support::SameBytes(*fields[0]->gas_variance_ppm2, *fields[1]->gas_variance_ppm2));
}

TEST_F(ClocksTest, TheOffsetIsAnEventBeforeTheFirstObservation) {
  Start({{"a", -kHour_ns}});
  Send("a");
  ASSERT_GE(events_.size(), 3U);
  const auto* noted = std::get_if<ClockOffsetNoted>(&events_[1].body);
  ASSERT_NE(noted, nullptr);
  EXPECT_EQ(noted->offset_ns, -kHour_ns);
  const auto* received = std::get_if<ObservationReceived>(&events_[2].body);
  ASSERT_NE(received, nullptr);
  EXPECT_EQ(received->observation.sample_time_ns, kNow_ns + kHour_ns) << "by its own clock";
}

TEST_F(ClocksTest, AClockThatIsRightIsNoEvent) {
  Start({{"a", 0}});
  Send("a");
  for (const Event& event : events_) {
    EXPECT_FALSE(std::holds_alternative<ClockOffsetNoted>(event.body));
  }
}

TEST_F(ClocksTest, AClockThatIsSetInMidMissionHarmsNobody) {
  for (const std::int64_t step_ns : {kHour_ns, -kHour_ns}) {
    events_.clear();
    leases_.clear();
    elapsed_ns_ = 0;
    Start({{"a", 0}, {"b", 0}});
    for (int k = 0; k < 3; ++k) {
      Wait(1.0);
      Send("a");
      Send("b");
    }
    offsets_ns_["a"] = step_ns;
    for (int k = 0; k < 3; ++k) {
      Wait(1.0);
      EXPECT_TRUE(Send("a").refused.empty());
      EXPECT_TRUE(Send("b").refused.empty());
      EXPECT_EQ(time_ns(), kNow_ns + elapsed_ns_);
    }
    EXPECT_EQ(OffsetOf("a"), step_ns);
    EXPECT_EQ(OffsetOf("b"), 0);
    host_->Stop(absl::NotFoundError("over"));
  }
}

TEST_F(ClocksTest, ABacklogKeepsItsAge) {
  Start({{"a", kHour_ns}});
  Send("a");
  Wait(600.0);
  Send("a", 590 * kSecond_ns);
  EXPECT_EQ(time_ns(), kNow_ns + 10 * kSecond_ns);
  EXPECT_EQ(OffsetOf("a"), kHour_ns);
}

TEST_F(ClocksTest, TimeInTheQueueIsNoDelayOfTheLink) {
  Start({{"a", kHour_ns}, {"b", 0}});
  for (int k = 1; k <= 5; ++k) {
    Send("a", 0, /*says_when=*/true, /*queued_s=*/2.0);
    EXPECT_EQ(OffsetOf("a"), kHour_ns);
    EXPECT_EQ(time_ns(), kNow_ns + elapsed_ns_ - 2 * kSecond_ns);
  }
  // What lies ahead is that at the arrival, too.
  const IngestResult result = Send("b", -6 * kSecond_ns, /*says_when=*/true, /*queued_s=*/2.0);
  ASSERT_EQ(result.refused.size(), 2U);
  EXPECT_EQ(ErrorReason(result.refused[0].status), reason::kClockAhead);
}

TEST_F(ClocksTest, NobodyCanHurryTheMission) {
  Start({{"a", 0}});
  const IngestResult result = Send("a", -6 * kSecond_ns);
  ASSERT_EQ(result.refused.size(), 2U);
  EXPECT_EQ(ErrorReason(result.refused[0].status), reason::kClockAhead);
  Send("a", -4 * kSecond_ns);
  EXPECT_EQ(time_ns(), kNow_ns + 4 * kSecond_ns);
}

// A goal is claimed for 30 s after twice the time of the way to it, here none.
TEST_F(ClocksTest, AClaimEndsByTheServersClockWhateverThoseOfRobotsSay) {
  for (const std::int64_t holder_ns : {-kHour_ns, kHour_ns}) {
    for (const std::int64_t other_ns : {-kHour_ns, kHour_ns}) {
      leases_.clear();
      elapsed_ns_ = 0;
      Start({{"holder", holder_ns}, {"other", other_ns}});
      Send("holder");
      Send("other");
      Run([&](MissionWriter& writer) {
        Plan plan;
        plan.robot = "holder";
        plan.chosen = 0;
        plan.candidates.resize(1);
        plan.candidates[0].goal.kind = GoalKind::kOccupancyFrontier;
        plan.trajectory.waypoints.resize(2);
        EXPECT_TRUE(writer.conduct().Commit(plan, leases_.at("holder")).ok());
      });
      // It is heard of no more.
      Wait(29.0);
      Send("other");
      EXPECT_EQ(Fresh()->claims.size(), 1U) << holder_ns << " " << other_ns;
      Wait(2.0);
      Send("other");
      EXPECT_TRUE(Fresh()->claims.empty()) << holder_ns << " " << other_ns;
      host_->Stop(absl::NotFoundError("over"));
    }
  }
}

TEST_F(ClocksTest, WhoSaysNothingOfItsClockIsTakenAsItIs) {
  Start({{"a", kHour_ns}});
  Send("a", 0, /*says_when=*/false);
  EXPECT_EQ(time_ns(), kNow_ns - kHour_ns);
  Send("a");
  EXPECT_EQ(OffsetOf("a"), kHour_ns);
  Send("a", 0, /*says_when=*/false);
  EXPECT_EQ(OffsetOf("a"), 0);
}

TEST_F(ClocksTest, WhoHasNoLeaseTellsNothingOfAClock) {
  Start({{"a", 0}});
  Send("a");
  Run([&](MissionWriter& writer) {
    const IngestResult result =
        host_->Ingest(writer, "a", kLease - 1, GasBatch(3, 3), {kNow_ns + kHour_ns, kNow_ns});
    EXPECT_EQ(ErrorReason(result.status), reason::kLeaseSuperseded);
    EXPECT_EQ(result.position.applied_sequence, 2);
  });
  EXPECT_EQ(OffsetOf("a"), 0);
}

TEST_F(ClocksTest, ARobotThatLeavesTakesItsClockAlong) {
  Start({{"a", kHour_ns}, {"b", 0}});
  Send("a");
  Send("b");
  Run([&](MissionWriter& writer) {
    EXPECT_TRUE(writer.conduct().Remove({"a"}, host_->leases()).ok());
  });
  EXPECT_FALSE(host_->robot_clocks().LinkOf("a").has_value());
  EXPECT_TRUE(host_->robot_clocks().LinkOf("b").has_value());
  EXPECT_EQ(host_->robot_clocks().WorstOffset(), absl::ZeroDuration());
}

TEST_F(ClocksTest, LinksTellHowOldTheNewestSampleIs) {
  Start({{"a", kHour_ns}, {"b", 0}});
  Send("a", 2 * kSecond_ns);
  const auto link = host_->robot_clocks().LinkOf("a");
  ASSERT_TRUE(link.has_value());
  EXPECT_EQ(link->newest_sample_ns, kNow_ns - 2 * kSecond_ns);
  EXPECT_EQ(host_->robot_clocks().WorstOffset(), absl::Hours(1));
  EXPECT_FALSE(host_->robot_clocks().LinkOf("b").has_value());
}

TEST(MissionHostIngestTest, ABatchUnderALeaseThatWasReleasedMeanwhileIsRefused) {
  MissionHost host(HostParts(), {});
  AddRobot(host);
  host.leases().Grant("r1", kLease);
  ASSERT_TRUE(host.Post([&](MissionWriter& writer) {
                    EXPECT_TRUE(host.Ingest(writer, "r1", kLease, GasBatch(1, 2)).status.ok());
                    EXPECT_TRUE(host.leases().Release("r1", kLease).ok());
                    const IngestResult late = host.Ingest(writer, "r1", kLease, GasBatch(3, 4));
                    EXPECT_EQ(ErrorReason(late.status), reason::kLeaseSuperseded);
                    EXPECT_EQ(late.position.applied_sequence, 2);
                  })
                  .ok());
  Settle(host);
}

}  // namespace mission_host_ingest_test
}  // namespace plumescout::server
