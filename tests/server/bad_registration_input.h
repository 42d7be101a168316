// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <string>

#include "absl/strings/str_cat.h"
#include "plumescout/v1/robot_service.pb.h"
#include "tests/server/bad_input.h"
#include "tests/server/bad_mission_input.h"

namespace plumescout::server {

// The first of one or more.
inline BadInputs BadGasSensor() {
  BadInputs rows;
  const auto values = [&](const std::string& field, std::initializer_list<const char*> values) {
    for (const char* value : values) {
      rows.Row({"gas_sensors." + field, value,
                [field, value = std::string(value)](Message& message) {
                  SetField(message, "gas_sensors.id", R"("pid")");
                  SetField(message, "gas_sensors." + field, value);
                },
                absl::StatusCode::kInvalidArgument, "gas_sensors[0]." + field});
    }
  };
  values("id", {R"("")", R"("PID")", R"("a/b")"});
  values("robot_from_sensor.x_m", {"nan", "inf", "-inf", "11", "-1e300"});
  values("robot_from_sensor.y_m", {"nan", "inf", "-inf", "11", "-1e300"});
  values("stddev_ppm", {"nan", "inf", "-1", "1e7"});
  values("offset_stddev_ppm", {"nan", "inf", "-1", "1e7"});
  values("response_time_s", {"nan", "inf", "-1", "3601"});
  values("species", {R"("ozone")"});
  rows.Row({"gas_sensors", "two of one name",
            [](Message& message) {
              auto& request = static_cast<v1::RegisterRobotRequest&>(message);
              request.add_gas_sensors()->set_id("pid");
              request.add_gas_sensors()->set_id("pid");
            },
            absl::StatusCode::kInvalidArgument, "gas_sensors[1].id"});
  return rows.Row({"gas_sensors", "17 of them",
                   [](Message& message) {
                     auto& request = static_cast<v1::RegisterRobotRequest&>(message);
                     for (int i = 0; i < 17; ++i) {
                       request.add_gas_sensors()->set_id(absl::StrCat("s", i));
                     }
                   },
                   absl::StatusCode::kInvalidArgument, "gas_sensors"});
}

inline BadInputs BadRegisterRobot() {
  return BadInputs()
      .Rows(BadMissionName("mission"))
      .Rows(BadId("robot_id"))
      .Rows(BadRequestId())
      .Values("radius_m", {"nan", "inf", "-inf", "-1", "0", "6"})
      .Values("log_epoch", {"-1", "9007199254740992"})
      .Values("frame.mission_from_robot.x_m", {"nan", "inf", "-inf", "1001", "-1e300"})
      .Values("frame.mission_from_robot.y_m", {"nan", "inf", "-inf", "1001", "-1e300"})
      .Values("frame.mission_from_robot.yaw_rad", {"nan", "inf", "-inf"})
      .Values("frame.position_stddev_m", {"nan", "inf", "-1", "10.5"})
      .Values("frame.heading_stddev_rad", {"nan", "inf", "-1", "3.5"})
      .Rows(BadGasSensor());
}

}  // namespace plumescout::server
