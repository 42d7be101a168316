// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "client/grpc_planner_client.h"
#include "core/types/status_macros.h"
#include "lab/bench/load/data_folder.h"
#include "lab/bench/load/known_map.h"
#include "lab/bench/load/load_team.h"
#include "lab/bench/load/rows.h"
#include "lab/bench/load/server_process.h"
#include "lab/worlds/bench_world.h"

namespace plumescout::lab {
namespace {

constexpr int kMissions = 64;
constexpr double kScan_hz = 2.0;
constexpr double kFirstPlan_s = 1.0;
constexpr double kAll_s = 15.0;
constexpr absl::Duration kPatience = absl::Minutes(2);
constexpr absl::Duration kLook = absl::Milliseconds(2);
constexpr absl::Duration kDrain = absl::Seconds(10);

MissionId MissionName(int number) { return absl::StrCat("mission-", number); }

absl::StatusOr<std::unique_ptr<ServerProcess>> StartServer(const RowSettings& settings,
                                                           const DataFolder& folder) {
  ServerStart start{settings.server_program, folder.Settings()};
  start.settings.push_back(absl::StrCat("limits.max_missions=", kMissions));
  start.settings.push_back("limits.memory_budget_bytes=100000000000");
  return ServerProcess::Start(start);
}

// A robot in each mission that scans and smells; then the server is killed.
absl::Status LeaveMissions(const RowSettings& settings, const DataFolder& folder,
                           const Grid<std::uint8_t>& walls) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto server, StartServer(settings, folder));
  const auto admin = client::MakeGrpcPlannerClient({.target = server->target()});
  std::vector<Team> teams;
  for (int i = 0; i < kMissions; ++i) {
    PLUMESCOUT_RETURN_IF_ERROR(admin->CreateMission(MissionName(i), MissionOptions{}));
    PLUMESCOUT_ASSIGN_OR_RETURN(
        teams.emplace_back(),
        StartTeam(
            server->target(), walls,
            {.mission = MissionName(i), .scan_hz = kScan_hz, .plan_period = absl::ZeroDuration()},
            settings.seed + static_cast<std::uint64_t>(i)));
  }
  absl::SleepFor(settings.time);
  for (const Team& team : teams) Stop(team, kDrain);
  server->Kill();
  return absl::OkStatus();
}

// Tries until it is done; what a server that recovers refuses is tried again.
absl::Status Await(const std::function<absl::Status()>& act, absl::Time end) {
  while (true) {
    const absl::Status status = act();
    if (status.ok() || !absl::IsUnavailable(status) || absl::Now() > end) return status;
    absl::SleepFor(kLook);
  }
}

absl::Status AskForPlan(client::PlannerClient& client, const MissionId& mission,
                        const Pose2& start) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const client::RobotSession session,
                              PlaceRobot(client, mission, "late", start));
  client::PlanQuery query;
  query.request.robot = session.robot;
  query.request.start = start;
  query.lease_token = session.lease_token;
  return client.NextBestTrajectory(mission, query).status();
}

}  // namespace

absl::StatusOr<std::vector<Bar>> RecoveryRow(const RowSettings& settings) {
  const DataFolder folder;
  const Grid<std::uint8_t> walls = MakeBuilding(kRowWidth, kRowHeight, settings.seed);
  PLUMESCOUT_RETURN_IF_ERROR(LeaveMissions(settings, folder, walls));
  const absl::Time began = absl::Now();
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto server, StartServer(settings, folder));
  const auto client = client::MakeGrpcPlannerClient({.target = server->target()});
  const Pose2 start = FreePoses(walls, 1, settings.seed).front();
  PLUMESCOUT_RETURN_IF_ERROR(Await(
      [&] { return AskForPlan(*client, MissionName(kMissions / 2), start); }, began + kPatience));
  const double first_plan_s = absl::ToDoubleSeconds(absl::Now() - began);
  for (int i = 0; i < kMissions; ++i) {
    PLUMESCOUT_RETURN_IF_ERROR(
        Await([&] { return client->GetMap(MissionName(i)).status(); }, began + kPatience));
  }
  const double all_s = absl::ToDoubleSeconds(absl::Now() - began);
  return std::vector<Bar>{{"recovery_missions", kMissions},
                          {"recovery_first_plan_s", first_plan_s, kFirstPlan_s},
                          {"recovery_all_s", all_s, kAll_s}};
}

}  // namespace plumescout::lab
