// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/types/ids.h"

namespace plumescout::client {

// What happened; see MissionEventKind in proto/plumescout/v1/snapshot_service.proto.
enum class MissionEventKind {
  kUnknown,  // of a newer server
  kRobotRegistered,
  kRobotRemoved,
  kScan,
  kGasReading,
  kSequenceGap,
  kPlan,
  kReport,
  kRefresh,
  kEpochBegun,
  kEpochAdopted,
  kPoseCorrection,
  kRobotStatus,
  kClockOffset,
  kHomeOrdered,
  kMapRebuildBegun,
  kMapRebuilt,
  kKeepOutChanged,
};

struct MissionEvent {
  std::int64_t number = 0;  // the revision that it made
  MissionEventKind kind = MissionEventKind::kUnknown;
  RobotId robot = {};  // empty: of none
  // Of observations by the robot's clock, of others by the mission's time; none: it has no time.
  std::optional<std::int64_t> sample_time_ns = std::nullopt;
  std::string summary = {};  // in words, for people

  friend bool operator==(const MissionEvent&, const MissionEvent&) = default;
};

struct HistoryQuery {
  std::vector<MissionEventKind> kinds = {};  // none: all
  std::int64_t first_number = 0;             // from this event on; 0: from the first
  int page_size = 1000;                      // at most 1000
  std::string page_token = {};               // HistoryPage::next_page_token, the rest as before
};

struct HistoryPage {
  std::vector<MissionEvent> events;  // may be none although there is a next page
  std::string next_page_token;       // empty: this was the last
  std::int64_t head_revision = 0;    // the last event that is durable
  std::int64_t first_number = 0;     // the first that is kept
};

// What is known of a gas.
struct GasFigures {
  std::string species = {};                                // empty: the mission names no gas
  std::optional<double> max_mean_ppm = std::nullopt;       // none: there is none yet
  double plume_area_m2 = 0.0;                              // of the first gas
  std::optional<double> mean_entropy_nats = std::nullopt;  // of one free cell; none: as above
  std::int64_t in_posterior = 0;                           // readings

  friend bool operator==(const GasFigures&, const GasFigures&) = default;
};

// A map in figures; see proto/plumescout/v1/snapshot_service.proto.
struct MissionFigures {
  std::int64_t revision = 0;
  double elapsed_s = 0.0;
  double known_area_m2 = 0.0;
  double reachable_area_m2 = 0.0;
  double observed_area_m2 = 0.0;
  int open_frontiers = 0;
  std::optional<double> undecided_area_m2 = std::nullopt;  // none: the mission has no objective
  std::vector<GasFigures> gases = {};
  std::map<RobotId, std::int64_t> applied_sequences = {};  // of every robot

  friend bool operator==(const MissionFigures&, const MissionFigures&) = default;
};

struct FigureHistory {
  std::vector<MissionFigures> figures;  // in order of their revisions
  bool more_follow = false;             // ask again in a second
};

}  // namespace plumescout::client
