// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/ros2_flags.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <map>

#include "core/types/status_macros.h"

namespace plumescout::client {

void AddListenFlags(CLI::App& app, ListenFlags& flags) {
  app.add_option("--domain", flags.domain, "domain of DDS")
      ->envname("ROS_DOMAIN_ID")
      ->check(CLI::Range(0, 232))
      ->capture_default_str();
  app.add_option("--namespace", flags.topics.ros_namespace, "of the robot's topics");
  app.add_option("--scan-topic", flags.topics.scan, "sensor_msgs/LaserScan")->capture_default_str();
  app.add_option("--odom-topic", flags.topics.odometry, "nav_msgs/Odometry")->capture_default_str();
  app.add_option("--tf-topic", flags.topics.tf, "tf2_msgs/TFMessage")->capture_default_str();
  app.add_option("--tf-static-topic", flags.topics.tf_static, "tf2_msgs/TFMessage, latched")
      ->capture_default_str();
  app.add_option("--gas-topic", flags.topics.gas, "olfaction_msgs/GasSensor")
      ->capture_default_str();
  app.add_option("--wind-topic", flags.topics.wind, "olfaction_msgs/Anemometer")
      ->capture_default_str();
  app.add_option("--map-frame", flags.intake.map_frame)->capture_default_str();
  app.add_option("--odom-frame", flags.intake.odom_frame)->capture_default_str();
  app.add_option("--base-frame", flags.intake.base_frame)->capture_default_str();
  app.add_option("--gas-calibration", flags.gas_calibration,
                 "SCALE,EXPONENT: what is measured in VOLT or OHM is SCALE * raw ^ EXPONENT ppm");
  app.add_option("--transform-wait", flags.intake.transform_wait_s,
                 "seconds that a sample waits for the transform to where it was measured")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  app.add_option("--jump-distance", flags.intake.jump.distance_m,
                 "metres by which map -> odom moves at once when past poses were wrong")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--jump-angle", flags.intake.jump.angle_rad, "likewise, radians")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
}

void AddTellFlags(CLI::App& app, TellFlags& flags) {
  const std::map<std::string, Drives> drives{
      {"velocity", Drives::kVelocity}, {"path", Drives::kPath}, {"goal", Drives::kGoal}};
  app.add_option("--drive-by", flags.plan.drives,
                 "velocity: this program follows paths; path: somebody else follows what is on "
                 "--path-topic; goal: somebody else, such as Nav2, finds a way to what is on "
                 "--goal-topic")
      ->transform(CLI::CheckedTransformer(drives))
      ->default_str("velocity");
  app.add_flag("--stamped-velocity", flags.plan.stamped_velocity,
               "velocities as geometry_msgs/TwistStamped");
  app.add_option("--velocity-topic", flags.plan.topics.velocity, "geometry_msgs/Twist")
      ->capture_default_str();
  app.add_option("--path-topic", flags.plan.topics.path, "nav_msgs/Path")->capture_default_str();
  app.add_option("--goal-topic", flags.plan.topics.goal, "geometry_msgs/PoseStamped")
      ->capture_default_str();
  MapTopics& maps = flags.map.topics;
  app.add_option("--map-topic", maps.map,
                 "nav_msgs/OccupancyGrid, latched; empty where the robot's "
                 "own SLAM publishes it")
      ->capture_default_str();
  app.add_option("--gas-mean-topic", maps.gas_mean, "nav_msgs/OccupancyGrid, latched")
      ->capture_default_str();
  app.add_option("--gas-variance-topic", maps.gas_variance, "nav_msgs/OccupancyGrid, latched")
      ->capture_default_str();
  app.add_option("--gas-map-topic", maps.gas, "grid_map_msgs/GridMap, latched: numbers")
      ->capture_default_str();
  app.add_option("--frontier-topic", maps.frontiers, "visualization_msgs/MarkerArray, latched")
      ->capture_default_str();
  app.add_option("--gas-scale", flags.map.gas_scale_ppm,
                 "ppm that 100 is on --gas-mean-topic; 0: the largest mean")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--map-period", flags.map_period_s,
                 "seconds between maps, at least; 0: they are not published")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
}

absl::Status Prepare(ListenFlags& flags) {
  if (flags.gas_calibration.empty()) return absl::OkStatus();
  PLUMESCOUT_ASSIGN_OR_RETURN(flags.intake.gas_calibration, ReadCalibration(flags.gas_calibration));
  return absl::OkStatus();
}

void Prepare(const ListenFlags& listen, const RobotFrame& frame, TellFlags& flags) {
  flags.plan.topics.ros_namespace = listen.topics.ros_namespace;
  flags.plan.map_frame = listen.intake.map_frame;
  flags.plan.base_frame = listen.intake.base_frame;
  flags.plan.frame = frame;
  flags.map.topics.ros_namespace = listen.topics.ros_namespace;
  flags.map.map_frame = listen.intake.map_frame;
  flags.map.frame = frame;
}

}  // namespace plumescout::client
