// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/load/known_map.h"

#include "absl/time/clock.h"
#include "client/grpc_planner_client.h"
#include "core/types/status_macros.h"
#include "lab/bench/attacks/attack_bed.h"
#include "lab/bench/load/open_calls.h"

namespace plumescout::lab {
namespace {

constexpr int kSide = 2900;  // cells

absl::StatusOr<std::vector<Bar>> Run(const AttackSettings& settings) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto bed, AttackBed::Start(settings));
  const auto client = client::MakeGrpcPlannerClient({.target = bed->target()});
  const absl::Status made = client->CreateMission("vast", WithMap(KnownHall(kSide)));
  const auto calls = OpenCalls::ReadFreshMap(bed->target(), "vast", 1);
  // A server that takes it all is stopped in time.
  for (const absl::Time end = absl::Now() + settings.time; absl::Now() < end;) {
    const auto usage = bed->server().Usage();
    if (!usage.ok() || usage->peak_rss_mb > kUnbearable_mb) break;
    absl::SleepFor(absl::Milliseconds(20));
  }
  std::vector<Bar> bars = bed->Judge(bed->Take());
  bars.push_back({"mission refused", made.ok() ? 0.0 : 1.0});
  return bars;
}

}  // namespace

Attack KnownMapAttack() {
  return {"known_map", "a mission with a known map of 2900 x 2900 free cells, then its gas",
          "bad_alloc, the process gone with all missions", &Run};
}

}  // namespace plumescout::lab
