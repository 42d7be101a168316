// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "client/ros2/dds_node.h"
#include "core/types/map_snapshot.h"
#include "core/types/robot_frame.h"

namespace plumescout::client {

// Below the robot's namespace, unless they begin with a slash; an empty one is not published.
struct MapTopics {
  std::string ros_namespace = {};
  std::string map = "map";
  std::string gas_mean = "gas_mean";
  std::string gas_variance = "gas_variance";
  std::string gas = "gas_map";
  std::string frontiers = "frontiers";
};

struct MapPublisherOptions {
  MapTopics topics = {};
  std::string map_frame = "map";
  RobotFrame frame = {};       // of the robot in the mission
  double gas_scale_ppm = 0.0;  // what 100 is of the layer of means; 0: the largest mean
};

// Publishes maps of a mission, for people and for planners of the robot's own; latched.
class MapPublisher {
 public:
  // `node` must outlive it.
  static absl::StatusOr<std::unique_ptr<MapPublisher>> Advertise(
      DdsNode& node, const MapPublisherOptions& options);

  absl::Status Publish(const MapSnapshot& map, std::int64_t time_ns);

 private:
  MapPublisher(DdsNode& node, const MapPublisherOptions& options)
      : node_(node), options_(options) {}

  DdsNode& node_;
  const MapPublisherOptions options_;
  std::optional<int> map_;
  std::optional<int> gas_mean_;
  std::optional<int> gas_variance_;
  std::optional<int> gas_;
  std::optional<int> frontiers_;
};

}  // namespace plumescout::client
