// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/clients/cpp_steps.h"

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "client/grpc_operator_client.h"
#include "client/grpc_planner_client.h"
#include "client/grpc_server_client.h"
#include "client/grpc_viewer_client.h"
#include "core/types/status_macros.h"
#include "tests/clients/told.h"

namespace plumescout::client {
namespace {

constexpr absl::Duration kPatience = absl::Seconds(60);

// Nothing, or why not.
Answer Nothing(const absl::Status& status) {
  if (!status.ok()) return status;
  return Json::object();
}

template <typename Items, typename Tell>
Json TellAll(const Items& items, Tell tell) {
  Json all = Json::array();
  for (const auto& item : items) all.push_back(tell(item));
  return all;
}

struct Session {
  RobotSession robot;
  std::int64_t last_sequence = 0;
};

class Runner {
 public:
  Runner(const std::string& target, Json scenario) : scenario_(std::move(scenario)) {
    const auto link = MakeGrpcLink({.target = target, .call_timeout = kPatience});
    planner_ = MakeGrpcPlannerClient(link);
    viewer_ = MakeGrpcViewerClient(link);
    operator_ = MakeGrpcOperatorClient(link);
    server_ = MakeGrpcServerClient(link);
  }

  Answer Do(const std::string& kind, const Json& with) {
    using Step = Answer (Runner::*)(const Json&);
    static const std::map<std::string, Step> steps = {
        {"get_server_info", &Runner::GetServerInfo},
        {"drain_server", &Runner::DrainServer},
        {"list_missions", &Runner::ListMissions},
        {"create_mission", &Runner::CreateMission},
        {"get_mission", &Runner::GetMission},
        {"pause_mission", &Runner::PauseMission},
        {"resume_mission", &Runner::ResumeMission},
        {"finish_mission", &Runner::FinishMission},
        {"update_mission", &Runner::UpdateMission},
        {"change_keep_out_areas", &Runner::ChangeKeepOutAreas},
        {"delete_mission", &Runner::DeleteMission},
        {"register_robot", &Runner::RegisterRobot},
        {"stream_observations", &Runner::StreamObservations},
        {"batch_ingest_observations", &Runner::BatchIngestObservations},
        {"next_best_trajectory", &Runner::NextBestTrajectory},
        {"stream_next_best_trajectory", &Runner::StreamNextBestTrajectory},
        {"check_trajectory", &Runner::CheckTrajectory},
        {"list_frontiers", &Runner::ListFrontiers},
        {"report_progress", &Runner::ReportProgress},
        {"list_plans", &Runner::ListPlans},
        {"plan_team", &Runner::PlanTeam},
        {"list_robots", &Runner::ListRobots},
        {"get_robot", &Runner::GetRobot},
        {"watch_robot", &Runner::WatchRobot},
        {"order_home", &Runner::OrderHome},
        {"release_lease", &Runner::ReleaseLease},
        {"remove_robot", &Runner::RemoveRobot},
        {"get_map", &Runner::GetMap},
        {"watch_map", &Runner::WatchMap},
        {"query_gas", &Runner::QueryGas},
        {"export_mission", &Runner::ExportMission},
        {"import_mission", &Runner::ImportMission},
        {"get_mission_history", &Runner::GetMissionHistory},
        {"get_mission_figures", &Runner::GetMissionFigures},
    };
    const auto found = steps.find(kind);
    if (found == steps.end()) return absl::UnimplementedError("no step of kind " + kind);
    return (this->*found->second)(with);
  }

 private:
  // The server.
  Answer GetServerInfo(const Json&) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const ServerInfo info, server_->GetServerInfo());
    return Json{{"features", info.features}, {"max_receive_bytes", info.limits.max_receive_bytes}};
  }
  Answer DrainServer(const Json&) { return Nothing(server_->DrainServer()); }

