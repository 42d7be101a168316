// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/robot.h"

namespace plumescout {

std::vector<GasSensor> SensorsFromProto(const v1::RegisterRobotRequest& request) {
  std::vector<GasSensor> sensors;
  for (const v1::GasSensor& sensor : request.gas_sensors()) {
    sensors.push_back(
        {.id = sensor.id(),
         .robot_from_sensor = {sensor.robot_from_sensor().x_m(), sensor.robot_from_sensor().y_m()},
         .stddev_ppm = sensor.stddev_ppm(),
         .offset_stddev_ppm = sensor.offset_stddev_ppm(),
         .species = sensor.species(),
         .response_time_s = sensor.response_time_s()});
  }
  return sensors;
}

void ToProto(const std::vector<GasSensor>& sensors, v1::RegisterRobotRequest& request) {
  for (const GasSensor& sensor : sensors) {
    v1::GasSensor& added = *request.add_gas_sensors();
    added.set_id(sensor.id);
    added.mutable_robot_from_sensor()->set_x_m(sensor.robot_from_sensor.x_m);
    added.mutable_robot_from_sensor()->set_y_m(sensor.robot_from_sensor.y_m);
    added.set_stddev_ppm(sensor.stddev_ppm);
    added.set_offset_stddev_ppm(sensor.offset_stddev_ppm);
    added.set_species(sensor.species);
    added.set_response_time_s(sensor.response_time_s);
  }
}

}  // namespace plumescout
