// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>
#include <numbers>

#include "absl/time/clock.h"
#include "client/grpc_planner_client.h"
#include "core/types/quantile.h"
#include "core/types/status_macros.h"
#include "lab/bench/attacks/attack_bed.h"
#include "lab/bench/load/known_map.h"

namespace plumescout::lab {
namespace {

constexpr char kMission[] = "busy";
constexpr int kScans = 100;
constexpr int kBeams = 2000;
constexpr double kView_m = 60.0;
constexpr double kStep_m = 0.5;
constexpr double kDelete_s = 1.0;
constexpr absl::Duration kPatience = absl::Seconds(60);
constexpr absl::Duration kUnderWay = absl::Milliseconds(200);

std::vector<Observation> OpenFields(std::int64_t after) {
  std::vector<Observation> scans;
  for (int i = 1; i <= kScans; ++i) {
    scans.push_back({after + i,
                     absl::ToUnixNanos(absl::Now()),
                     {kStep_m * i, 0.0, 0.0},
                     Scan{-std::numbers::pi, 2.0 * std::numbers::pi / kBeams, kView_m,
                          std::vector<float>(kBeams, std::numeric_limits<float>::infinity())}});
  }
  return scans;
}

absl::StatusOr<std::vector<Bar>> Run(const AttackSettings& settings) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto bed, AttackBed::Start(settings));
  const auto client =
      client::MakeGrpcPlannerClient({.target = bed->target(), .call_timeout = kPatience});
  PLUMESCOUT_RETURN_IF_ERROR(client->CreateMission(kMission, MissionOptions{}));
  PLUMESCOUT_ASSIGN_OR_RETURN(const client::RobotSession session,
                              PlaceRobot(*client, kMission, "surveyor", {}));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto stream, client->OpenObservationStream(session));
  std::vector<Observation> scans = OpenFields(stream->opened().applied_sequence);
  bed->Take();
  constexpr std::ptrdiff_t kPerFrame = 10;  // within the size of a request
  for (auto at = scans.begin(); scans.end() - at >= kPerFrame; at += kPerFrame) {
    if (!stream->Write({at, at + kPerFrame}).ok()) break;
  }
  absl::SleepFor(kUnderWay);
  const absl::Time asked = absl::Now();
  const absl::Status deleted = client->DeleteMission(kMission);
  const double delete_s = absl::ToDoubleSeconds(absl::Now() - asked);
  std::vector<double> map_s;
  const absl::Time map_asked = absl::Now();
  if (client->GetMap(kHonestMission).ok()) {
    map_s.push_back(absl::ToDoubleSeconds(absl::Now() - map_asked));
  }
  absl::SleepFor(asked + settings.time - absl::Now());
  std::vector<Bar> bars = bed->Judge(bed->Take());
  bars.push_back({"delete, s", deleted.ok() ? delete_s : std::nan(""), kDelete_s});
  bars.push_back({"map of another mission, s", Median(map_s), kDelete_s});
  return bars;
}

}  // namespace

Attack DeleteBusyAttack() {
  return {"delete_busy", "a mission deleted with 100 large scans in its queue",
          "the queue worked off first, on the only map thread: 21 s", &Run};
}

}  // namespace plumescout::lab
