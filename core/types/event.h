// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "core/types/gas_sensor.h"
#include "core/types/ids.h"
#include "core/types/observation.h"
#include "core/types/plan.h"
#include "core/types/polygon.h"
#include "core/types/robot_frame.h"

namespace plumescout {

// A robot joined the mission, or came back with a new lease.
struct RobotRegistered {
  RobotId robot;
  double radius_m = 0.2;
  std::int64_t lease_token = 0;
  // Which log the robot's numbers are of, as its client drew it at random when it began the log; 0:
  // the client does not say. Another log than before goes on with numbers of its own after the last
  // one that was applied.
  std::int64_t log_epoch = 0;
  RobotFrame frame = {};  // of the poses of its observations
  // Its gas sensors, to which readings refer by their place. None: it has one, which is calibrated
  // and sits at the pose of the robot.
  std::vector<GasSensor> sensors = {};

  friend bool operator==(const RobotRegistered&, const RobotRegistered&) = default;
};

struct ObservationReceived {
  RobotId robot;
  Observation observation;

  friend bool operator==(const ObservationReceived&, const ObservationReceived&) = default;
};

// The posterior was brought up to date; `time_ns` is the instant to which readings were aged.
struct PosteriorRefreshed {
  std::int64_t time_ns = 0;

  friend bool operator==(const PosteriorRefreshed&, const PosteriorRefreshed&) = default;
};

struct PlanIssued {
  Plan plan;
  bool assigned = false;  // the robot did not ask for it and has yet to fetch it

  friend bool operator==(const PlanIssued&, const PlanIssued&) = default;
};

enum class ProgressOutcome { kReached, kBlocked, kAborted };

struct ProgressReported {
  RobotId robot;
  PlanId plan_id = 0;
  ProgressOutcome outcome = ProgressOutcome::kReached;

  friend bool operator==(const ProgressReported&, const ProgressReported&) = default;
};

// The posterior began to be recomputed from scratch, beside the mission; `time_ns` is the instant
// to which that ages readings.
struct EpochBegun {
  std::int64_t time_ns = 0;

  friend bool operator==(const EpochBegun&, const EpochBegun&) = default;
};

// What was recomputed took the place of the posterior. What changed in between is in it too.
struct EpochAdopted {
  friend bool operator==(const EpochAdopted&, const EpochAdopted&) = default;
};

// A robot left the mission for good. Should it come back, it registers anew and goes on with its
// log.
struct RobotRemoved {
  RobotId robot;

  friend bool operator==(const RobotRemoved&, const RobotRemoved&) = default;
};

// How far the mission's time is ahead of a robot's clock: sample times of the observations that
// follow are later by this much for the mission.
struct ClockOffsetNoted {
  RobotId robot;
  std::int64_t offset_ns = 0;

  friend bool operator==(const ClockOffsetNoted&, const ClockOffsetNoted&) = default;
};

// An operator sends a robot home, or takes that back.
struct HomeOrdered {
  RobotId robot;
  bool home = true;

  friend bool operator==(const HomeOrdered&, const HomeOrdered&) = default;
};

// The map began to be rebuilt from kept scans with corrected poses, beside the mission.
struct MapRebuildBegun {
  friend bool operator==(const MapRebuildBegun&, const MapRebuildBegun&) = default;
};

// What was rebuilt took the place of the map. Scans that came in between are in it too.
struct MapRebuilt {
  friend bool operator==(const MapRebuilt&, const MapRebuilt&) = default;
};

// An operator closes areas to robots, or opens them again: first those of the names `deleted` go,
// then `added` come.
struct KeepOutChanged {
  std::vector<std::string> deleted;
  std::vector<Polygon> added;

  friend bool operator==(const KeepOutChanged&, const KeepOutChanged&) = default;
};

// Everything that changes a mission. Recorded events know their kind by its place in this list: new
// kinds come last.
using EventBody =
    std::variant<RobotRegistered, ObservationReceived, PosteriorRefreshed, PlanIssued,
                 ProgressReported, EpochBegun, EpochAdopted, RobotRemoved, ClockOffsetNoted,
                 HomeOrdered, MapRebuildBegun, MapRebuilt, KeepOutChanged>;

// Numbered 1, 2, 3 ...: the number of the last applied event is the mission's revision.
struct Event {
  std::int64_t number = 0;
  EventBody body;

  friend bool operator==(const Event&, const Event&) = default;
};

}  // namespace plumescout
