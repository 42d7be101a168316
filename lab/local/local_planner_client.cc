// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/local/local_planner_client.h"

#include <deque>
#include <functional>
#include <optional>
#include <utility>

#include "core/mission/conduct/conduct_errors.h"
#include "core/types/status_macros.h"
#include "lab/local/local_robot_watch.h"

namespace plumescout::lab {
namespace {

// Anything but empty: the process never restarts under its clients.
constexpr char kBootId[] = "local";

class LocalObservationStream final : public client::ObservationStream {
 public:
  LocalObservationStream(std::shared_ptr<LocalMission> mission, const client::RobotSession& session,
                         StreamId stream, const client::IngestState& opened)
      : mission_(std::move(mission)),
        robot_(session.robot),
        lease_token_(session.lease_token),
        stream_(stream),
        robot_clock_ns_(session.robot_clock_ns),
        opened_(opened) {}
  ~LocalObservationStream() override { mission_->CloseStream(robot_, stream_); }

  const client::IngestState& opened() const override { return opened_; }
  std::string server_boot_id() const override { return kBootId; }

  absl::Status Write(const std::vector<Observation>& batch) override {
    if (ended_.ok() && robot_clock_ns_) {
      ended_ = mission_->NoteClock(robot_, lease_token_, robot_clock_ns_());
    }
    if (!ended_.ok()) return ended_;
    std::vector<client::ObservationRejected> rejected;
    ended_ = mission_->Ingest(robot_, lease_token_, stream_, batch, rejected);
    for (client::ObservationRejected& one : rejected) replies_.push_back(std::move(one));
    const auto state = mission_->StreamState(robot_, lease_token_, stream_);
    if (state.ok()) replies_.push_back(*state);
    return ended_;
  }

  absl::StatusOr<client::IngestReply> Read(absl::Duration timeout) override {
    if (!replies_.empty()) {
      client::IngestReply reply = std::move(replies_.front());
      replies_.pop_front();
      return reply;
    }
    if (!ended_.ok()) return ended_;
    const absl::Status status = mission_->AwaitStreamEnd(robot_, lease_token_, stream_, timeout);
    if (!absl::IsDeadlineExceeded(status)) ended_ = status;
    return status;
  }

  absl::Status Finish() override {
    PLUMESCOUT_RETURN_IF_ERROR(ended_);
    ended_ = absl::FailedPreconditionError("the stream is finished");
    const absl::Status status = mission_->StreamState(robot_, lease_token_, stream_).status();
    mission_->CloseStream(robot_, stream_);
    return status;
  }

 private:
  const std::shared_ptr<LocalMission> mission_;
  const RobotId robot_;
  const std::int64_t lease_token_;
  const StreamId stream_;
  const std::function<std::int64_t()> robot_clock_ns_;  // null: it does not say
  const client::IngestState opened_;
  std::deque<client::IngestReply> replies_;
  absl::Status ended_;
};

}  // namespace

absl::Status LocalPlannerClient::CreateMission(const MissionId& mission,
                                               const MissionOptions& options) {
  PLUMESCOUT_RETURN_IF_ERROR(ValidateId("mission_id", mission));
  PLUMESCOUT_ASSIGN_OR_RETURN(std::shared_ptr<LocalMission> created,
                              LocalMission::Create(options, options_));
  absl::MutexLock lock(&mutex_);
  if (!missions_.emplace(mission, std::move(created)).second) {
    return MissionExists(mission);
  }
  return absl::OkStatus();
}

absl::StatusOr<std::vector<MissionId>> LocalPlannerClient::ListMissions() {
  absl::MutexLock lock(&mutex_);
  std::vector<MissionId> missions;
  for (const auto& [id, mission] : missions_) missions.push_back(id);
  return missions;
}

absl::Status LocalPlannerClient::DeleteMission(const MissionId& mission) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::shared_ptr<LocalMission> found, Find(mission));
  found->Close(MissionNotFound(mission));
  absl::MutexLock lock(&mutex_);
  missions_.erase(mission);
  return absl::OkStatus();
}

