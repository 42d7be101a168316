// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "client/grpc_planner_client.h"
#include "core/types/rng.h"
#include "core/types/status_macros.h"
#include "lab/bench/load/budget_filler.h"
#include "lab/bench/load/known_map.h"
#include "lab/bench/load/memory_budget.h"
#include "lab/bench/load/rows.h"
#include "lab/bench/load/server_process.h"

namespace plumescout::lab {
namespace {

constexpr int kMostMissions = 6;
constexpr int kLargestSide = 2900;  // cells
constexpr int kBeams = 720;
constexpr double kFar_m = 95.0;
constexpr double kSpread_m = 60.0;
constexpr absl::Duration kCallTimeout = absl::Seconds(5);
constexpr absl::Duration kReply = absl::Milliseconds(100);
constexpr int kBatch = 64;
constexpr double kFillTimes = 4.0;  // the time of the row: the budget is not reached sooner

// Asks for memory in every way that is allowed. What the server refuses is as good as what it does.
class Hoarder {
 public:
  Hoarder(const std::string& target, std::uint64_t seed)
      : client_(client::MakeGrpcPlannerClient({.target = target, .call_timeout = kCallTimeout})),
        rng_(seed) {}

  void Act() {
    switch (rng_.Below(6)) {
      case 0:
        return Create(MissionOptions{});
      case 1:
        return Create(WithMap(KnownHall(100 + static_cast<int>(rng_.Below(kLargestSide)))));
      case 2:
        return Send(/*scans=*/true);
      case 3:
        return Send(/*scans=*/false);
      case 4:
        return Read();
      default:
        return Plan();
    }
  }
  double refused() const { return refused_; }

 private:
  struct Robot {
    client::RobotSession session;
    std::int64_t applied = 1;
  };

  void Create(const MissionOptions& options) {
    if (robots_.size() >= kMostMissions) {
      Count(client_->DeleteMission(robots_.begin()->first));
      robots_.erase(robots_.begin());
    }
    const MissionId mission = absl::StrCat("hoard-", ++created_);
    const absl::Status made = client_->CreateMission(mission, options);
    Count(made);
    if (!made.ok()) return;
    const auto session = PlaceRobot(*client_, mission, "hoarder", {5.0, 5.0, 0.0});
    Count(session.status());
    if (session.ok()) robots_[mission] = {*session};
  }
  Robot* AnyRobot() {
    if (robots_.empty()) return nullptr;
    auto found = robots_.begin();
    std::advance(found, static_cast<std::ptrdiff_t>(rng_.Below(robots_.size())));
    return &found->second;
  }
  Observation Seen(std::int64_t sequence, bool scan) {
    Observation observation;
    observation.sequence = sequence;
    observation.sample_time_ns = absl::ToUnixNanos(absl::Now());
    observation.pose = {rng_.Uniform(-kSpread_m, kSpread_m), rng_.Uniform(-kSpread_m, kSpread_m),
                        0.0};
    if (scan) {
      observation.payload =
          Scan{-std::numbers::pi, 2.0 * std::numbers::pi / kBeams, kFar_m,
               std::vector<float>(kBeams, std::numeric_limits<float>::infinity())};
    } else {
      observation.payload = GasReading{.concentration_ppm = rng_.Uniform(0.0, 100.0)};
    }
    return observation;
  }
  void Send(bool scans) {
    Robot* const robot = AnyRobot();
    if (robot == nullptr) return;
    const auto stream = client_->OpenObservationStream(robot->session);
    Count(stream.status());
    if (!stream.ok()) return;
    std::int64_t next = (*stream)->opened().applied_sequence + 1;
    std::vector<Observation> batch;
    const int count = scans ? 4 : kBatch;
    for (int i = 0; i < count; ++i) batch.push_back(Seen(next + i, scans));
    Count((*stream)->Write(batch));
    (*stream)->Read(kReply).status().IgnoreError();
  }
  void Read() {
    const Robot* const robot = AnyRobot();
    if (robot != nullptr) Count(client_->GetMap(robot->session.mission).status());
  }
  void Plan() {
    const Robot* const robot = AnyRobot();
    if (robot == nullptr) return;
    client::PlanQuery query;
    query.request.robot = robot->session.robot;
    query.lease_token = robot->session.lease_token;
    query.timeout = kCallTimeout;
    Count(client_->NextBestTrajectory(robot->session.mission, query).status());
  }
  void Count(const absl::Status& status) { refused_ += status.ok() ? 0.0 : 1.0; }

