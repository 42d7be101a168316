// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/client/fake_planner_client.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"

namespace plumescout::client {

class FakePlannerClient::Stream final : public ObservationStream {
 public:
  Stream(FakePlannerClient& server, std::int64_t lease, int generation, const IngestState& opened)
      : server_(server), lease_(lease), generation_(generation), opened_(opened) {}

  const IngestState& opened() const override { return opened_; }

  absl::Status Write(const std::vector<Observation>& batch) override {
    absl::MutexLock lock(&server_.mutex_);
    PLUMESCOUT_RETURN_IF_ERROR(Alive());
    server_.largest_batch_ = std::max(server_.largest_batch_, static_cast<int>(batch.size()));
    for (const Observation& observation : batch) {
      PLUMESCOUT_RETURN_IF_ERROR(server_.Take(observation, replies_));
    }
    replies_.push_back(server_.State());
    return absl::OkStatus();
  }

  absl::StatusOr<IngestReply> Read(absl::Duration timeout) override {
    absl::MutexLock lock(&server_.mutex_);
    const auto settled = [this]() ABSL_EXCLUSIVE_LOCKS_REQUIRED(server_.mutex_) {
      return !replies_.empty() || !Alive().ok();
    };
    server_.mutex_.AwaitWithTimeout(absl::Condition(&settled), timeout);
    PLUMESCOUT_RETURN_IF_ERROR(Alive());
    if (replies_.empty()) return absl::DeadlineExceededError("nothing");
    IngestReply reply = replies_.front();
    replies_.pop_front();
    return reply;
  }

  absl::Status Finish() override {
    absl::MutexLock lock(&server_.mutex_);
    return Alive();
  }

 private:
  absl::Status Alive() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(server_.mutex_) {
    PLUMESCOUT_RETURN_IF_ERROR(server_.LinkStatus());
    PLUMESCOUT_RETURN_IF_ERROR(server_.LeaseStatus(lease_));
    if (generation_ != server_.generation_) return absl::UnavailableError("stream is gone");
    return absl::OkStatus();
  }

