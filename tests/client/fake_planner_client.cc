// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/client/fake_planner_client.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"
#include "client/error_reason.h"
#include "core/types/status_macros.h"
#include "proto/convert/status.h"

namespace plumescout::client {

class FakePlannerClient::Stream final : public ObservationStream {
 public:
  Stream(FakePlannerClient& server, std::int64_t lease, int generation, int link,
         const IngestState& opened, std::string boot_id)
      : server_(server),
        lease_(lease),
        generation_(generation),
        link_(link),
        opened_(opened),
        boot_id_(std::move(boot_id)) {}

  const IngestState& opened() const override { return opened_; }
  std::string server_boot_id() const override { return boot_id_; }

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
    if (link_ != server_.links_) return absl::UnavailableError("the link was broken");
    PLUMESCOUT_RETURN_IF_ERROR(server_.LeaseStatus(lease_));
    if (generation_ != server_.generation_) return absl::UnavailableError("stream is gone");
    return absl::OkStatus();
  }

  FakePlannerClient& server_;
  const std::int64_t lease_;
  const int generation_;
  const int link_;
  const IngestState opened_;
  const std::string boot_id_;
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

void FakePlannerClient::set_durable(bool durable, std::int64_t lag) {
  absl::MutexLock lock(&mutex_);
  durable_sequence_ = DurableSequence();
  durable_ = durable;
  durable_lag_ = lag;
}

void FakePlannerClient::set_report_answer(absl::Status answer) {
  absl::MutexLock lock(&mutex_);
  report_answer_ = std::move(answer);
}

void FakePlannerClient::RefuseObservation(std::int64_t sequence) {
  absl::MutexLock lock(&mutex_);
  refused_.insert(sequence);
}

void FakePlannerClient::BreakLink() { BreakLink(absl::UnavailableError("link is down")); }

void FakePlannerClient::BreakLink(absl::Status status) {
  absl::MutexLock lock(&mutex_);
  link_ = std::move(status);
  ++links_;
}

void FakePlannerClient::MendLink() {
  absl::MutexLock lock(&mutex_);
  link_ = absl::OkStatus();
}

void FakePlannerClient::Restart() {
  absl::MutexLock lock(&mutex_);
  ++links_;
  ++boot_;
  mission_exists_ = registered_ = false;
  applied_ = log_epoch_ = durable_sequence_ = preloaded_ = 0;
  received_.clear();
}

void FakePlannerClient::Crash() {
  absl::MutexLock lock(&mutex_);
  FallBackTo(DurableSequence());
}

void FakePlannerClient::SetBack(std::int64_t applied, bool forget_lease) {
  absl::MutexLock lock(&mutex_);
  FallBackTo(applied);
  if (forget_lease) lease_ += 1000;  // of another life
}

void FakePlannerClient::FallBackTo(std::int64_t applied) {
  ++links_;
  ++boot_;
  while (!received_.empty() && LastSequence(received_.back()) > applied) received_.pop_back();
  applied_ = received_.empty() ? std::min(applied, preloaded_) : LastSequence(received_.back());
  durable_sequence_ = applied_;
}

void FakePlannerClient::SupersedeLease() {
  absl::MutexLock lock(&mutex_);
  ++generation_;
  ++lease_;
  held_by_other_ = true;
}

void FakePlannerClient::LetGoOfLease() {
  absl::MutexLock lock(&mutex_);
  held_by_other_ = false;
}

void FakePlannerClient::Intrude(std::int64_t log_epoch, int observations) {
  absl::MutexLock lock(&mutex_);
  ++generation_;
  ++lease_;
  log_epoch_ = log_epoch;
  for (int i = 0; i < observations; ++i) {
    received_.push_back({.sequence = ++applied_, .sample_time_ns = -1, .pose = {}, .payload = {}});
  }
}

void FakePlannerClient::Preload(std::int64_t applied) {
  absl::MutexLock lock(&mutex_);
  mission_exists_ = true;
  applied_ = preloaded_ = applied;
}

std::vector<Observation> FakePlannerClient::received() const {
  absl::MutexLock lock(&mutex_);
  return received_;
}

std::int64_t FakePlannerClient::applied() const {
  absl::MutexLock lock(&mutex_);
  return applied_;
}

bool FakePlannerClient::AwaitApplied(std::int64_t sequence, absl::Duration timeout) const {
  const auto is_applied = [&]() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    return applied_ >= sequence;
  };
  absl::MutexLock lock(&mutex_);
  return mutex_.AwaitWithTimeout(absl::Condition(&is_applied), timeout);
}

bool FakePlannerClient::AwaitPlans(std::size_t count, absl::Duration timeout) const {
  const auto are_given = [&]() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    return plans_given_ >= count;
  };
  absl::MutexLock lock(&mutex_);
  return mutex_.AwaitWithTimeout(absl::Condition(&are_given), timeout);
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
                                                              bool take_over,
                                                              std::int64_t log_epoch,
                                                              const RobotOutfit& outfit) {
  absl::MutexLock lock(&mutex_);
  PLUMESCOUT_RETURN_IF_ERROR(LinkStatus());
  if (!mission_exists_) return absl::NotFoundError("mission");
  if (held_by_other_ && !take_over) return absl::FailedPreconditionError("LEASE_HELD: by another");
  held_by_other_ = false;
  registered_ = true;
  registrations_.push_back({mission, robot, radius_m, take_over, log_epoch, outfit});
  const bool continues =
      applied_ == 0 || log_epoch == 0 || log_epoch_ == 0 || log_epoch == log_epoch_;
  if (log_epoch != 0) log_epoch_ = log_epoch;
  return RobotSession{mission, robot, ++lease_, BootId(), State(), continues};
}

