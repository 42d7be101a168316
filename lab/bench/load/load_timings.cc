// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/load/load_timings.h"

#include <grpcpp/grpcpp.h>

#include <limits>

#include "plumescout/v1/mission_service.grpc.pb.h"
#include "proto/convert/names.h"

namespace plumescout::lab {
namespace {

double Milliseconds(const v1::Latency& latency, double seconds) {
  return latency.sample_count() > 0 ? 1e3 * seconds : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

absl::StatusOr<LoadTimings> AskLoadTimings(const std::string& target, const MissionId& mission) {
  v1::MissionService::Stub stub(grpc::CreateChannel(target, grpc::InsecureChannelCredentials()));
  grpc::ClientContext context;
  v1::GetMissionRequest request;
  request.set_name(MissionResource(mission));
  v1::GetMissionResponse response;
  const grpc::Status status = stub.GetMission(&context, request, &response);
  if (!status.ok()) return absl::UnavailableError(status.error_message());
  const v1::Latency& update = response.mission().gas_timings().update();
  const v1::Latency& staleness = response.mission().gas_timings().staleness();
  return LoadTimings{response.mission().revision(), Milliseconds(update, update.median_s()),
                     Milliseconds(update, update.p99_s()),
                     Milliseconds(staleness, staleness.median_s()),
                     Milliseconds(staleness, staleness.p99_s())};
}

}  // namespace plumescout::lab
