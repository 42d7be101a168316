// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <memory>

#include "absl/time/clock.h"
#include "client/grpc_planner_client.h"
#include "core/types/quantile.h"
#include "core/types/status_macros.h"
#include "lab/bench/attacks/attack_bed.h"
#include "lab/bench/load/load_watcher.h"

namespace plumescout::lab {
namespace {

constexpr int kWatchers = 100;
constexpr double kSlower = 5.0;  // watchers' own work on the same cores included
constexpr double kFloor_ms = 100.0;

// Wall times of reading the map again and again.
std::vector<double> ReadMaps_ms(client::PlannerClient& client, absl::Duration time) {
  std::vector<double> taken_ms;
  for (const absl::Time end = absl::Now() + time; absl::Now() < end;) {
    const absl::Time asked = absl::Now();
    if (client.GetMap(kHonestMission).ok()) {
      taken_ms.push_back(absl::ToDoubleMilliseconds(absl::Now() - asked));
    }
  }
  return taken_ms;
}

absl::StatusOr<std::vector<Bar>> Run(const AttackSettings& settings) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto bed, AttackBed::Start(settings));
  const auto client = client::MakeGrpcPlannerClient({.target = bed->target()});
  const double alone_ms = Median(ReadMaps_ms(*client, settings.time));
  std::vector<std::unique_ptr<LoadWatcher>> watchers;
  for (int i = 0; i < kWatchers; ++i) {
    watchers.push_back(std::make_unique<LoadWatcher>(bed->target(), kHonestMission, nullptr));
  }
  bed->Take();
  const double beside_ms = Median(ReadMaps_ms(*client, settings.time));
  std::vector<Bar> bars = bed->Judge(bed->Take());
  double sent_away = 0.0;
  for (const auto& watcher : watchers) sent_away += watcher->was_sent_away() ? 1.0 : 0.0;
  bars.push_back({"map p50 before, ms", alone_ms});
  bars.push_back({"map p50, ms", beside_ms, std::max(kSlower * alone_ms, kFloor_ms)});
  bars.push_back({"watchers sent away", sent_away, 0.0});
  return bars;
}

}  // namespace

Attack WatchersAttack() {
  return {"watchers", "100 watchers of one mission", "a map takes 2.4 s instead of 36 ms", &Run};
}

}  // namespace plumescout::lab