absl::Status FakePlannerClient::RemoveRobot(const MissionId&, const RobotId&,
                                            std::int64_t lease_token, bool force) {
  absl::MutexLock lock(&mutex_);
  PLUMESCOUT_RETURN_IF_ERROR(LinkStatus());
  if (!force) PLUMESCOUT_RETURN_IF_ERROR(LeaseStatus(lease_token));
  registered_ = false;
  return absl::OkStatus();
}

std::int64_t FakePlannerClient::robot_clock_ns() const {
  absl::MutexLock lock(&mutex_);
  return robot_clock_ns_;
}

absl::StatusOr<std::unique_ptr<ObservationStream>> FakePlannerClient::OpenObservationStream(
    const RobotSession& session) {
  absl::MutexLock lock(&mutex_);
  PLUMESCOUT_RETURN_IF_ERROR(LinkStatus());
  PLUMESCOUT_RETURN_IF_ERROR(LeaseStatus(session.lease_token));
  if (session.durable_sequence > applied_) {
    return WithReason(
        TypedError(absl::StatusCode::kFailedPrecondition, kStoreRolledBack, "set back"),
        kStoreRolledBack, {{"applied_sequence", absl::StrCat(applied_)}});
  }
  ++streams_opened_;
  robot_clock_ns_ = session.robot_clock_ns ? session.robot_clock_ns() : 0;
  return std::make_unique<Stream>(*this, session.lease_token, generation_, links_, State(),
                                  BootId());
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
  absl::StatusOr<Plan> plan = script(query);
  absl::MutexLock lock(&mutex_);
  ++plans_given_;
  return plan;
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

// Begins with what is told after it opened.
class FakePlannerClient::Watch final : public RobotWatch {
 public:
  Watch(FakePlannerClient* server, int link, std::size_t next)
      : server_(*server), link_(link), next_(next) {}

  absl::StatusOr<RobotNotice> Read(absl::Duration timeout) override {
    absl::MutexLock lock(&server_.mutex_);
    const auto ready = [this]() ABSL_EXCLUSIVE_LOCKS_REQUIRED(server_.mutex_) {
      return cancelled_ || link_ != server_.links_ || next_ < server_.notices_.size();
    };
    if (!server_.mutex_.AwaitWithTimeout(absl::Condition(&ready), timeout)) {
      return absl::DeadlineExceededError("no notice yet");
    }
    if (cancelled_) return absl::CancelledError("the watch was cancelled");
    if (link_ != server_.links_) return absl::UnavailableError("the link broke");
    return server_.notices_[next_++];
  }
  void Cancel() override {
    absl::MutexLock lock(&server_.mutex_);
    cancelled_ = true;
  }

 private:
  FakePlannerClient& server_;
  const int link_;
  std::size_t next_;
  bool cancelled_ = false;
};

void FakePlannerClient::set_watched(bool watched) {
  absl::MutexLock lock(&mutex_);
  watched_ = watched;
}

void FakePlannerClient::Notify(RobotNotice notice) {
  absl::MutexLock lock(&mutex_);
  notices_.push_back(std::move(notice));
}

int FakePlannerClient::watches_opened() const {
  absl::MutexLock lock(&mutex_);
  return watches_opened_;
}

absl::StatusOr<std::unique_ptr<RobotWatch>> FakePlannerClient::WatchRobot(
    const RobotSession& session) {
  absl::MutexLock lock(&mutex_);
  if (!watched_) return absl::UnimplementedError("robots are not watched here");
  if (absl::Status status = LinkStatus(); !status.ok()) return status;
  if (absl::Status status = LeaseStatus(session.lease_token); !status.ok()) return status;
  ++watches_opened_;
  return std::make_unique<Watch>(this, links_, notices_.size());
}

absl::StatusOr<MapSnapshot> FakePlannerClient::GetMap(const MissionId&) { return MapSnapshot{}; }

absl::Status FakePlannerClient::LinkStatus() const { return link_; }

absl::Status FakePlannerClient::LeaseStatus(std::int64_t lease) const {
  if (!registered_) return absl::NotFoundError("robot");
  if (lease != lease_) return absl::FailedPreconditionError("LEASE_SUPERSEDED: newer lease");
  return absl::OkStatus();
}

IngestState FakePlannerClient::State() const {
  return {.applied_sequence = applied_,
          .durable_sequence = DurableSequence(),
          .credit_sequence = applied_ + credit_window_,
          .revision = applied_};
}

std::int64_t FakePlannerClient::DurableSequence() const {
  return durable_ ? std::max(durable_sequence_, applied_ - durable_lag_) : 0;
}

std::string FakePlannerClient::BootId() const { return absl::StrCat("boot-", boot_); }

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