absl::StatusOr<client::RobotSession> LocalPlannerClient::RegisterRobot(
    const MissionId& mission, const RobotId& robot, double radius_m, bool take_over,
    std::int64_t log_epoch, const client::RobotOutfit& outfit) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::shared_ptr<LocalMission> found, Find(mission));
  PLUMESCOUT_ASSIGN_OR_RETURN(client::RobotSession session,
                              found->Register({.robot = robot,
                                               .radius_m = radius_m,
                                               .take_over = take_over,
                                               .log_epoch = log_epoch,
                                               .frame = outfit.frame,
                                               .sensors = outfit.sensors}));
  session.mission = mission;
  session.server_boot_id = kBootId;
  return session;
}

absl::Status LocalPlannerClient::RemoveRobot(const MissionId& mission, const RobotId& robot,
                                             std::int64_t lease_token, bool force) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::shared_ptr<LocalMission> found, Find(mission));
  return found->Remove({robot, force ? std::nullopt : std::optional(lease_token)});
}

absl::StatusOr<std::unique_ptr<client::ObservationStream>>
LocalPlannerClient::OpenObservationStream(const client::RobotSession& session) {
  PLUMESCOUT_ASSIGN_OR_RETURN(std::shared_ptr<LocalMission> mission, Find(session.mission));
  PLUMESCOUT_ASSIGN_OR_RETURN(const StreamId stream,
                              mission->OpenStream(session.robot, session.lease_token));
  PLUMESCOUT_ASSIGN_OR_RETURN(const client::IngestState opened,
                              mission->StreamState(session.robot, session.lease_token, stream));
  return std::make_unique<LocalObservationStream>(std::move(mission), session, stream, opened);
}

absl::StatusOr<Plan> LocalPlannerClient::NextBestTrajectory(const MissionId& mission,
                                                            const client::PlanQuery& query) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::shared_ptr<LocalMission> found, Find(mission));
  return found->NextPlan(query);
}

absl::StatusOr<CommittedTeam> LocalPlannerClient::PlanTeam(const MissionId& mission,
                                                           const TeamRequest& request,
                                                           absl::Duration budget) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::shared_ptr<LocalMission> found, Find(mission));
  return found->PlanForTeam(request, budget);
}

absl::Status LocalPlannerClient::ReportProgress(const client::RobotSession& session, PlanId plan,
                                                ProgressOutcome outcome) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::shared_ptr<LocalMission> found, Find(session.mission));
  return found->Report({.robot = session.robot, .plan_id = plan, .outcome = outcome},
                       session.lease_token);
}

absl::StatusOr<std::unique_ptr<client::RobotWatch>> LocalPlannerClient::WatchRobot(
    const client::RobotSession& session) {
  PLUMESCOUT_ASSIGN_OR_RETURN(std::shared_ptr<LocalMission> found, Find(session.mission));
  return std::make_unique<LocalRobotWatch>(std::move(found), session);
}

absl::StatusOr<MapSnapshot> LocalPlannerClient::GetMap(const MissionId& mission) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::shared_ptr<LocalMission> found, Find(mission));
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::shared_ptr<const Belief> belief, found->FreshBelief());
  return MakeMapSnapshot(*belief);
}

absl::StatusOr<std::shared_ptr<const Belief>> LocalPlannerClient::GetBelief(
    const MissionId& mission) const {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::shared_ptr<LocalMission> found, Find(mission));
  return found->Snapshot();
}

absl::StatusOr<std::shared_ptr<LocalMission>> LocalPlannerClient::Find(
    const MissionId& mission) const {
  absl::MutexLock lock(&mutex_);
  const auto found = missions_.find(mission);
  if (found == missions_.end()) return MissionNotFound(mission);
  return found->second;
}

}  // namespace plumescout::lab
