// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "absl/status/status.h"
#include "absl/time/time.h"
#include "client/ingest_session.h"
#include "client/planner_client.h"
#include "core/types/observation.h"
#include "core/types/plan.h"
#include "core/types/pose2.h"

namespace plumescout::client {

// One instant of a robot's run.
struct RobotTick {
  std::int64_t time_ns = 0;  // robot clock
  double elapsed_s = 0.0;    // since the robot joined
  Pose2 pose;
  PlanId plan = 0;  // being followed; 0 while the robot stands
  IngestStatistics ingest;
};

// A plan that arrived. The reference lives as long as the call.
struct PlanArrival {
  std::int64_t time_ns = 0;  // robot clock, when it was asked for
  double elapsed_s = 0.0;
  Pose2 pose;  // when it was asked for
  const Plan& plan;
  absl::Duration rpc_wall;
};

// Looks over a robot's shoulder: progress displays and recorders.
class RobotObserver {
 public:
  virtual ~RobotObserver() = default;

  // On the robot's thread. A slow observer slows the robot.
  virtual void OnTick(const RobotTick&) {}
  // What was just added to the log that the server is sent, with its number by then.
  virtual void OnLogged(const Observation&) {}
  virtual void OnPlan(const PlanArrival&) {}
  virtual void OnReport(PlanId, ProgressOutcome) {}
  virtual void OnPlanFailure(const absl::Status&) {}
  // Whether the server doubts that the robot is where it says it is: its scans contradict the map.
  // Until poses are corrected, or fit again, nothing that it senses counts.
  virtual void OnPlaceDoubted(bool /*doubted*/) {}

  // On the ingest session's thread.
  virtual void OnRejected(const ObservationRejected&) {}
  virtual void OnLink(const absl::Status&) {}  // OK: a stream is open; else why it ended
  // The server holds the log up to this number only, although it once held more durably; so many
  // of those that follow are forgotten here too.
  virtual void OnRolledBack(std::int64_t /*applied_sequence*/, std::int64_t /*forgotten*/) {}

  // On a thread of the log's own, or before all others: what of a log on disk could not be read,
  // or why it cannot be written; OK once it can again.
  virtual void OnDisk(const absl::Status&) {}
};

}  // namespace plumescout::client
