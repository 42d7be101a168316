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
constexpr int kBuildingSide = 600;

// What keeps a server busy.
struct Busy {
  std::shared_ptr<void> held;
  std::function<bool()> is_under_way;
};
using MakeBusy = std::function<absl::StatusOr<Busy>(const std::string& target)>;

Busy BusyWith(std::unique_ptr<OpenCalls> calls) {
  const std::shared_ptr<OpenCalls> held = std::move(calls);
  return {held, [held] { return held->ended() == 0; }};
}

absl::StatusOr<client::RobotSession> Begin(const std::string& target, const MissionOptions& options,
                                           const Pose2& pose) {
  const auto client = client::MakeGrpcPlannerClient({.target = target});
  PLUMESCOUT_RETURN_IF_ERROR(client->CreateMission(kMission, options));
  return PlaceRobot(*client, kMission, "robot-1", pose);
}

absl::StatusOr<Busy> Wait(const std::string& target) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto session, Begin(target, MissionOptions{}, {}));
  return BusyWith(OpenCalls::WaitForLog(target, session, 1));
}

absl::StatusOr<Busy> Plan(const std::string& target) {
  constexpr int kCalls = 4;
  const Grid<std::uint8_t> walls = MakeBuilding(kBuildingSide, kBuildingSide, 1);
  MissionOptions options = WithMap(KnownBuilding(walls));
  options.planning.sample_count = 100'000;
  options.planning.nearest_sample_count = 100;
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto session,
                              Begin(target, options, FreePoses(walls, 1, 1).front()));
  return BusyWith(OpenCalls::Plan(target, session, kCalls, absl::Minutes(1)));
}

absl::StatusOr<Busy> Refresh(const std::string& target) {
  const auto client = client::MakeGrpcPlannerClient({.target = target, .call_timeout = kPatience});
  PLUMESCOUT_RETURN_IF_ERROR(client->CreateMission(kMission, LargeField()));
  return BusyWith(OpenCalls::ReadFreshMap(target, kMission, 1));
}

absl::StatusOr<Busy> Watch(const std::string& target) {
  PLUMESCOUT_RETURN_IF_ERROR(Begin(target, MissionOptions{}, {}).status());
  auto watchers = std::make_shared<std::vector<std::unique_ptr<LoadWatcher>>>();
  for (int i = 0; i < kStreams; ++i) {
    watchers->push_back(std::make_unique<LoadWatcher>(target, kMission, nullptr));
  }
  return Busy{watchers, [] { return true; }};
}

absl::StatusOr<std::vector<Bar>> Measure(const RowSettings& settings, const std::string& state,
                                         const MakeBusy& make_busy) {
  std::vector<std::string> options = LargeFieldSettings();
  options.push_back(absl::StrCat("connection.drain_s=", kDrain_s));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto server,
                              ServerProcess::Start({settings.server_program, options}));
  PLUMESCOUT_ASSIGN_OR_RETURN(const Busy busy, make_busy(server->target()));
  absl::SleepFor(kUnderWay);
  const bool under_way = busy.is_under_way();
  const absl::StatusOr<absl::Duration> taken = server->Stop(kPatience);
  if (!taken.ok() && !absl::IsDeadlineExceeded(taken.status())) return taken.status();
  return std::vector<Bar>{{absl::StrCat("drain_", state, "_s"),
                           absl::ToDoubleSeconds(taken.value_or(kPatience)), kDrain_s + kBeyond_s},
                          MustHold(absl::StrCat("drain_", state, "_idle"), under_way)};
}

}  // namespace

absl::StatusOr<std::vector<Bar>> DrainRow(const RowSettings& settings) {
  const std::vector<std::pair<std::string, MakeBusy>> states = {
      {"waiter", Wait}, {"plan", Plan}, {"refresh", Refresh}, {"streams", Watch}};
  std::vector<Bar> bars;
  for (const auto& [name, make_busy] : states) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<Bar> measured,
                                Measure(settings, name, make_busy));
    bars.insert(bars.end(), measured.begin(), measured.end());
  }
  return bars;
}

}  // namespace plumescout::lab
