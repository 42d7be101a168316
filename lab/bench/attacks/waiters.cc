// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "absl/time/clock.h"
#include "client/grpc_planner_client.h"
#include "core/types/status_macros.h"
#include "lab/bench/attacks/attack_bed.h"
#include "lab/bench/load/known_map.h"
#include "lab/bench/load/open_calls.h"

namespace plumescout::lab {
namespace {

constexpr int kRounds = 4;
constexpr int kCallsPerRound = 75;
constexpr absl::Duration kUnderWay = absl::Milliseconds(300);
constexpr absl::Duration kPatience = absl::Seconds(40);
constexpr double kDrain_s = 2.0;  // connection.drain_s and a second

absl::StatusOr<std::vector<Bar>> Run(const AttackSettings& settings) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto bed, AttackBed::Start(settings));
  const auto client = client::MakeGrpcPlannerClient({.target = bed->target()});
  PLUMESCOUT_ASSIGN_OR_RETURN(const client::RobotSession session,
                              PlaceRobot(*client, kHonestMission, "waiter", {1.0, 1.0, 0.0}));
  for (int round = 0; round < kRounds; ++round) {
    const auto calls = OpenCalls::WaitForLog(bed->target(), session, kCallsPerRound);
    absl::SleepFor(kUnderWay);
  }
  bed->Take();  // those that were overloaded while the calls were open
  absl::SleepFor(settings.time);
  std::vector<Bar> bars = bed->Judge(bed->Take());
  const auto left_open = OpenCalls::WaitForLog(bed->target(), session, 1);
  absl::SleepFor(kUnderWay);
  const auto taken = bed->server().Stop(kPatience);
  bars.push_back(
      {"drain with one open, s", absl::ToDoubleSeconds(taken.value_or(kPatience)), kDrain_s});
  return bars;
}

}  // namespace

Attack WaitersAttack() {
  return {"waiters", "300 checks that wait for readings that never come, cancelled; then one left",
          "the mission overloaded for good, SIGTERM hangs for 25 s", &Run};
}

}  // namespace plumescout::lab
