// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/sensor_offset.h"

#include "core/types/status_macros.h"
#include "proto/convert/field.h"
#include "proto/convert/names.h"

namespace plumescout {

absl::StatusOr<SensorOffset> FromProto(const v1::SensorOffset& proto, absl::string_view field) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const RobotName name,
                              ParseRobotName(Join(field, "robot"), proto.robot()));
  PLUMESCOUT_RETURN_IF_ERROR(CheckFinite(Join(field, "offset_ppm"), proto.offset_ppm()));
  PLUMESCOUT_RETURN_IF_ERROR(CheckNotNegative(Join(field, "stddev_ppm"), proto.stddev_ppm()));
  return SensorOffset{.robot = name.robot,
                      .sensor = proto.sensor(),
                      .offset_ppm = proto.offset_ppm(),
                      .stddev_ppm = proto.stddev_ppm(),
                      .crossings = proto.crossing_count(),
                      .estimated = proto.estimated(),
                      .drifting = proto.drifting(),
                      .species = proto.species()};
}

v1::SensorOffset ToProto(const SensorOffset& offset, const MissionId& mission) {
  v1::SensorOffset proto;
  proto.set_robot(RobotResource({mission, offset.robot}));
  proto.set_sensor(offset.sensor);
  proto.set_offset_ppm(offset.offset_ppm);
  proto.set_stddev_ppm(offset.stddev_ppm);
  proto.set_crossing_count(offset.crossings);
  proto.set_estimated(offset.estimated);
  proto.set_drifting(offset.drifting);
  proto.set_species(offset.species);
  return proto;
}

}  // namespace plumescout
