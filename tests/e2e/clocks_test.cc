// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Robots with wrong clocks over gRPC, in simulated time: the field is that of right clocks.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "client/grpc_planner_client.h"
#include "client/grpc_viewer_client.h"
#include "server/server.h"
#include "tests/client/ingest_traffic.h"
#include "tests/support/box_room.h"
#include "tests/support/same_bytes.h"

namespace plumescout::client {
namespace clocks_test {

constexpr std::int64_t kMillisecond_ns = 1'000'000;
constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kHour_ns = 3600 * kSecond_ns;
constexpr std::int64_t kBegin_ns = 1'800'000'000 * kSecond_ns;

constexpr int kSteps = 75;
constexpr std::int64_t kStep_ns = 4 * kSecond_ns;  // so 5 minutes in all
constexpr std::int64_t kTurn_ns = kSecond_ns / 5;  // between the batches of two robots
constexpr int kScans = 4;                          // a cell takes three beams to become free
constexpr double kHalfLife_s = 300.0;
constexpr double kMost_ppm = 6.0;

// The link takes 5 to 25 ms. What is taken for the offset of a clock is off by that, by what the
// clock drifts over 40 s, and by less than 20 ms for which no new one is put in force.
constexpr std::int64_t kLeastDelay_ns = 5 * kMillisecond_ns;
constexpr std::int64_t kJitter_ms = 21;
constexpr std::int64_t kMostOff_ns = (25 + 4 + 20) * kMillisecond_ns;

// How far the mission's time is ahead of a robot's clock.
struct Clock {
  std::int64_t at_begin_ns = 0;
  double growth = 0.0;  // s/s

