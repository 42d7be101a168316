// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/faulty_link.h"

#include <string>
#include <utility>

#include "core/types/status_macros.h"

namespace plumescout::lab {

class FaultyLink::Stream final : public client::ObservationStream {
 public:
  Stream(const FaultyLink& link, std::unique_ptr<client::ObservationStream> inner)
      : link_(link), cuts_(link.cuts_), inner_(std::move(inner)) {}

  const client::IngestState& opened() const override { return inner_->opened(); }
  std::string server_boot_id() const override { return inner_->server_boot_id(); }
  absl::Status Write(const std::vector<Observation>& batch) override {
    PLUMESCOUT_RETURN_IF_ERROR(Check());
    return inner_->Write(batch);
  }
  absl::StatusOr<client::IngestReply> Read(absl::Duration timeout) override {
    PLUMESCOUT_RETURN_IF_ERROR(Check());
    return inner_->Read(timeout);
  }
  absl::Status Finish() override {
    PLUMESCOUT_RETURN_IF_ERROR(Check());
    return inner_->Finish();
  }

 private:
  absl::Status Check() const {
    if (cuts_ == link_.cuts_) return link_.Check();
    return absl::UnavailableError("the link was cut");
  }

  const FaultyLink& link_;
  const int cuts_;  // when it was opened
  const std::unique_ptr<client::ObservationStream> inner_;
};

// Opens the service's when it can.
class FaultyLink::Watch final : public client::RobotWatch {
 public:
  Watch(FaultyLink& link, client::RobotSession session)
      : link_(link), session_(std::move(session)) {}

  absl::StatusOr<RobotNotice> Read(absl::Duration timeout) override {
    if (cancelled_) return absl::CancelledError("the watch was cancelled");
    if (link_.state() != LinkState::kUp) return absl::DeadlineExceededError("the link is down");
    if (inner_ == nullptr) {
      PLUMESCOUT_ASSIGN_OR_RETURN(inner_, link_.service_.WatchRobot(session_));
    }
    return inner_->Read(timeout);
  }
  // One that waits comes back after its timeout.
  void Cancel() override { cancelled_ = true; }

 private:
  FaultyLink& link_;
  const client::RobotSession session_;
  std::unique_ptr<client::RobotWatch> inner_;
  std::atomic<bool> cancelled_ = false;
};

void FaultyLink::Set(LinkState state) {
  if (state_.exchange(state) == LinkState::kUp && state != LinkState::kUp) ++cuts_;
}

absl::Status FaultyLink::Check() const {
  return state_ == LinkState::kUp ? absl::OkStatus() : absl::UnavailableError("the link is down");
}

absl::Status FaultyLink::CreateMission(const MissionId& mission, const MissionOptions& options) {
  PLUMESCOUT_RETURN_IF_ERROR(Check());
  return service_.CreateMission(mission, options);
}

absl::StatusOr<std::vector<MissionId>> FaultyLink::ListMissions() {
  PLUMESCOUT_RETURN_IF_ERROR(Check());
  return service_.ListMissions();
}

absl::Status FaultyLink::DeleteMission(const MissionId& mission) {
  PLUMESCOUT_RETURN_IF_ERROR(Check());
  return service_.DeleteMission(mission);
}

absl::StatusOr<client::RobotSession> FaultyLink::RegisterRobot(const MissionId& mission,
                                                               const RobotId& robot,
                                                               double radius_m, bool take_over,
                                                               std::int64_t log_epoch,
                                                               const client::RobotOutfit& outfit) {
  PLUMESCOUT_RETURN_IF_ERROR(Check());
  return service_.RegisterRobot(mission, robot, radius_m, take_over, log_epoch, outfit);
}

absl::Status FaultyLink::RemoveRobot(const MissionId& mission, const RobotId& robot,
                                     std::int64_t lease_token, bool force) {
  PLUMESCOUT_RETURN_IF_ERROR(Check());
  return service_.RemoveRobot(mission, robot, lease_token, force);
}

absl::StatusOr<std::unique_ptr<client::ObservationStream>> FaultyLink::OpenObservationStream(
    const client::RobotSession& session) {
  PLUMESCOUT_RETURN_IF_ERROR(Check());
  PLUMESCOUT_ASSIGN_OR_RETURN(auto inner, service_.OpenObservationStream(session));
  return std::make_unique<Stream>(*this, std::move(inner));
}

absl::StatusOr<Plan> FaultyLink::NextBestTrajectory(const MissionId& mission,
                                                    const client::PlanQuery& query) {
  PLUMESCOUT_RETURN_IF_ERROR(Check());
  return service_.NextBestTrajectory(mission, query);
}

absl::Status FaultyLink::ReportProgress(const client::RobotSession& session, PlanId plan,
                                        ProgressOutcome outcome) {
  if (state_ == LinkState::kGone) return absl::OkStatus();
  PLUMESCOUT_RETURN_IF_ERROR(Check());
  return service_.ReportProgress(session, plan, outcome);
}

absl::StatusOr<std::unique_ptr<client::RobotWatch>> FaultyLink::WatchRobot(
    const client::RobotSession& session) {
  return std::make_unique<Watch>(*this, session);
}

absl::StatusOr<MapSnapshot> FaultyLink::GetMap(const MissionId& mission) {
  PLUMESCOUT_RETURN_IF_ERROR(Check());
  return service_.GetMap(mission);
}

}  // namespace plumescout::lab
