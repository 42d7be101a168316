// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/str_cat.h"
#include "core/mission/mission.h"
#include "core/types/event.h"

namespace plumescout {

// Counts what events of missions came to: "KeepOutChanged OK", "RobotStatus INVALID_ARGUMENT",
// "epoch adopted during a rebuild". So that a test of random missions is not green because they did
// nothing.
class MissionTally {
 public:
  // What a mission is before an event.
  struct Before {
    std::set<RobotId> suspects;
    bool is_rebuilding = false;
  };
  static Before Of(const Mission& mission) {
    return {Suspects(mission), mission.rebuild() != nullptr};
  }

  void Add(const EventBody& body, const Before& before, const absl::StatusOr<Applied>& applied,
           const Mission& mission) {
    absl::Status status = applied.status();
    if (const auto* const received = std::get_if<ObservationReceived>(&body)) {
      if (applied.ok()) status = applied->observation;
      AddObservation(received->observation, before, status);
    }
    Count(NameOf(body), status);
    if (!applied.ok()) return;
    if (const auto* const issued = std::get_if<PlanIssued>(&body)) AddPlan(*issued);
    if (const auto* const report = std::get_if<ProgressReported>(&body)) {
      ++counts_[absl::StrCat("outcome ", static_cast<int>(report->outcome))];
    }
    AddJoining(body, before);
    if (std::holds_alternative<EpochAdopted>(body) && before.is_rebuilding) {
      ++counts_["epoch adopted during a rebuild"];
    }
    AddStates(before, mission);
  }

  int Of(const std::string& what) const {
    const auto found = counts_.find(what);
    return found == counts_.end() ? 0 : found->second;
  }
  // Each kind of event and of observation, as it is counted when all is well.
  static std::vector<std::string> AllAccepted() {
    std::vector<std::string> all;
    for (const char* const kind : kEvents) all.push_back(absl::StrCat(kind, " OK"));
    for (const char* const kind : kPayloads) all.push_back(absl::StrCat(kind, " OK"));
    for (int kind = 0; kind < 7; ++kind) all.push_back(absl::StrCat("goal ", kind));
    for (int outcome = 0; outcome < 3; ++outcome) all.push_back(absl::StrCat("outcome ", outcome));
    return all;
  }
  const std::map<std::string, int>& counts() const { return counts_; }

 private:
  static constexpr const char* kEvents[] = {
      "RobotRegistered",  "ObservationReceived", "PosteriorRefreshed", "PlanIssued",
      "ProgressReported", "EpochBegun",          "EpochAdopted",       "RobotRemoved",
      "ClockOffsetNoted", "HomeOrdered",         "MapRebuildBegun",    "MapRebuilt",
      "KeepOutChanged"};
  static_assert(std::size(kEvents) == std::variant_size_v<EventBody>);
  static constexpr const char* kPayloads[] = {"Scan", "GasReading", "SequenceGap", "PoseCorrection",
                                              "RobotStatus"};
  static_assert(std::size(kPayloads) == std::variant_size_v<ObservationPayload>);

  static std::string NameOf(const EventBody& body) { return kEvents[body.index()]; }
  void Count(const std::string& kind, const absl::Status& status) {
    ++counts_[absl::StrCat(kind, " ", absl::StatusCodeToString(status.code()))];
  }
  static std::set<RobotId> Suspects(const Mission& mission) {
    std::set<RobotId> suspects;
    for (const RobotId& robot : mission.RobotIds()) {
      if (mission.StateOf(robot)->frame_suspect) suspects.insert(robot);
    }
    return suspects;
  }

  void AddObservation(const Observation& observation, const Before& before,
                      const absl::Status& status) {
    Count(kPayloads[observation.payload.index()], status);
    if (!status.ok()) return;
    if (std::holds_alternative<PoseCorrection>(observation.payload)) {
      if (before.is_rebuilding) ++counts_["correction during a rebuild"];
      if (!before.suspects.empty()) ++counts_["correction while a robot is in doubt"];
    }
  }
  void AddPlan(const PlanIssued& issued) {
    const Plan& plan = issued.plan;
    if (issued.assigned) ++counts_["assigned plan"];
    if (plan.chosen < 0) return;
    const Goal& goal = plan.candidates[static_cast<std::size_t>(plan.chosen)].goal;
    ++counts_[absl::StrCat("goal ", static_cast<int>(goal.kind))];
  }
  void AddJoining(const EventBody& body, const Before& before) {
    if (const auto* const removed = std::get_if<RobotRemoved>(&body)) {
      removed_.insert(removed->robot);
      if (before.suspects.contains(removed->robot)) ++counts_["removed in doubt"];
    }
    const auto* const registered = std::get_if<RobotRegistered>(&body);
    if (registered == nullptr) return;
    if (removed_.erase(registered->robot) > 0) ++counts_["registered again"];
    if (before.suspects.contains(registered->robot)) ++counts_["registered in doubt"];
    if (registered->frame.mission_from_robot != Pose2()) ++counts_["frame"];
    for (const GasSensor& sensor : registered->sensors) {
      if (sensor.offset_stddev_ppm > 0.0) ++counts_["sensor with an offset"];
      if (sensor.response_time_s > 0.0) ++counts_["sensor that lags"];
    }
  }
  void AddStates(const Before& before, const Mission& mission) {
    const std::set<RobotId> suspects = Suspects(mission);
    for (const RobotId& robot : suspects) {
      if (!before.suspects.contains(robot)) ++counts_["turned suspect"];
    }
    for (const RobotId& robot : before.suspects) {
      if (!suspects.contains(robot)) ++counts_["trusted again"];
    }
    if (!suspects.empty() && mission.can_be_saved()) ++counts_["saved with a robot in doubt"];
    if (mission.rebuild_due() && mission.can_be_saved()) ++counts_["saved with a rebuild due"];
    if (mission.rebuild() != nullptr) ++counts_["rebuild under way"];
    if (!mission.options().keep_out.empty()) ++counts_["keep-out areas"];
    if (mission.phase() == MissionPhase::kComplete) ++counts_["complete"];
    for (const RobotId& robot : mission.RobotIds()) {
      const RobotState state = *mission.StateOf(robot);
      if (state.silent) ++counts_["silent"];
      if (state.ordered_home) ++counts_["ordered home"];
      if (state.clock_offset_ns != 0) ++counts_["clock offset"];
    }
  }

  std::map<std::string, int> counts_;
  std::set<RobotId> removed_;  // and not back yet
};

}  // namespace plumescout
