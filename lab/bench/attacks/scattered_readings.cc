// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "absl/time/clock.h"
#include "client/grpc_planner_client.h"
#include "core/types/status_macros.h"
#include "lab/bench/attacks/attack_bed.h"
#include "lab/bench/load/flood.h"

namespace plumescout::lab {
namespace {

constexpr char kMission[] = "scattered";
constexpr double kReadingsPerSecond = 36'000.0;
constexpr double kSpread_m = 999.0;
constexpr double kRadius_m = 0.2;
constexpr double kGrowth_mb = 64.0;

absl::StatusOr<std::vector<Bar>> Run(const AttackSettings& settings) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto bed, AttackBed::Start(settings));
  const auto client = client::MakeGrpcPlannerClient({.target = bed->target()});
  MissionOptions options;
  options.max_robot_speed_mps = 0.0;  // else they are refused
  PLUMESCOUT_RETURN_IF_ERROR(client->CreateMission(kMission, options));
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const client::RobotSession session,
      client->RegisterRobot(kMission, "scatterer", kRadius_m, /*take_over=*/false));
  bed->Take();
  PLUMESCOUT_ASSIGN_OR_RETURN(const ProcessUsage usage_before, bed->server().Usage());
  FloodFigures flooded;
  {
    const Flood flood(bed->target(), session,
                      {.readings_per_s = kReadingsPerSecond, .spread_m = kSpread_m});
    absl::SleepFor(settings.time);
    flooded = flood.figures();
  }
  const HonestFigures during = bed->Take();
  const auto usage = bed->server().Usage();
  std::vector<Bar> bars = bed->Judge(during);
  if (usage.ok()) {
    bars.push_back({"memory it grew by, MB", usage->rss_mb - usage_before.rss_mb, kGrowth_mb});
  }
  bars.push_back({"readings sent", static_cast<double>(flooded.readings_sent)});
  bars.push_back({"readings taken", static_cast<double>(flooded.readings_taken)});
  return bars;
}

}  // namespace

Attack ScatteredReadingsAttack() {
  return {"scattered_readings", "36,000 readings a second all over two kilometres",
          "185 B each, kept for ever before the first scan", &Run};
}

}  // namespace plumescout::lab
