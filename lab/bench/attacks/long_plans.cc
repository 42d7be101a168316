// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "client/grpc_planner_client.h"
#include "core/types/quantile.h"
#include "core/types/status_macros.h"
#include "lab/bench/attacks/attack_bed.h"
#include "lab/bench/load/known_map.h"
#include "lab/bench/load/open_calls.h"
#include "lab/worlds/bench_world.h"

namespace plumescout::lab {
namespace {

constexpr int kCalls = 4;  // of each robot
constexpr int kMissions = 2;
constexpr int kRobots = 2;  // of each
constexpr int kSide = 600;  // cells
// Until their first plans are over, which nobody knows to take long, they may have all threads.
constexpr absl::Duration kSurprise = absl::Seconds(6);
constexpr double kMostSurprise_ms = 6000.0;

absl::StatusOr<std::vector<Bar>> Run(const AttackSettings& settings) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto bed, AttackBed::Start(settings));
  const auto client = client::MakeGrpcPlannerClient({.target = bed->target()});
  const Grid<std::uint8_t> walls = MakeBuilding(kSide, kSide, settings.seed);
  MissionOptions options = WithMap(KnownBuilding(walls));
  options.planning.sample_count = 100'000;
  options.planning.nearest_sample_count = 100;
  const std::vector<Pose2> poses = FreePoses(walls, kRobots, settings.seed);
  std::vector<client::RobotSession> sessions;
  for (int i = 0; i < kMissions; ++i) {
    const MissionId mission = absl::StrCat("slow-", i);
    PLUMESCOUT_RETURN_IF_ERROR(client->CreateMission(mission, options));
    for (int k = 0; k < kRobots; ++k) {
      PLUMESCOUT_ASSIGN_OR_RETURN(
          sessions.emplace_back(),
          PlaceRobot(*client, mission, absl::StrCat("thinker-", k), poses[k]));
    }
  }
  bed->Take();
  std::vector<std::unique_ptr<OpenCalls>> calls;
  for (const client::RobotSession& session : sessions) {
    calls.push_back(OpenCalls::Plan(bed->target(), session, kCalls, absl::Minutes(1)));
  }
  absl::SleepFor(kSurprise);
  const HonestFigures at_first = bed->Take();
  absl::SleepFor(settings.time);
  std::vector<Bar> bars = bed->Judge(bed->Take());
  int ended = 0;
  for (const auto& call : calls) ended += call->ended();
  bars.push_back({"plan p99 at first, ms", Quantile(at_first.plan_ms, 0.99), kMostSurprise_ms});
  bars.push_back({"long plans answered meanwhile", static_cast<double>(ended)});
  bars.push_back(
      MustHold("no long plan was under way", ended < kCalls * static_cast<int>(sessions.size())));
  return bars;
}

}  // namespace

Attack LongPlansAttack() {
  return {"long_plans", "16 plans of a minute each, of two robots in each of two missions",
          "another mission's plan (13 ms alone) unanswered at 12 s", &Run};
}

}  // namespace plumescout::lab