  const std::unique_ptr<client::PlannerClient> client_;
  Rng rng_;
  int created_ = 0;
  double refused_ = 0.0;
  std::map<MissionId, Robot> robots_;
};

// Random requests.
absl::StatusOr<std::vector<Bar>> Hoard(const RowSettings& settings, const MemoryBudget& budget) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto server,
                              ServerProcess::Start({settings.server_program, budget.settings}));
  Hoarder hoarder(server->target(), settings.seed);
  double requests = 0.0;
  double peak_mb = 0.0;
  for (const absl::Time end = absl::Now() + settings.time;
       absl::Now() < end && peak_mb < kUnbearable_mb; ++requests) {
    hoarder.Act();
    const auto usage = server->Usage();
    if (!usage.ok()) break;
    peak_mb = std::max(peak_mb, usage->peak_rss_mb);
  }
  return std::vector<Bar>{
      {"memory_peak_rss_mb", peak_mb, budget.limit_mb()},
      MustHold("memory_server_ended", server->IsAlive()),
      {"memory_requests", requests},
      {"memory_refused", hoarder.refused()},
  };
}

// All that there is room for, again and again: once for each way to begin with.
absl::StatusOr<std::vector<Bar>> FillUp(const RowSettings& settings, MemoryBudget budget) {
  for (const char* free : {"limits.max_missions=64", "limits.max_scans_per_s=0",
                           "limits.max_gas_readings_per_s=0", "limits.max_ingest_bytes_per_s=0"}) {
    budget.settings.emplace_back(free);
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto server,
                              ServerProcess::Start({settings.server_program, budget.settings}));
  const absl::Time end = absl::Now() + kFillTimes * settings.time;
  double peak_mb = 0.0;
  const auto look = [&] {
    const auto usage = server->Usage();
    if (usage.ok()) peak_mb = std::max(peak_mb, usage->peak_rss_mb);
    return usage.ok() && absl::Now() < end && peak_mb < kUnbearable_mb;
  };
  BudgetFiller filler(server->target(), look);
  int missions = 0;
  std::size_t rounds = 0;
  for (; look(); ++rounds) {
    missions = std::max(missions,
                        filler.Fill(static_cast<BudgetFiller::Way>(rounds % BudgetFiller::kWays)));
    filler.Look();
    look();
    filler.Clear();
  }
  return std::vector<Bar>{
      {"memory_full_peak_rss_mb", peak_mb, budget.limit_mb()},
      {"memory_full_budget_mb", budget.budget_mb},
      MustHold("memory_full_server_ended", server->IsAlive()),
      {"memory_full_missions", static_cast<double>(missions)},
      {"memory_full_rounds", static_cast<double>(rounds)},
      {"memory_full_requests", filler.requests()},
      {"memory_full_refused", filler.refused()},
  };
}

}  // namespace

absl::StatusOr<std::vector<Bar>> MemoryRow(const RowSettings& settings) {
  const MemoryBudget budget = SmallBudget(settings.server_program);
  PLUMESCOUT_ASSIGN_OR_RETURN(std::vector<Bar> bars, Hoard(settings, budget));
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<Bar> full, FillUp(settings, budget));
  bars.insert(bars.end(), full.begin(), full.end());
  return bars;
}

}  // namespace plumescout::lab
