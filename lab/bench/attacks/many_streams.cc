// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <variant>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "client/grpc_planner_client.h"
#include "core/types/status_macros.h"
#include "lab/bench/attacks/attack_bed.h"

namespace plumescout::lab {
namespace {

constexpr char kMission[] = "crowd";
constexpr int kRobots = 50;
constexpr double kRadius_m = 0.2;
constexpr absl::Duration kPatience = absl::Seconds(5);

// Whether one reading goes through the stream.
bool Works(client::ObservationStream& stream, std::int64_t index) {
  const std::int64_t sequence = stream.opened().applied_sequence + 1;
  const Pose2 pose{0.5 * static_cast<double>(index), 1.0, 0.0};
  if (!stream.Write({{sequence, absl::ToUnixNanos(absl::Now()), pose, GasReading{1.0, 0.0}}}).ok())
    return false;
  for (const absl::Time end = absl::Now() + kPatience; absl::Now() < end;) {
    const auto reply = stream.Read(kPatience);
    if (!reply.ok()) return false;
    const auto* state = std::get_if<client::IngestState>(&*reply);
    if (state != nullptr && state->applied_sequence >= sequence) return true;
  }
  return false;
}

absl::StatusOr<std::vector<Bar>> Run(const AttackSettings& settings) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto bed, AttackBed::Start(settings));
  const auto client = client::MakeGrpcPlannerClient({.target = bed->target()});
  MissionOptions options;
  options.max_robot_count = kRobots;
  PLUMESCOUT_RETURN_IF_ERROR(client->CreateMission(kMission, options));
  bed->Take();
  std::vector<std::unique_ptr<client::ObservationStream>> streams;
  double refused = 0.0;
  for (int i = 0; i < kRobots; ++i) {
    auto session =
        client->RegisterRobot(kMission, absl::StrCat("robot-", i), kRadius_m, /*take_over=*/false);
    if (session.ok()) {
      auto stream = client->OpenObservationStream(*session);
      if (stream.ok()) {
        streams.push_back(*std::move(stream));
        continue;
      }
    }
    refused += 1.0;
  }
  double dead = 0.0;
  std::int64_t index = 0;
  for (const auto& stream : streams) dead += Works(*stream, ++index) ? 0.0 : 1.0;
  absl::SleepFor(settings.time);
  std::vector<Bar> bars = bed->Judge(bed->Take());
  bars.push_back({"streams refused", refused, 0.0});
  bars.push_back({"streams that take nothing", dead, 0.0});
  return bars;
}

}  // namespace

Attack ManyStreamsAttack() {
  return {"many_streams", "50 robots of one mission, each with a stream",
          "32 opened, 8 robots took 418 MB", &Run};
}

}  // namespace plumescout::lab
