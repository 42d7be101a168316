// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/program/robot_run.h"

#include <google/protobuf/descriptor.h>

#include <utility>

#include "absl/strings/str_cat.h"
#include "client/robot_view.h"
#include "core/types/status_macros.h"
#include "plumescout/v1/robot_service.pb.h"
#include "proto/convert/observation.h"
#include "proto/convert/robot.h"
#include "proto/convert/robot_frame.h"

namespace plumescout::lab {
namespace {

absl::StatusOr<Observation> ReadObservation(const McapMessage& message) {
  v1::Observation proto;
  if (!proto.ParseFromString(message.data)) {
    return absl::InvalidArgumentError(absl::StrCat("message ", message.sequence, " of ",
                                                   client::kObservationsTopic,
                                                   " is no plumescout.v1.Observation"));
  }
  return FromProto(proto, absl::StrCat("observation ", proto.sequence()));
}

}  // namespace

absl::StatusOr<std::optional<RobotRun>> RobotRun::Open(const std::string& path) {
  if (!McapReader::IsMcap(path)) return std::optional<RobotRun>();
  PLUMESCOUT_ASSIGN_OR_RETURN(McapReader reader, McapReader::Open(path));
  RobotRun run(std::move(reader));
  v1::RegisterRobotRequest registration;
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::optional<McapMessage> first, run.reader_.Next());
  if (!first ||
      !run.Is(*first, client::kRegistrationTopic, registration.GetDescriptor()->full_name())) {
    return std::optional<RobotRun>();
  }
  if (!registration.ParseFromString(first->data)) {
    return absl::DataLossError(
        absl::StrCat(path, ": ", client::kRegistrationTopic, " holds no registration"));
  }
  run.robot_ = registration.robot_id();
  run.radius_m_ = registration.radius_m();
  if (registration.has_frame()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(run.outfit_.frame, FromProto(registration.frame(), "frame"));
  }
  run.outfit_.sensors = SensorsFromProto(registration);
  return std::optional<RobotRun>(std::move(run));
}

bool RobotRun::Is(const McapMessage& message, absl::string_view topic,
                  const std::string& type) const {
  const McapChannel& channel = reader_.channels().at(message.channel);
  const auto schema = reader_.schemas().find(channel.schema);
  return channel.topic == topic && schema != reader_.schemas().end() && schema->second.name == type;
}

absl::StatusOr<std::optional<Observation>> RobotRun::Next() {
  while (true) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const std::optional<McapMessage> message, reader_.Next());
    if (!message) return std::optional<Observation>();
    if (!Is(*message, client::kObservationsTopic, v1::Observation::descriptor()->full_name())) {
      continue;
    }
    absl::StatusOr<Observation> observation = ReadObservation(*message);
    if (observation.ok()) return std::optional<Observation>(*std::move(observation));
    if (senseless_++ == 0) first_senseless_ = observation.status();
  }
}

}  // namespace plumescout::lab
