// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/synchronization/mutex.h"
#include "client/planner_client.h"
#include "core/types/status_macros.h"

namespace plumescout::client {

inline Plan CompletePlan() {
  Plan plan;
  plan.phase = MissionPhase::kComplete;
  return plan;
}

// A server of one mission and one robot that does what a test tells it to: lose the link, restart,
// refuse observations, answer plans from a script. Thread-safe.
class FakePlannerClient final : public PlannerClient {
  // Before its first use: the return type is deduced.
  template <typename F>
  auto Locked(F&& body) const {
    absl::MutexLock lock(&mutex_);
    return body();
  }

 public:
  struct Report {
    PlanId plan = 0;
    ProgressOutcome outcome = ProgressOutcome::kReached;
    std::int64_t applied_sequence = 0;  // when the report came

    friend bool operator==(const Report&, const Report&) = default;
  };
  using PlanScript = std::function<absl::StatusOr<Plan>(const PlanQuery&)>;

  void set_script(PlanScript script) {
    Locked([&] { script_ = std::move(script); });
  }
  void set_credit_window(std::int64_t window) {
    Locked([&] { credit_window_ = window; });
  }
  void set_durable(bool durable) {
    Locked([&] { durable_ = durable; });
  }
  void RefuseObservation(std::int64_t sequence) {
    Locked([&] { refused_.insert(sequence); });
  }

  // Every call fails and every stream is dead until the link is mended.
  void BreakLink() {
    Locked([&] {
      link_up_ = false;
      ++generation_;
    });
  }
  void MendLink() {
    Locked([&] { link_up_ = true; });
  }
  // Streams die and everything is forgotten, missions and robots too.
  void Restart() {
    Locked([&] {
      ++generation_;
      ++boot_;
      mission_exists_ = registered_ = false;
      applied_ = 0;
      received_.clear();
    });
  }
  // Another client takes the lease.
  void SupersedeLease() {
    Locked([&] {
      ++generation_;
      ++lease_;
    });
  }

  std::vector<Observation> received() const {
    return Locked([&] { return received_; });
  }
  std::int64_t applied() const {
    return Locked([&] { return applied_; });
  }
  std::vector<Report> reports() const {
    return Locked([&] { return reports_; });
  }
  int streams_opened() const {
    return Locked([&] { return streams_opened_; });
  }
  int largest_batch() const {
    return Locked([&] { return largest_batch_; });
  }
  // A robot that was here before: its log up to `applied` is in the mission.
  void Preload(std::int64_t applied) {
    Locked([&] {
      mission_exists_ = true;
      applied_ = applied;
    });
  }

  absl::Status CreateMission(const MissionId&, const MissionOptions&) override {
    return Locked([&] {
      PLUMESCOUT_RETURN_IF_ERROR(LinkStatus());
      if (mission_exists_) return absl::AlreadyExistsError("mission");
      mission_exists_ = true;
      return absl::OkStatus();
    });
  }
  absl::StatusOr<std::vector<MissionId>> ListMissions() override {
    return std::vector<MissionId>{};
  }
  absl::Status DeleteMission(const MissionId&) override { return absl::OkStatus(); }

