// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "core/types/ids.h"
#include "core/types/map_snapshot.h"

namespace plumescout::client {

// How a robot is linked to the server.
enum class RobotLink {
  kStreaming,  // its ingest stream is open
  kIdle,       // no stream is open; a client holds its lease
  kSilent,     // its mission has not heard of it while others were heard
  kGone,       // nobody holds its lease
  kUnknown,    // the server says what this client does not know
};

// How far a robot has come on its live plan.
struct PlanProgress {
  PlanId plan = 0;
  double progress_s = 0.0;           // of its trajectory
  double lateness_s = 0.0;           // behind its times
  std::int64_t arrival_time_ns = 0;  // in the mission's time

  friend bool operator==(const PlanProgress&, const PlanProgress&) = default;
};

// A robot as its operator sees it.
struct RobotDetails {
  RobotState state;
  RobotLink link = RobotLink::kGone;
  bool leased = false;  // a client holds its lease
  // RobotState::clock_offset_ns; none if its clock is taken as it is, and the state then has 0.
  std::optional<std::int64_t> clock_offset_ns = std::nullopt;
  // Since its latest batch was applied; none before the first.
  std::optional<double> last_heard_age_s = std::nullopt;
  // Age of the newest sample of that; none unless its batches say when they were sent.
  std::optional<double> ingest_lag_s = std::nullopt;
  std::optional<PlanProgress> live_plan = std::nullopt;  // none, too, if it is to stay
  bool battery_low = false;                              // it is sent home for that
  std::optional<Point2> home = std::nullopt;             // none before its first observation
};

}  // namespace plumescout::client
