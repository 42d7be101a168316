// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include <grpcpp/grpcpp.h>

#include <algorithm>
#include <atomic>
#include <thread>

#include "absl/time/clock.h"
#include "client/grpc_planner_client.h"
#include "core/types/quantile.h"
#include "core/types/status_macros.h"
#include "lab/bench/attacks/attack_bed.h"
#include "lab/bench/load/known_map.h"
#include "plumescout/v1/mission_service.grpc.pb.h"
#include "proto/convert/names.h"

namespace plumescout::lab {
namespace {

constexpr char kMission[] = "well-known";
constexpr int kReaders = 4;
constexpr int kSide = 1500;  // cells
constexpr double kSlower = 1.5;
constexpr double kFloor_ms = 2.0;

// Reads the mission with its map until told to stop.
void Read(const std::string& target, const std::atomic<bool>& stopping) {
  v1::MissionService::Stub stub(grpc::CreateChannel(target, grpc::InsecureChannelCredentials()));
  v1::GetMissionRequest request;
  request.set_name(MissionResource(kMission));
  while (!stopping) {
    grpc::ClientContext context;
    v1::GetMissionResponse response;
    stub.GetMission(&context, request, &response);
  }
}

// Makes and deletes a mission with a map until told to stop.
void Create(const std::string& target, const std::atomic<bool>& stopping) {
  const auto client = client::MakeGrpcPlannerClient({.target = target});
  const MissionOptions options = WithMap(KnownHall(kSide));
  while (!stopping) {
    client->CreateMission("comes-and-goes", options).IgnoreError();
    client->DeleteMission("comes-and-goes").IgnoreError();
  }
}

absl::StatusOr<std::vector<Bar>> Run(const AttackSettings& settings) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto bed, AttackBed::Start(settings));
  const auto client = client::MakeGrpcPlannerClient({.target = bed->target()});
  PLUMESCOUT_RETURN_IF_ERROR(client->CreateMission(kMission, WithMap(KnownHall(kSide))));
  bed->Take();
  std::atomic<bool> stopping = false;
  std::vector<std::thread> threads;
  for (int i = 0; i < kReaders; ++i) {
    threads.emplace_back([&] { Read(bed->target(), stopping); });
  }
  threads.emplace_back([&] { Create(bed->target(), stopping); });
  absl::SleepFor(settings.time);
  const HonestFigures during = bed->Take();
  stopping = true;
  for (std::thread& thread : threads) thread.join();
  std::vector<Bar> bars = bed->Judge(during);
  const double before_ms = Median(bed->before().quick_ms);
  bars.push_back({"list p50 before, ms", before_ms});
  bars.push_back(
      {"list p50, ms", Median(during.quick_ms), std::max(kSlower * before_ms, kFloor_ms)});
  return bars;
}

}  // namespace

Attack KnownMapReadersAttack() {
  return {"known_map_readers", "four readers of a mission with a known map, one that makes such",
          "others' p50 1.9 ms instead of 0.7 ms", &Run};
}

}  // namespace plumescout::lab