  // Missions.
  Answer Told(const MissionId& mission) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const MissionDetails details, viewer_->GetMission(mission));
    return TellMission(details);
  }
  Answer Told(const absl::Status& status, const Json& with) {
    if (!status.ok()) return status;
    return Told(with["mission"].get<MissionId>());
  }
  Answer ListMissions(const Json&) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const auto missions, planner_->ListMissions());
    return Json{{"missions", missions}};
  }
  Answer CreateMission(const Json& with) {
    const MissionOptions options = ReadOptions(with.value("options", Json::object()));
    PLUMESCOUT_RETURN_IF_ERROR(planner_->CreateMission(with["mission"], options));
    const MissionUpdate update = ReadUpdate(with);
    const bool is_kept_so = update.idle_time_to_live || update.event_retention;
    return Told(is_kept_so ? operator_->UpdateMission(with["mission"], update) : absl::OkStatus(),
                with);
  }
  Answer GetMission(const Json& with) { return Told(absl::OkStatus(), with); }
  Answer PauseMission(const Json& with) {
    return Told(operator_->PauseMission(with["mission"]), with);
  }
  Answer ResumeMission(const Json& with) {
    return Told(operator_->ResumeMission(with["mission"]), with);
  }
  Answer FinishMission(const Json& with) {
    return Told(operator_->FinishMission(with["mission"]), with);
  }
  Answer UpdateMission(const Json& with) {
    return Told(operator_->UpdateMission(with["mission"], ReadUpdate(with)), with);
  }
  Answer ChangeKeepOutAreas(const Json& with) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<Polygon> areas,
                                operator_->ChangeKeepOutAreas(with["mission"], ReadChange(with)));
    return Json{{"areas", TellAll(areas, TellArea)}};
  }
  Answer DeleteMission(const Json& with) {
    return Nothing(planner_->DeleteMission(with["mission"]));
  }
  Answer ExportMission(const Json& with) {
    std::ofstream file(with["file"].get<std::string>(), std::ios::binary);
    const auto format = with.value("format", "JOURNAL") == "MCAP" ? MissionFileFormat::kMcap
                                                                  : MissionFileFormat::kJournal;
    const auto exported =
        operator_->ExportMission(with["mission"], format, [&](const MissionFilePiece& piece) {
          file.write(piece.bytes.data(), static_cast<std::streamsize>(piece.bytes.size()));
          return file ? absl::OkStatus() : absl::UnavailableError("the file cannot be written");
        });
    if (!exported.ok()) return exported.status();
    return Json{{"mission", with["mission"]}};
  }
  Answer ImportMission(const Json& with) {
    std::ifstream file(with["file"].get<std::string>(), std::ios::binary);
    PLUMESCOUT_ASSIGN_OR_RETURN(
        const MissionId mission,
        operator_->ImportMission(with["mission"],
                                 [&](std::size_t max_bytes) -> absl::StatusOr<std::string> {
                                   std::string bytes(max_bytes, '\0');
                                   file.read(bytes.data(), static_cast<std::streamsize>(max_bytes));
                                   bytes.resize(static_cast<std::size_t>(file.gcount()));
                                   return bytes;
                                 }));
    return Told(mission);
  }
  Answer GetMissionHistory(const Json& with) {
    HistoryQuery query{.kinds = ReadEventKinds(with["kinds"]), .page_size = 7};
    Json events = Json::array();
    do {
      PLUMESCOUT_ASSIGN_OR_RETURN(const HistoryPage page,
                                  viewer_->GetHistory(with["mission"], query));
      for (const MissionEvent& event : page.events) events.push_back(TellEvent(event));
      query.page_token = page.next_page_token;
    } while (!query.page_token.empty());
    return Json{{"events", events}};
  }
  Answer GetMissionFigures(const Json& with) { return TellFigures(*viewer_, with["mission"]); }

  // Robots.
  const RobotSession& RobotOf(const Json& with) { return sessions_.at(with["session"]).robot; }
  Answer RegisterRobot(const Json& with) {
    PLUMESCOUT_ASSIGN_OR_RETURN(
        RobotSession robot,
        planner_->RegisterRobot(
            with["mission"], with["robot"], with["radius_m"], with.value("take_over", false),
            /*log_epoch=*/0, {.sensors = ReadSensors(with.value("gas_sensors", Json::array()))}));
    const std::int64_t applied = robot.ingest.applied_sequence;
    sessions_[with["session"]] = {std::move(robot), applied};
    return Json{{"applied_sequence", applied}};
  }
  std::vector<Observation> Numbered(const Json& with, Session& session) {
    std::vector<Observation> batch;
    for (const Json& one : with["observations"]) {
      batch.push_back(ReadObservation(one, scenario_));
      batch.back().sequence = ++session.last_sequence;
    }
    return batch;
  }
  Answer StreamObservations(const Json& with) {
    Session& session = sessions_.at(with["session"]);
    PLUMESCOUT_ASSIGN_OR_RETURN(const auto stream, planner_->OpenObservationStream(session.robot));
    PLUMESCOUT_RETURN_IF_ERROR(stream->Write(Numbered(with, session)));
    Json rejected = Json::array();
    std::int64_t applied = stream->opened().applied_sequence;
    while (applied < session.last_sequence) {
      PLUMESCOUT_ASSIGN_OR_RETURN(const IngestReply reply, stream->Read(kPatience));
      if (const auto* refused = std::get_if<ObservationRejected>(&reply)) {
        rejected.push_back(refused->sequence);
      } else {
        applied = std::get<IngestState>(reply).applied_sequence;
      }
    }
    PLUMESCOUT_RETURN_IF_ERROR(stream->Finish());
    return Json{{"applied_sequence", applied}, {"rejected", rejected}};
  }
  Answer BatchIngestObservations(const Json& with) {
    Session& session = sessions_.at(with["session"]);
    PLUMESCOUT_ASSIGN_OR_RETURN(const BatchReply reply,
                                planner_->IngestBatch(session.robot, Numbered(with, session)));
    const Json rejected =
        TellAll(reply.rejected, [](const auto& refused) { return refused.sequence; });
    return Json{{"applied_sequence", reply.state.applied_sequence}, {"rejected", rejected}};
  }
  Answer ListRobots(const Json& with) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const auto robots, viewer_->ListRobots(with["mission"]));
    return Json{{"robots", TellAll(robots, [](const auto& robot) { return robot.state.id; })}};
  }
  Answer GetRobot(const Json& with) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const RobotDetails robot,
                                viewer_->GetRobot(with["mission"], with["robot"]));
    return TellRobot(robot);
  }
  Answer WatchRobot(const Json& with) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const auto watch,
                                with.contains("session")
                                    ? planner_->WatchRobot(RobotOf(with))
                                    : operator_->WatchRobot(with["mission"], with["robot"]));
    PLUMESCOUT_ASSIGN_OR_RETURN(const RobotNotice notice, watch->Read(kPatience));
    return TellStanding(std::get<RobotStanding>(notice));
  }
  Answer OrderHome(const Json& with) {
    std::optional<RobotId> robot;
    if (with.contains("robot")) robot = with["robot"].get<RobotId>();
    return Nothing(operator_->OrderHome(with["mission"], robot, with["home"]));
  }
  Answer ReleaseLease(const Json& with) {
    if (!with.contains("session")) {
      return Nothing(operator_->ReleaseLease(with["mission"], with["robot"]));
    }
    return Nothing(planner_->ReleaseLease(RobotOf(with)));
  }
  Answer RemoveRobot(const Json& with) {
    if (!with.contains("session")) {
      return Nothing(operator_->RemoveRobot(with["mission"], with["robot"]));
    }
    const RobotSession& robot = RobotOf(with);
    return Nothing(
        planner_->RemoveRobot(robot.mission, robot.robot, robot.lease_token, /*force=*/false));
  }

  // Plans.
  PlanQuery QueryOf(const Json& with) {
    const RobotSession& robot = RobotOf(with);
    PlanQuery query{.lease_token = robot.lease_token,
                    .budget = absl::Seconds(with["budget_s"].get<double>()),
                    .timeout = kPatience};
    query.request.robot = robot.robot;
    query.request.seed = with["seed"];
    return query;
  }
  Answer Took(const Json& with, const Plan& plan) {
    plans_[with.value("plan", "")] = plan.id;
    return TellPlan(plan);
  }
  Answer NextBestTrajectory(const Json& with) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const Plan plan,
                                planner_->NextBestTrajectory(RobotOf(with).mission, QueryOf(with)));
    return Took(with, plan);
  }
  Answer StreamNextBestTrajectory(const Json& with) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const auto stream, planner_->StreamNextBestTrajectory(
                                                       RobotOf(with).mission, QueryOf(with)));
    std::optional<Plan> last;
    while (true) {
      PLUMESCOUT_ASSIGN_OR_RETURN(std::optional<Plan> plan, stream->Read(kPatience));
      if (!plan) break;
      last = std::move(plan);
    }
    if (!last) return absl::DataLossError("the stream ended without a plan");
    return Took(with, *last);
  }
  Answer CheckTrajectory(const Json& with) {
    TrajectoryQuery query;
    if (with.contains("plan")) {
      query.subject = plans_.at(with["plan"]);
    } else {
      query.subject = ReadPath(with);
    }
    PLUMESCOUT_ASSIGN_OR_RETURN(const TrajectoryCheck check,
                                planner_->CheckTrajectory(RobotOf(with), query));
    return TellCheck(check.verdict);
  }
  Answer ListFrontiers(const Json& with) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const FrontierList list,
                                viewer_->ListFrontiers(RobotOf(with).mission, RobotOf(with).robot));
    return Json{{"frontiers", TellAll(list.frontiers, TellFrontier)}};
  }
  Answer ReportProgress(const Json& with) {
    return Nothing(planner_->ReportProgress(RobotOf(with), plans_.at(with["plan"]),
                                            ReadOutcome(with["outcome"])));
  }
  Answer ListPlans(const Json& with) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const PlanList list,
                                viewer_->ListPlans(with["mission"], /*with_latest=*/false));
    return Json{{"plans", TellAll(list.live, TellLivePlan)}};
  }
  Answer PlanTeam(const Json& with) {
    PLUMESCOUT_ASSIGN_OR_RETURN(
        const TeamPlans team,
        operator_->PlanTeam(with["mission"],
                            {.robots = with["robots"],
                             .seed = with["seed"],
                             .max_order_count = with["max_order_count"],
                             .budget = absl::Seconds(with["budget_s"].get<double>()),
                             .timeout = kPatience}));
    Json plans = Json::array();
    for (const Plan& plan : team.plans) {
      plans.push_back(TellPlan(plan));
      plans.back()["robot"] = plan.robot;
    }
    const Json left_out = TellAll(team.left_out, [](const auto& one) { return one.robot; });
    return Json{{"plans", plans}, {"left_out", left_out}};
  }

  // Maps.
  Answer GetMap(const Json& with) {
    const MapQuery query{.view = ReadView(with),
                         .fresh_posterior = true,
                         .revision = with.value("revision", std::int64_t{0}),
                         .max_part_bytes = with.value("max_part_bytes", 0)};
    PLUMESCOUT_ASSIGN_OR_RETURN(const MapSnapshot map, viewer_->GetMap(with["mission"], query));
    return TellMap(map, query.view);
  }
  Answer WatchMap(const Json& with) {
    const MapView view = ReadView(with);
    PLUMESCOUT_ASSIGN_OR_RETURN(const auto watch,
                                viewer_->WatchMap(with["mission"], {.view = view}));
    PLUMESCOUT_RETURN_IF_ERROR(watch->Read(kPatience).status());
    if (with.contains("during")) {
      PLUMESCOUT_RETURN_IF_ERROR(StreamObservations(with["during"]).status());
      const Session& session = sessions_.at(with["during"]["session"]);
      while (AppliedIn(watch->map(), session.robot.robot) < session.last_sequence) {
        PLUMESCOUT_RETURN_IF_ERROR(watch->Read(kPatience).status());
      }
    }
    return TellMap(watch->map(), view);
  }
  Answer QueryGas(const Json& with) {
    GasQuery query{.fresh_posterior = true, .revision = with.value("revision", 0)};
    for (const Json& point : with["points"]) query.points.push_back({point[0], point[1]});
    PLUMESCOUT_ASSIGN_OR_RETURN(const GasAnswer answer, viewer_->QueryGas(with["mission"], query));
    return TellGas(answer);
  }

  const Json scenario_;
  std::unique_ptr<PlannerClient> planner_;
  std::unique_ptr<ViewerClient> viewer_;
  std::unique_ptr<OperatorClient> operator_;
  std::unique_ptr<ServerClient> server_;
  std::map<std::string, Session> sessions_;
  std::map<std::string, PlanId> plans_;
};

}  // namespace

Steps MakeSteps(const std::string& target, Json scenario) {
  const auto runner = std::make_shared<Runner>(target, std::move(scenario));
  return [runner](const std::string& kind, const Json& with) { return runner->Do(kind, with); };
}

}  // namespace plumescout::client
