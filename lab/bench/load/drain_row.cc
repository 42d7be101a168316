// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include <functional>
#include <memory>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "client/grpc_planner_client.h"
#include "core/types/status_macros.h"
#include "lab/bench/load/known_map.h"
#include "lab/bench/load/load_watcher.h"
#include "lab/bench/load/open_calls.h"
#include "lab/bench/load/rows.h"
#include "lab/bench/load/server_process.h"
#include "lab/worlds/bench_world.h"

namespace plumescout::lab {
namespace {

constexpr char kMission[] = "drained";
constexpr double kDrain_s = 1.0;  // connection.drain_s
constexpr double kBeyond_s = 1.0;
constexpr absl::Duration kPatience = absl::Seconds(60);
constexpr absl::Duration kUnderWay = absl::Milliseconds(100);  // until the server is at it
constexpr int kStreams = 100;
constexpr int kLargeSide = 1000;  // cells: a million
constexpr int kBuildingSide = 600;

// Makes a server busy; what it returns keeps it so.
using MakeBusy = std::function<absl::StatusOr<std::shared_ptr<void>>(const std::string& target)>;

absl::StatusOr<client::RobotSession> Begin(const std::string& target, const MissionOptions& options,
                                           const Pose2& pose) {
  const auto client = client::MakeGrpcPlannerClient({.target = target});
  PLUMESCOUT_RETURN_IF_ERROR(client->CreateMission(kMission, options));
  return PlaceRobot(*client, kMission, "robot-1", pose);
}

absl::StatusOr<std::shared_ptr<void>> Wait(const std::string& target) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto session, Begin(target, MissionOptions{}, {}));
  return std::shared_ptr<OpenCalls>(OpenCalls::WaitForLog(target, session, 1));
}

absl::StatusOr<std::shared_ptr<void>> Plan(const std::string& target) {
  constexpr int kCalls = 4;
  const Grid<std::uint8_t> walls = MakeBuilding(kBuildingSide, kBuildingSide, 1);
  MissionOptions options = WithMap(KnownBuilding(walls));
  options.planning.sample_count = 100'000;
  options.planning.nearest_sample_count = 100;
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto session,
                              Begin(target, options, FreePoses(walls, 1, 1).front()));
  return std::shared_ptr<OpenCalls>(OpenCalls::Plan(target, session, kCalls, absl::Minutes(1)));
}

absl::StatusOr<std::shared_ptr<void>> Refresh(const std::string& target) {
  const auto client = client::MakeGrpcPlannerClient({.target = target});
  PLUMESCOUT_RETURN_IF_ERROR(client->CreateMission(kMission, WithMap(KnownHall(kLargeSide))));
  return std::shared_ptr<OpenCalls>(OpenCalls::ReadFreshMap(target, kMission, 1));
}

absl::StatusOr<std::shared_ptr<void>> Watch(const std::string& target) {
  PLUMESCOUT_RETURN_IF_ERROR(Begin(target, MissionOptions{}, {}).status());
  auto watchers = std::make_shared<std::vector<std::unique_ptr<LoadWatcher>>>();
  for (int i = 0; i < kStreams; ++i) {
    watchers->push_back(std::make_unique<LoadWatcher>(target, kMission, nullptr));
  }
  return std::shared_ptr<void>(watchers);
}

absl::StatusOr<Bar> Measure(const RowSettings& settings, const std::string& state,
                            const MakeBusy& make_busy) {
  const std::string drain = absl::StrCat("connection.drain_s=", kDrain_s);
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto server,
                              ServerProcess::Start({settings.server_program, {drain}}));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto busy, make_busy(server->target()));
  absl::SleepFor(kUnderWay);
  const absl::StatusOr<absl::Duration> taken = server->Stop(kPatience);
  if (!taken.ok() && !absl::IsDeadlineExceeded(taken.status())) return taken.status();
  return Bar{absl::StrCat("drain_", state, "_s"), absl::ToDoubleSeconds(taken.value_or(kPatience)),
             kDrain_s + kBeyond_s};
}

}  // namespace

absl::StatusOr<std::vector<Bar>> DrainRow(const RowSettings& settings) {
  const std::vector<std::pair<std::string, MakeBusy>> states = {
      {"waiter", Wait}, {"plan", Plan}, {"refresh", Refresh}, {"streams", Watch}};
  std::vector<Bar> bars;
  for (const auto& [name, make_busy] : states) {
    PLUMESCOUT_ASSIGN_OR_RETURN(Bar bar, Measure(settings, name, make_busy));
    bars.push_back(std::move(bar));
  }
  return bars;
}

}  // namespace plumescout::lab