  absl::StatusOr<RobotSession> RegisterRobot(const MissionId& mission, const RobotId& robot, double,
                                             bool) override {
    return Locked([&]() -> absl::StatusOr<RobotSession> {
      PLUMESCOUT_RETURN_IF_ERROR(LinkStatus());
      if (!mission_exists_) return absl::NotFoundError("mission");
      registered_ = true;
      return RobotSession{mission, robot, ++lease_, absl::StrCat("boot-", boot_), State()};
    });
  }
  absl::StatusOr<std::unique_ptr<ObservationStream>> OpenObservationStream(
      const RobotSession& session) override {
    return Locked([&]() -> absl::StatusOr<std::unique_ptr<ObservationStream>> {
      PLUMESCOUT_RETURN_IF_ERROR(LinkStatus());
      PLUMESCOUT_RETURN_IF_ERROR(LeaseStatus(session.lease_token));
      ++streams_opened_;
      return std::make_unique<Stream>(*this, session.lease_token, generation_, State());
    });
  }
  absl::StatusOr<Plan> NextBestTrajectory(const MissionId&, const PlanQuery& query) override {
    const PlanScript script = Locked([&] { return script_; });
    PLUMESCOUT_RETURN_IF_ERROR(Locked([&] {
      PLUMESCOUT_RETURN_IF_ERROR(LinkStatus());
      PLUMESCOUT_RETURN_IF_ERROR(LeaseStatus(query.lease_token));
      const auto arrived = [&] { return applied_ >= query.min_applied_sequence; };
      return mutex_.AwaitWithTimeout(absl::Condition(&arrived), query.timeout)
                 ? absl::OkStatus()
                 : absl::DeadlineExceededError("not applied yet");
    }));
    return script(query);
  }
  absl::Status ReportProgress(const RobotSession& session, PlanId plan,
                              ProgressOutcome outcome) override {
    return Locked([&] {
      PLUMESCOUT_RETURN_IF_ERROR(LinkStatus());
      PLUMESCOUT_RETURN_IF_ERROR(LeaseStatus(session.lease_token));
      reports_.push_back({plan, outcome, applied_});
      return absl::OkStatus();
    });
  }
  absl::StatusOr<MapSnapshot> GetMap(const MissionId&) override { return MapSnapshot{}; }

 private:
  class Stream final : public ObservationStream {
   public:
    Stream(FakePlannerClient& server, std::int64_t lease, int generation, IngestState opened)
        : server_(server), lease_(lease), generation_(generation), opened_(opened) {}

    const IngestState& opened() const override { return opened_; }
    absl::Status Write(const std::vector<Observation>& batch) override {
      return server_.Locked([&] {
        PLUMESCOUT_RETURN_IF_ERROR(Alive());
        server_.largest_batch_ = std::max(server_.largest_batch_, static_cast<int>(batch.size()));
        for (const Observation& observation : batch) {
          PLUMESCOUT_RETURN_IF_ERROR(server_.Take(observation, replies_));
        }
        replies_.push_back(server_.State());
        return absl::OkStatus();
      });
    }
    absl::StatusOr<IngestReply> Read(absl::Duration timeout) override {
      return server_.Locked([&]() -> absl::StatusOr<IngestReply> {
        const auto settled = [&] { return !replies_.empty() || !Alive().ok(); };
        server_.mutex_.AwaitWithTimeout(absl::Condition(&settled), timeout);
        PLUMESCOUT_RETURN_IF_ERROR(Alive());
        if (replies_.empty()) return absl::DeadlineExceededError("nothing");
        IngestReply reply = replies_.front();
        replies_.pop_front();
        return reply;
      });
    }
    absl::Status Finish() override {
      return server_.Locked([&] { return Alive(); });
    }

   private:
    absl::Status Alive() const {
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

  absl::Status LinkStatus() const {
    return link_up_ ? absl::OkStatus() : absl::UnavailableError("link is down");
  }
  absl::Status LeaseStatus(std::int64_t lease) const {
    if (!registered_) return absl::NotFoundError("robot");
    if (lease != lease_) return absl::FailedPreconditionError("LEASE_SUPERSEDED: newer lease");
    return absl::OkStatus();
  }
  IngestState State() const {
    return {.applied_sequence = applied_,
            .durable_sequence = durable_ ? applied_ : 0,
            .credit_sequence = applied_ + credit_window_,
            .revision = applied_};
  }
  absl::Status Take(const Observation& observation, std::deque<IngestReply>& replies) {
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

  mutable absl::Mutex mutex_;
  PlanScript script_ = [](const PlanQuery&) { return CompletePlan(); };
  bool link_up_ = true;
  bool mission_exists_ = false;
  bool registered_ = false;
  bool durable_ = false;
  int boot_ = 1;
  int generation_ = 0;
  int streams_opened_ = 0;
  int largest_batch_ = 0;
  std::int64_t lease_ = 0;
  std::int64_t applied_ = 0;
  std::int64_t credit_window_ = 100;
  std::set<std::int64_t> refused_;
  std::vector<Observation> received_;
  std::vector<Report> reports_;
};

}  // namespace plumescout::client
