// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
//
// journal_lines FOLDER [FIRST]: the events of all missions of a data folder, from number FIRST on,
// as lines of words between tabs, for tests in Python (tests/faults/answers.py):
//
//   mission KEY HEAD
//   NUMBER registered ROBOT TOKEN LOG_EPOCH
//   NUMBER scan ROBOT SEQUENCE TIME_NS X Y YAW BEAMS CRC    CRC-32 of the ranges, floats in metres
//   NUMBER gas ROBOT SEQUENCE TIME_NS X Y YAW PPM
//   NUMBER gap ROBOT FIRST LAST
//   NUMBER plan ROBOT              the first is plan 1, the next plan 2
//   NUMBER report ROBOT PLAN reached|blocked|aborted
//   NUMBER removed ROBOT
//   NUMBER refreshed|epoch_begun|epoch_adopted
//
// Exit code 1, and why on standard error, if anything of it is damaged. It opens the folder as a
// server does, so it changes it: give it a copy.
#include <zlib.h>

#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string>
#include <type_traits>
#include <variant>

#include "absl/status/status.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/types/event.h"
#include "core/types/status_macros.h"
#include "formats/journal/event_codec.h"
#include "server/store/mission_store.h"
#include "server/store/sqlite_store.h"

namespace plumescout {
namespace {

std::string Tell(const RobotRegistered& body) {
  return absl::StrCat("registered\t", body.robot, "\t", body.lease_token, "\t", body.log_epoch);
}

std::string Tell(const ObservationReceived& body) {
  const Observation& observation = body.observation;
  if (const auto* gap = std::get_if<SequenceGap>(&observation.payload)) {
    return absl::StrCat("gap\t", body.robot, "\t", gap->first_sequence, "\t", gap->last_sequence);
  }
  const Pose2& pose = observation.pose;
  const std::string where =
      absl::StrFormat("%s\t%d\t%d\t%.17g\t%.17g\t%.17g", body.robot, observation.sequence,
                      observation.sample_time_ns, pose.x_m, pose.y_m, pose.yaw_rad);
  if (const auto* gas = std::get_if<GasReading>(&observation.payload)) {
    return absl::StrFormat("gas\t%s\t%.17g", where, gas->concentration_ppm);
  }
  const auto& ranges_m = std::get<Scan>(observation.payload).ranges_m;
  const auto checksum = crc32(0, reinterpret_cast<const Bytef*>(ranges_m.data()),
                              static_cast<uInt>(ranges_m.size() * sizeof(float)));
  return absl::StrCat("scan\t", where, "\t", ranges_m.size(), "\t", checksum);
}

std::string Tell(const PlanIssued& body) { return absl::StrCat("plan\t", body.plan.robot); }
std::string Tell(const ProgressReported& body) {
  const char* outcome = body.outcome == ProgressOutcome::kReached   ? "reached"
                        : body.outcome == ProgressOutcome::kBlocked ? "blocked"
                                                                    : "aborted";
  return absl::StrCat("report\t", body.robot, "\t", body.plan_id, "\t", outcome);
}

std::string Tell(const RobotRemoved& body) { return absl::StrCat("removed\t", body.robot); }
std::string Tell(const PosteriorRefreshed&) { return "refreshed"; }
std::string Tell(const EpochBegun&) { return "epoch_begun"; }
std::string Tell(const EpochAdopted&) { return "epoch_adopted"; }
std::string Tell(const ClockOffsetNoted& noted) {
  return absl::StrCat("clock_offset\t", noted.robot, "\t", noted.offset_ns);
}
std::string Tell(const HomeOrdered& order) {
  return absl::StrCat("home_ordered\t", order.robot, "\t", order.home ? 1 : 0);
}
std::string Tell(const MapRebuildBegun&) { return "map_rebuild_begun"; }
std::string Tell(const MapRebuilt&) { return "map_rebuilt"; }
std::string Tell(const KeepOutChanged& change) {
  return absl::StrCat("keep_out_changed\t", change.deleted.size(), "\t", change.added.size());
}

absl::Status TellMission(server::MissionStore& store, const server::StoredMission& mission,
                         std::int64_t first) {
  std::printf("mission\t%s\t%lld\n", mission.key.c_str(), static_cast<long long>(mission.head));
  // Whoever takes a mission over hears if it lacks its end.
  PLUMESCOUT_RETURN_IF_ERROR(store.Acquire(mission.key).status());
  if (first > mission.head) return absl::OkStatus();
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto reader, store.Read(mission.key, first));
  while (true) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const auto record, reader->Next());
    if (!record.has_value()) return absl::OkStatus();
    PLUMESCOUT_ASSIGN_OR_RETURN(const Event event, DecodeEvent(record->bytes));
    if (event.number != record->number) {
      return absl::DataLossError(
          absl::StrCat(mission.key, ": record ", record->number, " holds event ", event.number));
    }
    const std::string told = std::visit([](const auto& body) { return Tell(body); }, event.body);
    std::printf("%lld\t%s\n", static_cast<long long>(event.number), told.c_str());
  }
}

absl::Status TellAll(const std::string& folder, std::int64_t first) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto store, server::SqliteStore::Open({.folder = folder}));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto missions, store->List());
  for (const server::StoredMission& mission : missions) {
    PLUMESCOUT_RETURN_IF_ERROR(TellMission(*store, mission, first));
  }
  return absl::OkStatus();
}

}  // namespace
}  // namespace plumescout

int main(int argc, char** argv) {
  std::int64_t first = 1;
  if (argc < 2 || argc > 3 || (argc == 3 && !absl::SimpleAtoi(argv[2], &first))) {
    std::fprintf(stderr, "usage: journal_lines FOLDER [FIRST]\n");
    return 2;
  }
  const absl::Status status = plumescout::TellAll(argv[1], first);
  if (status.ok()) return EXIT_SUCCESS;
  std::fprintf(stderr, "%s\n", status.ToString().c_str());
  return EXIT_FAILURE;
}
