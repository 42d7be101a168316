// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/mission_messages.h"

#include <utility>

#include "core/types/status_macros.h"
#include "proto/convert/enums.h"
#include "proto/convert/names.h"
#include "proto/convert/objective.h"
#include "proto/convert/options.h"

namespace plumescout::client {
namespace {

struct KindRow {
  MissionEventKind kind;
  v1::MissionEventKind proto;
};
constexpr KindRow kKinds[] = {
    {MissionEventKind::kRobotRegistered, v1::MISSION_EVENT_KIND_ROBOT_REGISTERED},
    {MissionEventKind::kRobotRemoved, v1::MISSION_EVENT_KIND_ROBOT_REMOVED},
    {MissionEventKind::kScan, v1::MISSION_EVENT_KIND_SCAN},
    {MissionEventKind::kGasReading, v1::MISSION_EVENT_KIND_GAS_READING},
    {MissionEventKind::kSequenceGap, v1::MISSION_EVENT_KIND_SEQUENCE_GAP},
    {MissionEventKind::kPlan, v1::MISSION_EVENT_KIND_PLAN},
    {MissionEventKind::kReport, v1::MISSION_EVENT_KIND_REPORT},
    {MissionEventKind::kRefresh, v1::MISSION_EVENT_KIND_REFRESH},
    {MissionEventKind::kEpochBegun, v1::MISSION_EVENT_KIND_EPOCH_BEGUN},
    {MissionEventKind::kEpochAdopted, v1::MISSION_EVENT_KIND_EPOCH_ADOPTED},
    {MissionEventKind::kPoseCorrection, v1::MISSION_EVENT_KIND_POSE_CORRECTION},
    {MissionEventKind::kRobotStatus, v1::MISSION_EVENT_KIND_ROBOT_STATUS},
    {MissionEventKind::kClockOffset, v1::MISSION_EVENT_KIND_CLOCK_OFFSET},
    {MissionEventKind::kHomeOrdered, v1::MISSION_EVENT_KIND_HOME_ORDERED},
    {MissionEventKind::kMapRebuildBegun, v1::MISSION_EVENT_KIND_MAP_REBUILD_BEGUN},
    {MissionEventKind::kMapRebuilt, v1::MISSION_EVENT_KIND_MAP_REBUILT},
    {MissionEventKind::kKeepOutChanged, v1::MISSION_EVENT_KIND_KEEP_OUT_CHANGED},
};

MissionState StateFromProto(v1::MissionState state) {
  switch (state) {
    case v1::MISSION_STATE_RUNNING:
      return MissionState::kRunning;
    case v1::MISSION_STATE_PAUSED:
      return MissionState::kPaused;
    case v1::MISSION_STATE_FINISHED:
      return MissionState::kFinished;
    case v1::MISSION_STATE_RECOVERING:
      return MissionState::kRecovering;
    case v1::MISSION_STATE_SLEEPING:
      return MissionState::kSleeping;
    case v1::MISSION_STATE_ELSEWHERE:
      return MissionState::kElsewhere;
    case v1::MISSION_STATE_DAMAGED:
      return MissionState::kDamaged;
    default:
      return MissionState::kUnknown;
  }
}

LatencySummary LatencyFromProto(const v1::Latency& proto) {
  return {.samples = proto.sample_count(),
          .median_s = proto.median_s(),
          .p99_s = proto.p99_s(),
          .max_s = proto.max_s()};
}

}  // namespace

absl::StatusOr<MissionDetails> DetailsFromProto(const v1::Mission& proto) {
  MissionDetails mission;
  PLUMESCOUT_ASSIGN_OR_RETURN(mission.id, ParseMissionName("mission.name", proto.name()));
  mission.state = StateFromProto(proto.state());
  mission.node = proto.node();
  const bool is_absent =
      mission.state == MissionState::kRecovering || mission.state == MissionState::kSleeping ||
      mission.state == MissionState::kElsewhere || mission.state == MissionState::kDamaged;
  if (is_absent) return mission;
  PLUMESCOUT_ASSIGN_OR_RETURN(mission.options,
                              FromProto(proto.options(), MissionOptions(), "mission.options"));
  PLUMESCOUT_ASSIGN_OR_RETURN(mission.phase, FromProto(proto.phase(), "mission.phase"));
  mission.revision = proto.revision();
  mission.robot_count = proto.robot_count();
  mission.gas_update = LatencyFromProto(proto.gas_timings().update());
  mission.gas_staleness = LatencyFromProto(proto.gas_timings().staleness());
  if (proto.has_next_map_update_ns()) mission.next_map_update_ns = proto.next_map_update_ns();
  mission.owner = proto.owner();
  if (proto.has_idle_time_to_live()) {
    mission.idle_time_to_live = absl::Seconds(proto.idle_time_to_live().seconds()) +
                                absl::Nanoseconds(proto.idle_time_to_live().nanos());
  }
  mission.memory_used_bytes = proto.memory().used_bytes();
  mission.memory_budget_bytes = proto.memory().budget_bytes();
  if (proto.event_retention() == v1::EVENT_RETENTION_SINCE_SNAPSHOT) {
    mission.event_retention = EventRetention::kSinceSnapshot;
  }
  if (proto.has_objective()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(mission.objective,
                                FromProto(proto.objective(), "mission.objective"));
    mission.objective_explanation = proto.objective().explanation();
  }
  return mission;
}

absl::StatusOr<MissionEvent> EventFromProto(const v1::MissionEvent& proto) {
  MissionEvent event;
  event.number = proto.number();
  for (const KindRow& row : kKinds) {
    if (row.proto == proto.kind()) event.kind = row.kind;
  }
  if (!proto.robot().empty()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(RobotName name, ParseRobotName("events.robot", proto.robot()));
    event.robot = std::move(name.robot);
  }
  if (proto.has_sample_time_ns()) event.sample_time_ns = proto.sample_time_ns();
  event.summary = proto.summary();
  return event;
}

absl::StatusOr<MissionFigures> FiguresFromProto(const v1::MissionFigures& proto) {
  MissionFigures figures;
  figures.revision = proto.revision();
  figures.elapsed_s = proto.elapsed_s();
  figures.known_area_m2 = proto.known_area_m2();
  figures.reachable_area_m2 = proto.reachable_area_m2();
  figures.observed_area_m2 = proto.observed_area_m2();
  figures.open_frontiers = proto.open_frontier_count();
  if (proto.has_undecided_area_m2()) figures.undecided_area_m2 = proto.undecided_area_m2();
  for (const v1::GasFigures& told : proto.gases()) {
    GasFigures& gas = figures.gases.emplace_back();
    gas.species = told.species();
    if (told.has_max_mean_ppm()) gas.max_mean_ppm = told.max_mean_ppm();
    gas.plume_area_m2 = told.plume_area_m2();
    if (told.has_mean_entropy_nats()) gas.mean_entropy_nats = told.mean_entropy_nats();
    gas.in_posterior = told.in_posterior_count();
  }
  for (const v1::RobotFigures& told : proto.robots()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(RobotName name, ParseRobotName("robots.robot", told.robot()));
    figures.applied_sequences[name.robot] = told.applied_sequence();
  }
  return figures;
}

v1::EventRetention ToProto(EventRetention retention) {
  return retention == EventRetention::kAll ? v1::EVENT_RETENTION_ALL
                                           : v1::EVENT_RETENTION_SINCE_SNAPSHOT;
}

v1::MissionEventKind ToProto(MissionEventKind kind) {
  for (const KindRow& row : kKinds) {
    if (row.kind == kind) return row.proto;
  }
  return v1::MISSION_EVENT_KIND_UNSPECIFIED;
}

}  // namespace plumescout::client
