// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "absl/time/clock.h"
#include "client/grpc_planner_client.h"
#include "core/types/status_macros.h"
#include "lab/bench/attacks/attack_bed.h"
#include "lab/bench/load/known_map.h"
#include "lab/bench/load/open_calls.h"
#include "lab/worlds/bench_world.h"

namespace plumescout::lab {
namespace {

constexpr int kCalls = 8;
constexpr int kSide = 600;  // cells

absl::StatusOr<std::vector<Bar>> Run(const AttackSettings& settings) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto bed, AttackBed::Start(settings));
  const auto client = client::MakeGrpcPlannerClient({.target = bed->target()});
  const Grid<std::uint8_t> walls = MakeBuilding(kSide, kSide, settings.seed);
  MissionOptions options = WithMap(KnownBuilding(walls));
  options.planning.sample_count = 100'000;
  options.planning.nearest_sample_count = 100;
  PLUMESCOUT_RETURN_IF_ERROR(client->CreateMission("slow", options));
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const client::RobotSession session,
      PlaceRobot(*client, "slow", "thinker", FreePoses(walls, 1, settings.seed).front()));
  bed->Take();
  const auto calls = OpenCalls::Plan(bed->target(), session, kCalls, absl::Minutes(1));
  absl::SleepFor(settings.time);
  std::vector<Bar> bars = bed->Judge(bed->Take());
  bars.push_back({"long plans answered meanwhile", static_cast<double>(calls->ended())});
  return bars;
}

}  // namespace

Attack LongPlansAttack() {
  return {"long_plans", "eight plans of a minute each in a mission of their own",
          "another mission's plan (13 ms alone) unanswered at 12 s", &Run};
}

}  // namespace plumescout::lab
