// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include <limits>
#include <numbers>
#include <variant>

#include "absl/time/clock.h"
#include "client/grpc_planner_client.h"
#include "core/types/status_macros.h"
#include "lab/bench/attacks/attack_bed.h"
#include "lab/bench/load/known_map.h"

namespace plumescout::lab {
namespace {

constexpr int kScans = 5;
constexpr int kBeams = 720;
constexpr double kView_m = 95.0;
constexpr double kStep_m = 8.0;
constexpr double kCpuPerScan_s = 0.5;
constexpr absl::Duration kPatience = absl::Seconds(30);

Observation OpenField(std::int64_t sequence) {
  return {sequence,
          absl::ToUnixNanos(absl::Now()),
          {kStep_m * static_cast<double>(sequence), 0.0, 0.0},
          Scan{-std::numbers::pi, 2.0 * std::numbers::pi / kBeams, kView_m,
               std::vector<float>(kBeams, std::numeric_limits<float>::infinity())}};
}

absl::StatusOr<std::vector<Bar>> Run(const AttackSettings& settings) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto bed, AttackBed::Start(settings));
  const auto client = client::MakeGrpcPlannerClient({.target = bed->target()});
  MissionOptions options;
  options.max_robot_speed_mps = 0.0;  // it scans faster than anybody drives
  PLUMESCOUT_RETURN_IF_ERROR(client->CreateMission("outdoors", options));
  PLUMESCOUT_ASSIGN_OR_RETURN(const client::RobotSession session,
                              PlaceRobot(*client, "outdoors", "surveyor", {}));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto stream, client->OpenObservationStream(session));
  bed->Take();
  const double cpu_before_s = bed->Cpu_s();
  const absl::Time began = absl::Now();
  for (int scan = 0; scan < kScans; ++scan) {
    const std::int64_t sequence = scan + 2;
    if (!stream->Write({OpenField(sequence)}).ok()) break;
    for (std::int64_t applied = 0; applied < sequence;) {
      const auto reply = stream->Read(kPatience);
      if (!reply.ok()) break;
      const auto* state = std::get_if<client::IngestState>(&*reply);
      if (state != nullptr) applied = state->applied_sequence;
    }
    const auto usage = bed->server().Usage();
    if (!usage.ok() || usage->peak_rss_mb > kUnbearable_mb) break;
  }
  absl::SleepFor(began + settings.time - absl::Now());  // what it refreshes afterwards counts too
  const double wall_s = absl::ToDoubleSeconds(absl::Now() - began);
  const double cpu_s = bed->Cpu_s() - cpu_before_s;
  std::vector<Bar> bars = bed->Judge(bed->Take());
  bars.push_back({"server CPU a scan, s", cpu_s / kScans, kCpuPerScan_s});
  bars.push_back({"wall, s", wall_s});
  return bars;
}

}  // namespace

Attack FarScansAttack() {
  return {"far_scans", "five scans of 95 m in an open field, default options but for speed",
          "3.7 GB, 2.6 CPU-s a scan", &Run};
}

}  // namespace plumescout::lab
