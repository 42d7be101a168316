// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/small_service.h"

#include <algorithm>
#include <utility>

#include "absl/status/status.h"
#include "core/belief/gas_query.h"
#include "core/mission/conduct/team_commit.h"
#include "core/plan/frontier_list.h"
#include "core/plan/team/team_plan.h"
#include "core/plan/trajectory_check.h"
#include "proto/convert/enums.h"
#include "proto/convert/geometry.h"
#include "proto/convert/inquiry.h"
#include "proto/convert/keep_out.h"
#include "proto/convert/map.h"
#include "proto/convert/names.h"
#include "proto/convert/options.h"
#include "proto/convert/plan.h"
#include "proto/convert/robot.h"
#include "proto/convert/robot_frame.h"
#include "proto/convert/status.h"
#include "server/config/mission_options.h"
#include "server/history/mission_history.h"
#include "server/missions/mission_journal.h"
#include "server/missions/mission_strategy.h"
#include "server/services/mission_update.h"
#include "server/services/paging.h"
#include "server/services/robot_message.h"
#include "server/streams/ingest_frames.h"
#include "server/streams/plan_order_from_proto.h"
#include "tests/fuzz/small_mission.h"

namespace plumescout::fuzz {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr int kMaxBatch = 64;
constexpr int kMaxQuestions = 200;  // of a search to its stop function
constexpr std::int64_t kFirstToken = 1;

// A search may ask so often; then it has to come to an end.
StopFn StopSoon() {
  return [questions = 0]() mutable { return ++questions > kMaxQuestions; };
}

template <typename Request>
HandledRequest Handled(void (SmallService::*handle)(const Request&)) {
  return {&Request::default_instance(),
          [handle](SmallService& service, const google::protobuf::Message& request) {
            (service.*handle)(static_cast<const Request&>(request));
          }};
}

}  // namespace

const std::vector<HandledRequest>& HandledRequests() {
  static const std::vector<HandledRequest> requests = {
      Handled(&SmallService::Create),
      Handled(&SmallService::Register),
      Handled(&SmallService::Remove),
      Handled(&SmallService::Ingest),
      Handled(&SmallService::Stream),
      Handled(&SmallService::Next),
      Handled(&SmallService::StreamNext),
      Handled(&SmallService::Check),
      Handled(&SmallService::ListFrontiers),
      Handled(&SmallService::Report),
      Handled(&SmallService::GetMap),
      Handled(&SmallService::WatchMap),
      Handled(&SmallService::QueryGas),
      Handled(&SmallService::ReadMap),
      Handled(&SmallService::ReadPlan),
      Handled(&SmallService::ChangeKeepOut),
      Handled(&SmallService::PlanTeam),
      Handled(&SmallService::OrderHome),
      Handled(&SmallService::ReleaseLease),
      Handled(&SmallService::Update),
      Handled(&SmallService::ListMissions),
      Handled(&SmallService::ListRobots),
      Handled(&SmallService::ListPlans),
      Handled(&SmallService::History),
      Handled(&SmallService::Figures),
      Handled(&SmallService::WatchRobot),
      Handled(&SmallService::GetRobot),
      Handled(&SmallService::Name<v1::GetMissionRequest>),
      Handled(&SmallService::Name<v1::DeleteMissionRequest>),
      Handled(&SmallService::Name<v1::PauseMissionRequest>),
      Handled(&SmallService::Name<v1::ResumeMissionRequest>),
      Handled(&SmallService::Name<v1::FinishMissionRequest>)};
  return requests;
}

SmallService::SmallService() { Begin(SmallMission()); }

void SmallService::Begin(const MissionOptions& options) {
  auto strategy = server::MakeMissionStrategy(options.planning, server::Rivals::kOff);
  auto mission = Mission::Create(options);
  if (!strategy.ok() || !mission.ok()) return;
  strategy_ = *std::move(strategy);
  conduct_ = std::make_unique<MissionConduct>(*std::move(mission));
  leases_.emplace(kSecond_ns, kFirstToken);
}

void SmallService::Create(const v1::CreateMissionRequest& request) {
  if (!ValidateId("mission_id", request.mission_id()).ok()) return;
  auto options = server::ReadMissionOptions(request.options(), SmallMission(), "options");
  if (!options.ok()) return;
  ToProto(*options);
  ChangesToProto(*options);
  if (options->prior_map != nullptr &&
      static_cast<std::int64_t>(options->prior_map->size()) > kSmallMissionCells) {
    return;  // takes too long
  }
  options->occupancy.max_cell_count =
      std::min(options->occupancy.max_cell_count, kSmallMissionCells);
  Begin(*options);
}

void SmallService::Register(const v1::RegisterRobotRequest& request) {
  if (!ParseMissionName("mission", request.mission()).ok()) return;
  if (!ValidateId("robot_id", request.robot_id()).ok()) return;
  const auto frame = FromProto(request.frame(), "frame");
  if (!frame.ok()) return;
  LeasesAt leases(*leases_, now_ns_ += kSecond_ns);
  conduct_
      ->Register({request.robot_id(), request.radius_m(), request.take_over(), request.log_epoch(),
                  *frame, SensorsFromProto(request)},
                 leases)
      .status()
      .IgnoreError();
}

