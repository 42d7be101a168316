// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "absl/time/clock.h"
#include "client/grpc_planner_client.h"
#include "core/types/status_macros.h"
#include "lab/bench/attacks/attack.h"
#include "lab/bench/load/known_map.h"
#include "lab/bench/load/open_calls.h"
#include "lab/bench/load/server_process.h"

namespace plumescout::lab {
namespace {

constexpr char kMission[] = "large";
constexpr double kDrain_s = 2.0;
constexpr absl::Duration kPatience = absl::Seconds(60);
constexpr absl::Duration kUnderWay = absl::Milliseconds(100);

absl::StatusOr<std::vector<Bar>> Run(const AttackSettings& settings) {
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const auto server, ServerProcess::Start({settings.server_program, LargeFieldSettings()}));
  const auto client =
      client::MakeGrpcPlannerClient({.target = server->target(), .call_timeout = kPatience});
  PLUMESCOUT_RETURN_IF_ERROR(client->CreateMission(kMission, LargeField()));
  const auto calls = OpenCalls::ReadFreshMap(server->target(), kMission, 1);
  absl::SleepFor(kUnderWay);
  const bool in_refresh = calls->ended() == 0;
  const auto taken = server->Stop(kPatience);
  return std::vector<Bar>{
      {"drain, s", absl::ToDoubleSeconds(taken.value_or(kPatience)), kDrain_s},
      MustHold("no refresh was under way", in_refresh),
  };
}

}  // namespace

Attack StopInRefreshAttack() {
  return {"stop_in_refresh", "SIGTERM while the gas of a million cells is computed", "25 s", &Run};
}

}  // namespace plumescout::lab
