// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "client/grpc_planner_client.h"
#include "core/types/status_macros.h"
#include "lab/bench/attacks/attack_bed.h"

namespace plumescout::lab {
namespace {

constexpr char kMission[] = "talkative";
constexpr int kRegistrations = 2000;  // several times what a pipe holds
constexpr double kRadius_m = 0.2;
constexpr absl::Duration kCallTimeout = absl::Seconds(2);

// Calls that the server logs; how many of them failed. The first failure ends the series: a server
// whose log blocks answers none after it.
double Register(client::PlannerClient& client) {
  for (int i = 0; i < kRegistrations; ++i) {
    const auto session = client.RegisterRobot(kMission, "talker", kRadius_m, /*take_over=*/true);
    if (!session.ok()) return 1.0;
  }
  return 0.0;
}

absl::StatusOr<std::vector<Bar>> Run(const AttackSettings& settings) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto bed, AttackBed::Start(settings, {.log_unread = true}));
  const auto client =
      client::MakeGrpcPlannerClient({.target = bed->target(), .call_timeout = kCallTimeout});
  PLUMESCOUT_RETURN_IF_ERROR(client->CreateMission(kMission, MissionOptions{}));
  bed->Take();
  const double unread = Register(*client);
  bed->server().HangUpLog();
  const double hung_up = Register(*client);
  std::vector<Bar> bars = bed->Judge(bed->Take());
  bars.push_back({"calls failed, log not read", unread, 0.0});
  bars.push_back({"calls failed, reader gone", hung_up, 0.0});
  return bars;
}

}  // namespace

Attack LogUnreadAttack() {
  return {"log_unread", "a log that nobody reads, then one whose reader is gone",
          "a mission's writer blocked for ever; SIGPIPE kills", &Run};
}

}  // namespace plumescout::lab