  std::int64_t offset_ns(std::int64_t elapsed_ns) const {
    return at_begin_ns + std::llround(growth * static_cast<double>(elapsed_ns));
  }
};

struct TeamRun {
  MapSnapshot map;
  std::vector<double> lags_s;  // of the first robot, after each step
  std::int64_t most_off_ns = 0;
};

// A robot that reads gas once in every cell that it comes to: row by row, each 5 m long.
class Reader {
 public:
  Reader(PlannerClient& client, int index, Clock clock) : index_(index), clock_(clock) {
    auto session = client.RegisterRobot("house", absl::StrCat("r", index), 0.1, false);
    EXPECT_TRUE(session.ok()) << session.status();
    if (!session.ok()) return;
    session->robot_clock_ns = [this] { return now_ns_.load(); };
    auto stream = client.OpenObservationStream(*session);
    EXPECT_TRUE(stream.ok()) << stream.status();
    if (stream.ok()) stream_ = *std::move(stream);
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  std::int64_t offset_ns(std::int64_t elapsed_ns) const { return clock_.offset_ns(elapsed_ns); }

  // Senses and sends at that time, and the server's clock, `arrival`, is set to when that arrives.
  // Returns once it is applied, with how many observations were refused.
  int Send(int step, std::int64_t elapsed_ns, std::atomic<std::int64_t>& arrival_ns) {
    now_ns_ = kBegin_ns + elapsed_ns - clock_.offset_ns(elapsed_ns);
    const Pose2 pose{0.35 + 0.1 * (step % 50), 0.35 + 0.1 * (step / 50) + 0.7 * index_, 0.0};
    const double ppm = 1.0 + index_ + std::sin(0.1 * step);
    std::vector<Observation> batch;
    if (step < kScans) batch.push_back({0, now_ns_, pose, support::ScanInBox(pose, 6.0, 4.0)});
    batch.push_back({0, now_ns_, pose, GasReading{ppm}});
    for (Observation& observation : batch) observation.sequence = ++sequence_;
    arrival_ns =
        elapsed_ns + kLeastDelay_ns + (7 * step + 3 * index_) % kJitter_ms * kMillisecond_ns;
    const auto replies = SendAll(*stream_, batch);
    EXPECT_TRUE(replies.ok()) << replies.status();
    return replies.ok() ? static_cast<int>(replies->refused.size()) : 0;
  }
  bool is_open() const { return stream_ != nullptr; }

 private:
  const int index_;
  const Clock clock_;
  std::atomic<std::int64_t> now_ns_ = 0;  // by the robot's clock
  std::unique_ptr<ObservationStream> stream_;
  std::int64_t sequence_ = 0;
};

// Robots r0, r1 ... with these clocks, in one mission.
TeamRun RunTeam(const std::vector<Clock>& clocks) {
  TeamRun run;
  std::atomic<std::int64_t> elapsed_ns = 0;  // of the server's clock
  server::RegistryHooks hooks;
  hooks.wall_clock = [] { return kBegin_ns; };
  hooks.clock = [&] { return server::SteadyTime() + std::chrono::nanoseconds(elapsed_ns.load()); };
  server::ServerConfig config;
  config.listen = "127.0.0.1:0";
  const auto server = server::Server::Start(config, hooks);
  EXPECT_TRUE(server.ok()) << server.status();
  if (!server.ok()) return run;
  const GrpcClientOptions options{.target = absl::StrCat("127.0.0.1:", (*server)->port()),
                                  .call_timeout = kPatience};
  const auto client = MakeGrpcPlannerClient(options);
  const auto overseer = MakeGrpcViewerClient(options);
  MissionOptions mission;
  mission.gas.ageing_half_life_s = kHalfLife_s;
  mission.gas.estimate_noise = false;  // variances are compared by what weights say of them
  EXPECT_EQ(client->CreateMission("house", mission), absl::OkStatus());
  std::vector<std::unique_ptr<Reader>> readers;
  for (const Clock& clock : clocks) {
    readers.push_back(std::make_unique<Reader>(*client, static_cast<int>(readers.size()), clock));
    if (!readers.back()->is_open()) return run;
  }
  for (int step = 0; step < kSteps; ++step) {
    std::int64_t sent_ns = step * kStep_ns;
    for (const auto& reader : readers) {
      sent_ns += kTurn_ns;
      EXPECT_EQ(reader->Send(step, sent_ns, elapsed_ns), 0) << "refused in step " << step;
    }
    const auto robots = overseer->ListRobots("house");
    EXPECT_TRUE(robots.ok()) << robots.status();
    if (!robots.ok() || robots->size() != readers.size()) return run;
    run.lags_s.push_back(robots->front().ingest_lag_s.value_or(-1.0));
    for (std::size_t r = 0; r < readers.size(); ++r) {
      const std::int64_t off_ns =
          (*robots)[r].state.clock_offset_ns - readers[r]->offset_ns(elapsed_ns);
      run.most_off_ns = std::max(run.most_off_ns, std::abs(off_ns));
    }
  }
  auto map = client->GetMap("house");
  EXPECT_TRUE(map.ok()) << map.status();
  if (map.ok()) run.map = *std::move(map);
  return run;
}

TEST(ClocksTest, WrongClocksMakeTheFieldOfRightOnesAndDelayNobody) {
  const TeamRun right = RunTeam({{}, {}, {}, {}, {}});
  const TeamRun wrong = RunTeam({{}, {kHour_ns}, {-kHour_ns}, {0, 1e-4}, {0, -1e-4}});
  ASSERT_EQ(wrong.lags_s.size(), static_cast<std::size_t>(kSteps));
  EXPECT_EQ(wrong.lags_s, right.lags_s) << "whose clock is right notices nothing of the others";
  EXPECT_LE(right.most_off_ns, kMostOff_ns);
  EXPECT_LE(wrong.most_off_ns, kMostOff_ns);
  EXPECT_EQ(wrong.map.gas_counters, right.map.gas_counters);
  EXPECT_EQ(wrong.map.gas_counters.in_posterior, 5 * kSteps);
  ASSERT_TRUE(support::SameBytes(wrong.map.occupancy, right.map.occupancy));

  // The age of a reading is the difference of two times, each off by kMostOff_ns at most in either
  // run; its variance grows by its first one per half-life. In what the field took it for it may
  // be older, by the share that is certified.
  const GasQuality& a = right.map.gas_quality;
  const GasQuality& b = wrong.map.gas_quality;
  const double age_off_s = 4.0 * 1e-9 * static_cast<double>(kMostOff_ns);
  const double weight_share = (1.0 + std::max(a.ageing_error_ratio, b.ageing_error_ratio)) *
                                  (1.0 + age_off_s / kHalfLife_s) -
                              1.0;
  EXPECT_LT(weight_share, 0.11);
  // Weights that differ by a share r change no variance by more than that share, and no mean by
  // more than r times what readings differ by from it.
  const double most_ppm = weight_share * kMost_ppm + a.mean_error_ppm + b.mean_error_ppm + 1e-5;
  const double most_share =
      (1.0 + weight_share) * (1.0 + 2.0 * (a.variance_error_ratio + b.variance_error_ratio)) + 1e-6;
  int compared = 0;
  for (std::size_t i = 0; i < right.map.occupancy.size(); ++i) {
    const double mean_ppm = right.map.gas_mean_ppm[i];
    const double variance_ppm2 = right.map.gas_variance_ppm2[i];
    if (std::isnan(mean_ppm)) continue;
    ++compared;
    ASSERT_NEAR(wrong.map.gas_mean_ppm[i], mean_ppm, most_ppm) << i;
    ASSERT_LE(wrong.map.gas_variance_ppm2[i], most_share * variance_ppm2) << i;
    ASSERT_GE(most_share * wrong.map.gas_variance_ppm2[i], variance_ppm2) << i;
  }
  EXPECT_GT(compared, 2000) << "of 2400 in the room";
}

}  // namespace clocks_test
}  // namespace plumescout::client
