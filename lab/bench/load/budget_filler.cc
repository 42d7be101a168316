// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/load/budget_filler.h"

#include <grpcpp/grpcpp.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "client/grpc_planner_client.h"
#include "lab/bench/load/known_map.h"
#include "lab/bench/load/own_channel.h"
#include "plumescout/v1/map_service.grpc.pb.h"
#include "proto/convert/names.h"

namespace plumescout::lab {
namespace {

constexpr absl::Duration kCallTimeout = absl::Seconds(20);
constexpr int kLargestSide = 4000;  // cells; the default limit of maps
constexpr double kSmaller = 0.8;    // the next side to try
constexpr int kFarBeams = 720;
constexpr double kFarView_m = 95.0;
constexpr int kMostBatches = 4000;
constexpr int kReadingsAtOnce = 512;
constexpr int kPatience = 8;  // batches in a row of which all was refused
constexpr int kUnreadWatches = 16;

Scan FarScan() {
  return {-std::numbers::pi, 2.0 * std::numbers::pi / kFarBeams, kFarView_m,
          std::vector<float>(kFarBeams, std::numeric_limits<float>::infinity())};
}

// The n-th place of a spiral whose turns are `spacing_m` apart, as its places are.
Pose2 OnSpiral(std::int64_t n, double spacing_m) {
  const double turn = std::sqrt(4.0 * std::numbers::pi * static_cast<double>(n));
  const double radius_m = spacing_m * turn / (2.0 * std::numbers::pi);
  return {radius_m * std::cos(turn), radius_m * std::sin(turn), 0.0};
}

std::vector<Observation> NextBatch(std::int64_t first, BudgetFiller::Way way) {
  const bool scans = way == BudgetFiller::Way::kFarScans;
  constexpr double kScanSpacing_m = 25.0;
  constexpr double kReadingSpacing_m = 0.15;  // each on a cell of its own
  std::vector<Observation> batch;
  for (std::int64_t i = first; i < first + (scans ? 1 : kReadingsAtOnce); ++i) {
    Observation& observation = batch.emplace_back();
    observation.sequence = i;
    observation.sample_time_ns = absl::ToUnixNanos(absl::Now());
    observation.pose = OnSpiral(i, scans ? kScanSpacing_m : kReadingSpacing_m);
    if (scans) {
      observation.payload = FarScan();
    } else {
      observation.payload = GasReading{.concentration_ppm = static_cast<double>(i % 97)};
    }
  }
  return batch;
}

}  // namespace

// A watcher whose answers nobody takes.
struct BudgetFiller::UnreadWatch {
  UnreadWatch(const std::string& target, const MissionId& mission) : stub(OwnChannel(target)) {
    v1::WatchMapRequest request;
    request.set_mission(MissionResource(mission));
    reader = stub.WatchMap(&context, request);
  }
  ~UnreadWatch() {
    context.TryCancel();
    v1::WatchMapResponse frame;
    while (reader->Read(&frame)) {
    }
    reader->Finish();
  }

  v1::MapService::Stub stub;
  grpc::ClientContext context;
  std::unique_ptr<grpc::ClientReader<v1::WatchMapResponse>> reader;
};

BudgetFiller::BudgetFiller(const std::string& target, std::function<bool()> go_on)
    : target_(target),
      go_on_(std::move(go_on)),
      client_(client::MakeGrpcPlannerClient({.target = target, .call_timeout = kCallTimeout})) {}

BudgetFiller::~BudgetFiller() = default;

bool BudgetFiller::Took(const absl::Status& status) {
  requests_ += 1.0;
  refused_ += status.ok() ? 0.0 : 1.0;
  return status.ok();
}

int BudgetFiller::Fill(Way first) {
  for (std::size_t i = 0; go_on_(); ++i) {
    const Way way = static_cast<Way>((static_cast<std::size_t>(first) + i) % kWays);
    const MissionId mission = absl::StrCat("full-", ++made_);
    if (!Make(mission, way).ok()) break;
    const auto session = PlaceRobot(*client_, mission, "filler", {5.0, 5.0, 0.0});
    if (!Took(session.status())) break;
    sessions_.push_back(*session);
    Fill(*session, way);
  }
  return static_cast<int>(sessions_.size());
}

absl::Status BudgetFiller::Make(const MissionId& mission, Way way) {
  const bool has_map = way != Way::kFarScans;
  if (!has_map) {
    MissionOptions options;
    options.max_robot_speed_mps = 0.0;  // it scans faster than anybody drives
    const absl::Status made = client_->CreateMission(mission, options);
    Took(made);
    return made;
  }
  // The largest that fits.
  absl::Status made;
  for (double side = kLargestSide; side > 10.0 && go_on_(); side *= kSmaller) {
    MissionOptions options = WithMap(KnownHall(static_cast<int>(side)));
    options.max_robot_speed_mps = 0.0;
    if (way == Way::kSeveralGases) {
      for (const char* name : {"co", "h2s", "ch4", "nh3"}) {
        options.gas_species.emplace_back().name = name;
      }
    }
    made = client_->CreateMission(mission, options);
    if (Took(made)) break;
  }
  return made;
}

void BudgetFiller::Fill(const client::RobotSession& session, Way way) {
  int in_vain = 0;
  std::int64_t next = 2;  // the first was the scan that placed it
  for (int batch = 0; batch < kMostBatches && in_vain < kPatience && go_on_(); ++batch) {
    const std::vector<Observation> observations = NextBatch(next, way);
    next += static_cast<std::int64_t>(observations.size());
    in_vain = Send(session, observations) ? 0 : in_vain + 1;
  }
}

// Whether any of it was taken.
bool BudgetFiller::Send(const client::RobotSession& session,
                        const std::vector<Observation>& batch) {
  const auto reply = client_->IngestBatch(session, batch);
  return Took(reply.status()) && reply->rejected.size() < batch.size();
}

void BudgetFiller::Look() {
  for (const client::RobotSession& session : sessions_) {
    if (!go_on_()) return;
    client::PlanQuery query;
    query.request.robot = session.robot;
    query.lease_token = session.lease_token;
    query.timeout = kCallTimeout;
    Took(client_->NextBestTrajectory(session.mission, query).status());
    Took(client_->GetMap(session.mission).status());
    for (int i = 0; i < kUnreadWatches; ++i) {
      watches_.push_back(std::make_unique<UnreadWatch>(target_, session.mission));
    }
  }
}

void BudgetFiller::Clear() {
  watches_.clear();
  for (const client::RobotSession& session : sessions_) {
    Took(client_->DeleteMission(session.mission));
  }
  sessions_.clear();
}

}  // namespace plumescout::lab