void SmallService::Remove(const v1::RemoveRobotRequest& request) {
  const auto name = ParseRobotName("robot", request.robot());
  if (!name.ok()) return;
  Removal wish{name->robot};
  if (!request.force()) wish.lease_token = request.lease_token();
  LeasesAt leases(*leases_, now_ns_ += kSecond_ns);
  conduct_->Remove(wish, leases).status().IgnoreError();
}

void SmallService::Take(const std::string& robot, std::int64_t lease_token,
                        const v1::ObservationBatch& batch) {
  const auto name = ParseRobotName("open.robot", robot);
  auto incoming = server::ReadBatch(batch, kMaxBatch);
  if (!name.ok() || !incoming.ok()) return;
  if (!leases_->Use(name->robot, lease_token, now_ns_).ok()) return;
  const IngestResult result = conduct_->Ingest(name->robot, lease_token, *std::move(incoming));
  server::ToIngestState(result.position, name->robot, server::MissionJournal(), kMaxBatch);
  for (const RefusedObservation& refused : result.refused) server::ToRejected(refused);
}

void SmallService::Ingest(const v1::BatchIngestObservationsRequest& request) {
  Take(request.open().robot(), request.open().lease_token(), request.batch());
}

void SmallService::Stream(const v1::StreamObservationsRequest& request) {
  if (request.has_open()) open_ = request.open();
  if (request.has_batch()) Take(open_.robot(), open_.lease_token(), request.batch());
}

template <typename Request>
void SmallService::Plan(const Request& request) {
  const auto name = ParseRobotName("robot", request.robot());
  const auto order = server::PlanOrderFromProto(request, server::ServiceLimits());
  if (!name.ok() || !order.ok()) return;
  if (!leases_->Use(name->robot, order->lease_token, now_ns_).ok()) return;
  const BeliefWish wish{.robot = name->robot,
                        .min_applied_sequence = order->min_applied_sequence,
                        .lease_token = order->lease_token};
  const std::optional<absl::Status> verdict = conduct_->Verdict(wish);
  if (!verdict.has_value() || !verdict->ok()) return;
  const auto belief = conduct_->BeliefFor(wish);
  if (!belief.ok()) return;
  PlanRequest wanted = order->request;
  wanted.robot = name->robot;
  auto plan = strategy_->Plan(**belief, wanted, StopSoon());
  if (!plan.ok()) return;
  const auto id = conduct_->Commit(*plan, order->lease_token);
  if (id.ok()) plan->id = *id;
  FromProto(ToProto(*plan, name->mission), "plan").status().IgnoreError();
}

void SmallService::Next(const v1::NextBestTrajectoryRequest& request) { Plan(request); }
void SmallService::StreamNext(const v1::StreamNextBestTrajectoryRequest& request) { Plan(request); }

void SmallService::Check(const v1::CheckTrajectoryRequest& request) {
  const auto name = ParseRobotName("robot", request.robot());
  if (!name.ok()) return;
  const BeliefWish wish{.robot = name->robot,
                        .min_applied_sequence = request.min_applied_sequence(),
                        .lease_token = request.lease_token()};
  const std::optional<absl::Status> verdict = conduct_->Verdict(wish);
  if (!verdict.has_value() || !verdict->ok()) return;
  const auto belief = conduct_->Snapshot();
  IntendedPath path;
  if (request.has_plan()) {
    const auto plan = ParsePlanName("plan", request.plan());
    if (!plan.ok()) return;
    auto rest = RestOfPlan(*belief, name->robot, plan->plan);
    if (!rest.ok()) return;
    path = *std::move(rest);
  } else {
    auto vertices =
        PointsFromProto(request.path().vertices(), belief->options->pose_limit_m, "path.vertices");
    const auto kind = FromProto(request.path().goal_kind(), "path.goal_kind");
    if (!vertices.ok() || !kind.ok()) return;
    path = PathTo(*kind, *std::move(vertices), belief->geometry());
  }
  ToProto(CheckTrajectory(*belief, name->robot, path, belief->options->planning));
}

void SmallService::ListFrontiers(const v1::ListFrontiersRequest& request) {
  const auto name = ParseRobotName("robot", request.robot());
  const auto belief = conduct_->Snapshot();
  if (!name.ok() || belief->robots.count(name->robot) == 0) return;
  const auto frontiers = plumescout::ListFrontiers(*belief, name->robot, belief->options->planning);
  if (!frontiers.ok()) return;
  for (const JudgedFrontier& frontier : *frontiers) ToProto(frontier);
}

