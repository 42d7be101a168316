// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include <grpcpp/grpcpp.h>

#include <chrono>
#include <string>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "client/grpc_planner_client.h"
#include "core/types/quantile.h"
#include "core/types/status_macros.h"
#include "lab/bench/attacks/attack_bed.h"
#include "lab/bench/load/known_map.h"
#include "plumescout/v1/ingest_service.grpc.pb.h"
#include "proto/convert/names.h"

namespace plumescout::lab {
namespace {

constexpr int kManyBeams = 100'000;  // the most that the wire takes
constexpr int kLegalBeams = 4096;    // the most that a server takes of a mission of default options
constexpr double kFan_rad = 1e-3;
constexpr double kView_m = 95.0;
constexpr double kWall_s = 0.02;
constexpr absl::Duration kScanPeriod = absl::Milliseconds(50);
constexpr std::chrono::seconds kPatience(60);

// A mission of the attacker's own, and its robot.
struct Place {
  v1::IngestService::Stub stub;
  std::string robot;
  std::int64_t lease_token = 0;
  std::int64_t sequence = 1;
};

// Wall time of one scan of near-parallel beams that see nothing.
double Send_s(Place& place, int beams) {
  v1::BatchIngestObservationsRequest request;
  request.mutable_open()->set_robot(place.robot);
  request.mutable_open()->set_lease_token(place.lease_token);
  v1::Observation& observation = *request.mutable_batch()->add_observations();
  observation.set_sequence(++place.sequence);
  observation.set_sample_time_ns(absl::ToUnixNanos(absl::Now()));
  observation.mutable_pose()->set_yaw_rad(0.1 * static_cast<double>(place.sequence));
  v1::LaserScan& scan = *observation.mutable_scan();
  scan.set_angle_step_rad(kFan_rad / beams);
  scan.set_max_range_m(kView_m);
  scan.set_range_unit_m(0.005);
  scan.set_ranges_u16(std::string(static_cast<std::size_t>(2 * beams), '\0'));
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + kPatience);
  v1::BatchIngestObservationsResponse response;
  const absl::Time sent = absl::Now();
  const grpc::Status status = place.stub.BatchIngestObservations(&context, request, &response);
  // A batch that was refused whole leaves the log where it was.
  if (!status.ok()) --place.sequence;
  return absl::ToDoubleSeconds(absl::Now() - sent);
}

absl::StatusOr<std::vector<Bar>> Run(const AttackSettings& settings) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto bed, AttackBed::Start(settings));
  const auto client = client::MakeGrpcPlannerClient({.target = bed->target()});
  MissionOptions options;
  options.max_beam_count = kManyBeams;
  const absl::Status lifted = client->CreateMission("narrow", options);
  if (!lifted.ok()) {
    PLUMESCOUT_RETURN_IF_ERROR(client->CreateMission("narrow", MissionOptions{}));
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(const client::RobotSession session,
                              PlaceRobot(*client, "narrow", "beamer", {}));
  Place place{v1::IngestService::Stub(
                  grpc::CreateChannel(bed->target(), grpc::InsecureChannelCredentials())),
              RobotResource({"narrow", "beamer"}), session.lease_token};
  bed->Take();
  const double many_s = Send_s(place, kManyBeams);
  std::vector<double> legal_s;
  for (const absl::Time end = absl::Now() + settings.time; absl::Now() < end;) {
    legal_s.push_back(Send_s(place, kLegalBeams));
    absl::SleepFor(kScanPeriod);
  }
  std::vector<Bar> bars = bed->Judge(bed->Take());
  bars.push_back({"client lifts the limit", lifted.ok() ? 1.0 : 0.0});
  bars.push_back({absl::StrCat("scan of ", kManyBeams, " beams, s"), many_s, kWall_s});
  bars.push_back(
      {absl::StrCat("scan of ", kLegalBeams, " beams, median, s"), Median(legal_s), kWall_s});
  return bars;
}

}  // namespace

Attack NarrowBeamsAttack() {
  return {"narrow_beams", "a scan of 100,000 beams within a milliradian",
          "22 s of CPU; a window of 128 is 47 min", &Run};
}

}  // namespace plumescout::lab
