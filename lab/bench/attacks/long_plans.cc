// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>
#include <utility>
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

constexpr int kCalls = 4;  // of each robot at a time: more do not wait
constexpr int kMissions = 2;
constexpr int kRobots = 2;  // of each
constexpr int kSide = 600;  // cells
// Until their first plans are over, which nobody knows to take long, they may have all threads.
constexpr absl::Duration kSurprise = absl::Seconds(6);
constexpr double kMostSurprise_ms = 6000.0;

// A robot that has so many plans under way at any time.
class Thinker {
 public:
  Thinker(const std::string& target, client::RobotSession session)
      : target_(target), session_(std::move(session)) {}

  void Ask() {
    for (int open = UnderWay(); open < kCalls; ++open) {
      calls_.push_back(OpenCalls::Plan(target_, session_, 1, absl::Minutes(1)));
    }
  }
  int UnderWay() const { return static_cast<int>(calls_.size()) - Ended(); }
  int Ended() const {
    int ended = 0;
    for (const auto& call : calls_) ended += call->ended();
    return ended;
  }

 private:
  std::string target_;
  client::RobotSession session_;
  std::vector<std::unique_ptr<OpenCalls>> calls_;
};

void AskFor(absl::Duration time, std::vector<Thinker>& thinkers) {
  constexpr absl::Duration kPause = absl::Milliseconds(100);
  for (const absl::Time end = absl::Now() + time; absl::Now() < end; absl::SleepFor(kPause)) {
    for (Thinker& thinker : thinkers) thinker.Ask();
  }
}

absl::StatusOr<std::vector<Bar>> Run(const AttackSettings& settings) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto bed, AttackBed::Start(settings));
  const auto client = client::MakeGrpcPlannerClient({.target = bed->target()});
  const Grid<std::uint8_t> walls = MakeBuilding(kSide, kSide, settings.seed);
  MissionOptions options = WithMap(KnownBuilding(walls));
  options.planning.sample_count = 100'000;
  options.planning.nearest_sample_count = 100;
  const std::vector<Pose2> poses = FreePoses(walls, kRobots, settings.seed);
  std::vector<Thinker> thinkers;
  for (int i = 0; i < kMissions; ++i) {
    const MissionId mission = absl::StrCat("slow-", i);
    PLUMESCOUT_RETURN_IF_ERROR(client->CreateMission(mission, options));
    for (int k = 0; k < kRobots; ++k) {
      PLUMESCOUT_ASSIGN_OR_RETURN(
          client::RobotSession session,
          PlaceRobot(*client, mission, absl::StrCat("thinker-", k), poses[k]));
      thinkers.emplace_back(bed->target(), std::move(session));
    }
  }
  bed->Take();
  AskFor(kSurprise, thinkers);
  const HonestFigures at_first = bed->Take();
  AskFor(settings.time, thinkers);
  int ended = 0;
  int under_way = 0;
  for (const Thinker& thinker : thinkers) {
    ended += thinker.Ended();
    under_way += thinker.UnderWay();
  }
  std::vector<Bar> bars = bed->Judge(bed->Take());
  bars.push_back({"plan p99 at first, ms", Quantile(at_first.plan_ms, 0.99), kMostSurprise_ms});
  bars.push_back({"long plans answered meanwhile", static_cast<double>(ended)});
  bars.push_back(MustHold("no long plan was under way", under_way > 0));
  return bars;
}

}  // namespace

Attack LongPlansAttack() {
  return {"long_plans", "plans of a minute, four at a time, by two robots in each of two missions",
          "another mission's plan (13 ms alone) unanswered at 12 s", &Run};
}

}  // namespace plumescout::lab
