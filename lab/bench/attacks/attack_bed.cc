// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/attacks/attack_bed.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "client/grpc_planner_client.h"
#include "core/types/quantile.h"
#include "core/types/status_macros.h"
#include "lab/worlds/bench_world.h"

namespace plumescout::lab {
namespace {

constexpr int kWidth = 160;  // of the building: 16 x 20 m
constexpr int kHeight = 200;
constexpr absl::Duration kPlanPeriod = absl::Milliseconds(200);
constexpr absl::Duration kListPeriod = absl::Milliseconds(20);
constexpr double kMedian = 0.5;
constexpr double kTail = 0.99;

// An honest call may take so much longer than before, and so much in any case: what a scheduler
// with two cores for server, attacker and honest callers adds.
constexpr double kSlower = 2.0;
constexpr double kPlanFloor_ms = 100.0;
constexpr double kQuickFloor_ms = 20.0;

}  // namespace

absl::StatusOr<std::unique_ptr<AttackBed>> AttackBed::Start(const AttackSettings& settings,
                                                            const BedOptions& options) {
  MemoryBudget budget = DefaultBudget(settings.server_program);
  ServerStart start{settings.server_program, options.settings, options.max_descriptors,
                    options.log_unread};
  // Whoever attacks calls from the same address as honest callers, without a name, and would spend
  // their quota as well: what holds beneath the door is what is to be seen.
  for (const char* quota : {"limits.max_calls_per_s", "limits.max_costly_calls_per_s"}) {
    if (DefaultOf(settings.server_program, quota).has_value()) {
      start.settings.push_back(absl::StrCat(quota, "=0"));
    }
  }
  start.settings.insert(start.settings.end(), budget.settings.begin(), budget.settings.end());
  PLUMESCOUT_ASSIGN_OR_RETURN(auto server, ServerProcess::Start(start));
  std::unique_ptr<FrontProcess> front;
  if (options.behind_front && !settings.front_config.empty()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(front,
                                FrontProcess::Start(settings.front_config, server->target()));
  }
  auto bed = std::make_unique<AttackBed>(Private(), settings, std::move(budget), std::move(server),
                                         std::move(front));
  PLUMESCOUT_RETURN_IF_ERROR(bed->operator_->CreateMission(kHonestMission, MissionOptions{}));
  LoadRobotOptions robot;
  robot.participation.mission = kHonestMission;
  robot.participation.robot = "honest-robot";
  robot.start = FreePoses(bed->walls_, 1, settings.seed).front();
  robot.plan_period = kPlanPeriod;
  PLUMESCOUT_ASSIGN_OR_RETURN(
      bed->robot_,
      LoadRobot::Start(client::MakeGrpcPlannerClient(
                           {.target = bed->target(), .call_timeout = settings.patience}),
                       bed->walls_, robot));
  absl::SleepFor(settings.warm_up);
  bed->Take();
  absl::SleepFor(settings.time);
  bed->before_ = bed->Take();
  return bed;
}

AttackBed::AttackBed(Private, const AttackSettings& settings, MemoryBudget budget,
                     std::unique_ptr<ServerProcess> server, std::unique_ptr<FrontProcess> front)
    : walls_(MakeBuilding(kWidth, kHeight, settings.seed)),
      patience_(settings.patience),
      budget_(std::move(budget)),
      server_(std::move(server)),
      front_(std::move(front)),
      target_(front_ != nullptr ? front_->target() : server_->target()),
      operator_(
          client::MakeGrpcPlannerClient({.target = target_, .call_timeout = settings.patience})),
      operator_thread_([this] { RunOperator(); }) {}

AttackBed::~AttackBed() {
  stopping_ = true;
  operator_thread_.join();
  if (robot_ != nullptr) robot_->Stop(absl::ZeroDuration());
}

void AttackBed::RunOperator() {
  while (!stopping_) {
    const absl::Time asked = absl::Now();
    const bool listed = operator_->ListMissions().ok();
    const absl::Duration taken = absl::Now() - asked;
    {
      absl::MutexLock lock(&mutex_);
      if (listed) {
        quick_ms_.push_back(absl::ToDoubleMilliseconds(taken));
      } else {
        failures_ += 1.0;
      }
    }
    absl::SleepFor(kListPeriod - taken);
  }
}

HonestFigures AttackBed::Take() {
  const LoadRobotFigures robot = robot_->Take();
  HonestFigures figures;
  figures.plan_ms = robot.plan_wall_ms;
  absl::MutexLock lock(&mutex_);
  figures.quick_ms = std::exchange(quick_ms_, {});
  figures.failures = std::exchange(failures_, 0.0) + static_cast<double>(robot.plan_failures);
  return figures;
}

std::vector<Bar> AttackBed::Judge(const HonestFigures& during) {
  const auto limit = [](double before, double floor) { return std::max(kSlower * before, floor); };
  const double plan_before_ms = Quantile(before_.plan_ms, kTail);
  const double quick_before_ms = Quantile(before_.quick_ms, kTail);
  double peak_mb = std::numeric_limits<double>::quiet_NaN();
  if (const auto usage = server_->Usage(); usage.ok()) peak_mb = usage->peak_rss_mb;
  return {
      {"plan p50 before, ms", Quantile(before_.plan_ms, kMedian)},
      {"plan p50, ms", Quantile(during.plan_ms, kMedian)},
      {"plan p99 before, ms", plan_before_ms},
      {"plan p99, ms", Quantile(during.plan_ms, kTail), limit(plan_before_ms, kPlanFloor_ms)},
      {"list p99 before, ms", quick_before_ms},
      {"list p99, ms", Quantile(during.quick_ms, kTail), limit(quick_before_ms, kQuickFloor_ms)},
      {"honest calls failed", during.failures, 0.0},
      MustHold("newcomer not served", IsNewcomerServed()),
      MustHold("server ended", server_->IsAlive()),
      {"peak memory, MB", peak_mb, budget_.limit_mb()},
  };
}

bool AttackBed::IsNewcomerServed() const {
  return client::MakeGrpcPlannerClient({.target = target_, .call_timeout = patience_})
      ->ListMissions()
      .ok();
}

double AttackBed::Cpu_s() const {
  const auto usage = server_->Usage();
  return usage.ok() ? usage->cpu_s : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace plumescout::lab