  FakePlannerClient& server_;
  const std::int64_t lease_;
  const int generation_;
  const IngestState opened_;
  std::deque<IngestReply> replies_;
};

Plan CompletePlan() {
  Plan plan;
  plan.phase = MissionPhase::kComplete;
  return plan;
}

void FakePlannerClient::set_script(PlanScript script) {
  absl::MutexLock lock(&mutex_);
  script_ = std::move(script);
}

void FakePlannerClient::set_credit_window(std::int64_t window) {
  absl::MutexLock lock(&mutex_);
  credit_window_ = window;
}

void FakePlannerClient::set_durable(bool durable) {
  absl::MutexLock lock(&mutex_);
  durable_ = durable;
}

void FakePlannerClient::set_report_answer(absl::Status answer) {
  absl::MutexLock lock(&mutex_);
  report_answer_ = std::move(answer);
}

void FakePlannerClient::RefuseObservation(std::int64_t sequence) {
  absl::MutexLock lock(&mutex_);
  refused_.insert(sequence);
}

void FakePlannerClient::BreakLink() {
  absl::MutexLock lock(&mutex_);
  link_up_ = false;
  ++generation_;
}

void FakePlannerClient::MendLink() {
  absl::MutexLock lock(&mutex_);
  link_up_ = true;
}

void FakePlannerClient::Restart() {
  absl::MutexLock lock(&mutex_);
  ++generation_;
  ++boot_;
  mission_exists_ = registered_ = false;
  applied_ = 0;
  received_.clear();
}

void FakePlannerClient::SupersedeLease() {
  absl::MutexLock lock(&mutex_);
  ++generation_;
  ++lease_;
}

void FakePlannerClient::Preload(std::int64_t applied) {
  absl::MutexLock lock(&mutex_);
  mission_exists_ = true;
  applied_ = applied;
}

std::vector<Observation> FakePlannerClient::received() const {
  absl::MutexLock lock(&mutex_);
  return received_;
}

std::int64_t FakePlannerClient::applied() const {
  absl::MutexLock lock(&mutex_);
  return applied_;
}

std::vector<FakePlannerClient::Report> FakePlannerClient::reports() const {
  absl::MutexLock lock(&mutex_);
  return reports_;
}

std::vector<FakePlannerClient::Registration> FakePlannerClient::registrations() const {
  absl::MutexLock lock(&mutex_);
  return registrations_;
}

int FakePlannerClient::streams_opened() const {
  absl::MutexLock lock(&mutex_);
  return streams_opened_;
}

int FakePlannerClient::largest_batch() const {
  absl::MutexLock lock(&mutex_);
  return largest_batch_;
}

absl::Status FakePlannerClient::CreateMission(const MissionId&, const MissionOptions&) {
  absl::MutexLock lock(&mutex_);
  PLUMESCOUT_RETURN_IF_ERROR(LinkStatus());
  if (mission_exists_) return absl::AlreadyExistsError("mission");
  mission_exists_ = true;
  return absl::OkStatus();
}

absl::StatusOr<std::vector<MissionId>> FakePlannerClient::ListMissions() {
  return std::vector<MissionId>{};
}

absl::Status FakePlannerClient::DeleteMission(const MissionId&) { return absl::OkStatus(); }

absl::StatusOr<RobotSession> FakePlannerClient::RegisterRobot(const MissionId& mission,
                                                              const RobotId& robot, double radius_m,
                                                              bool take_over) {
  absl::MutexLock lock(&mutex_);
  PLUMESCOUT_RETURN_IF_ERROR(LinkStatus());
  if (!mission_exists_) return absl::NotFoundError("mission");
  registered_ = true;
  registrations_.push_back({mission, robot, radius_m, take_over});
  return RobotSession{mission, robot, ++lease_, absl::StrCat("boot-", boot_), State()};
}

absl::Status FakePlannerClient::RemoveRobot(const MissionId&, const RobotId&,
                                            std::int64_t lease_token, bool force) {
  absl::MutexLock lock(&mutex_);
  PLUMESCOUT_RETURN_IF_ERROR(LinkStatus());
  if (!force) PLUMESCOUT_RETURN_IF_ERROR(LeaseStatus(lease_token));
  registered_ = false;
  return absl::OkStatus();
}

absl::StatusOr<std::unique_ptr<ObservationStream>> FakePlannerClient::OpenObservationStream(
    const RobotSession& session) {
  absl::MutexLock lock(&mutex_);
  PLUMESCOUT_RETURN_IF_ERROR(LinkStatus());
  PLUMESCOUT_RETURN_IF_ERROR(LeaseStatus(session.lease_token));
  ++streams_opened_;
  return std::make_unique<Stream>(*this, session.lease_token, generation_, State());
}

absl::StatusOr<Plan> FakePlannerClient::NextBestTrajectory(const MissionId&,
                                                           const PlanQuery& query) {
  PlanScript script;
  {
    absl::MutexLock lock(&mutex_);
    PLUMESCOUT_RETURN_IF_ERROR(LinkStatus());
    PLUMESCOUT_RETURN_IF_ERROR(LeaseStatus(query.lease_token));
    const auto arrived = [&]() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
      return applied_ >= query.min_applied_sequence;
    };
    if (!mutex_.AwaitWithTimeout(absl::Condition(&arrived), query.timeout)) {
      return absl::DeadlineExceededError("not applied yet");
    }
    script = script_;
  }
  return script(query);
}

absl::Status FakePlannerClient::ReportProgress(const RobotSession& session, PlanId plan,
                                               ProgressOutcome outcome) {
  absl::MutexLock lock(&mutex_);
  PLUMESCOUT_RETURN_IF_ERROR(LinkStatus());
  PLUMESCOUT_RETURN_IF_ERROR(LeaseStatus(session.lease_token));
  PLUMESCOUT_RETURN_IF_ERROR(report_answer_);
  reports_.push_back({plan, outcome, applied_});
  return absl::OkStatus();
}

absl::StatusOr<MapSnapshot> FakePlannerClient::GetMap(const MissionId&) { return MapSnapshot{}; }

absl::Status FakePlannerClient::LinkStatus() const {
  return link_up_ ? absl::OkStatus() : absl::UnavailableError("link is down");
}

absl::Status FakePlannerClient::LeaseStatus(std::int64_t lease) const {
  if (!registered_) return absl::NotFoundError("robot");
  if (lease != lease_) return absl::FailedPreconditionError("LEASE_SUPERSEDED: newer lease");
  return absl::OkStatus();
}

IngestState FakePlannerClient::State() const {
  return {.applied_sequence = applied_,
          .durable_sequence = durable_ ? applied_ : 0,
          .credit_sequence = applied_ + credit_window_,
          .revision = applied_};
}

absl::Status FakePlannerClient::Take(const Observation& observation,
                                     std::deque<IngestReply>& replies) {
  if (observation.sequence <= applied_) return absl::OkStatus();
  if (observation.sequence != applied_ + 1) {
    return absl::FailedPreconditionError(absl::StrCat("SEQUENCE_GAP: expected ", applied_ + 1));
  }
  applied_ = LastSequence(observation);
  received_.push_back(observation);
  if (refused_.contains(observation.sequence)) {
    replies.push_back(
        ObservationRejected{observation.sequence, absl::OutOfRangeError("outside the mission")});
  }
  return absl::OkStatus();
}

}  // namespace plumescout::client