void SmallService::Report(const v1::ReportProgressRequest& request) {
  const auto name = ParseRobotName("robot", request.robot());
  const auto plan = ParsePlanName("plan", request.plan());
  const auto outcome = FromProto(request.outcome(), "outcome");
  if (!name.ok() || !plan.ok() || !outcome.ok()) return;
  conduct_->Report({name->robot, plan->plan, *outcome}, request.lease_token())
      .status()
      .IgnoreError();
}

template <typename Request>
void SmallService::Read(const Request& request) {
  if (!ParseMissionName("mission", request.mission()).ok()) return;
  MapViewFromProto(request).status().IgnoreError();
  conduct_->FreshBelief().status().IgnoreError();
}

void SmallService::GetMap(const v1::GetMapRequest& request) { Read(request); }
void SmallService::WatchMap(const v1::WatchMapRequest& request) { Read(request); }

void SmallService::QueryGas(const v1::QueryGasRequest& request) {
  const auto belief = conduct_->Snapshot();
  const auto points = PointsFromProto(request.points(), belief->options->pose_limit_m, "points");
  if (!points.ok()) return;
  for (const GasAtPlace& gas : plumescout::QueryGas(*belief, *points)) ToProto(gas);
}

void SmallService::ChangeKeepOut(const v1::ChangeKeepOutAreasRequest& request) {
  const auto change = FromProto(request);
  if (!ParseMissionName("name", request.name()).ok() || !change.ok()) return;
  if (!conduct_->ChangeKeepOut(*change).ok()) return;
  ToProto(conduct_->Snapshot()->options->keep_out);
}

void SmallService::PlanTeam(const v1::PlanTeamRequest& request) {
  const auto mission = ParseMissionName("mission", request.mission());
  if (!mission.ok()) return;
  const auto order = server::TeamOrderFromProto(request, *mission, server::ServiceLimits());
  const auto belief = conduct_->Snapshot();
  if (!order.ok()) return;
  for (const RobotId& robot : order->request.robots) {
    if (!belief->robots.contains(robot)) return;
  }
  auto team = plumescout::PlanTeam(*strategy_, *belief, order->request, StopSoon());
  if (!team.ok()) return;
  for (const plumescout::Plan& plan : CommitTeam(*std::move(team), *conduct_).plans) {
    ToProto(plan, *mission);
  }
}

void SmallService::OrderHome(const v1::OrderHomeRequest& request) {
  const auto name = server::ReadHomeOrder(request);
  if (!name.ok()) return;
  std::vector<RobotId> robots{name->robot};
  if (name->robot.empty()) {
    robots.clear();
    const auto belief = conduct_->Snapshot();
    for (const auto& [robot, record] : belief->robots) robots.push_back(robot);
  }
  conduct_->OrderHome(robots, request.home()).status().IgnoreError();
}

void SmallService::ReleaseLease(const v1::ReleaseLeaseRequest& request) {
  const auto name = ParseRobotName("robot", request.robot());
  if (!name.ok()) return;
  const auto token =
      request.force() ? std::nullopt : std::optional<std::int64_t>(request.lease_token());
  leases_->Release(name->robot, token).status().IgnoreError();
}

void SmallService::Update(const v1::UpdateMissionRequest& request) {
  server::MissionUpdateFromProto(request).status().IgnoreError();
}

void SmallService::ListMissions(const v1::ListMissionsRequest& request) {
  server::ReadPage(request.page_size(), request.page_token()).status().IgnoreError();
}

void SmallService::ListRobots(const v1::ListRobotsRequest& request) {
  if (!ParseMissionName("mission", request.mission()).ok()) return;
  server::ReadPage(request.page_size(), request.page_token()).status().IgnoreError();
}

void SmallService::ListPlans(const v1::ListPlansRequest& request) {
  ParseMissionName("mission", request.mission()).status().IgnoreError();
}

void SmallService::History(const v1::GetMissionHistoryRequest& request) {
  if (!ParseMissionName("mission", request.mission()).ok()) return;
  server::HistoryPageFromProto(request).status().IgnoreError();
}

void SmallService::Figures(const v1::GetMissionFiguresRequest& request) {
  ParseMissionName("mission", request.mission()).status().IgnoreError();
}

void SmallService::WatchRobot(const v1::WatchRobotRequest& request) {
  ParseRobotName("robot", request.robot()).status().IgnoreError();
}

void SmallService::GetRobot(const v1::GetRobotRequest& request) {
  ParseRobotName("name", request.name()).status().IgnoreError();
}

template <typename Request>
void SmallService::Name(const Request& request) {
  ParseMissionName("name", request.name()).status().IgnoreError();
}

void SmallService::ReadMap(const v1::GetMapResponse& response) {
  const GridGeometry none;
  const auto geometry = FromProto(response.tile_geometry(), "tile_geometry");
  if (geometry.value_or(none).size() > static_cast<std::size_t>(kSmallMissionCells)) return;
  FromProto(response).status().IgnoreError();
}

void SmallService::ReadPlan(const v1::Plan& plan) {
  FromProto(plan, "plan").status().IgnoreError();
}

}  // namespace plumescout::fuzz
