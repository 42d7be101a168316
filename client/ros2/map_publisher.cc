// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/map_publisher.h"

#include "client/ros2/map_conversion.h"
#include "client/ros2/plan_conversion.h"
#include "core/types/status_macros.h"
#include "formats/ros/view_messages.h"

namespace plumescout::client {
namespace {

absl::StatusOr<std::optional<int>> AdvertiseLatched(DdsNode& node, const MapTopics& topics,
                                                    const std::string& topic,
                                                    const std::string& ros_type) {
  if (topic.empty()) return std::nullopt;
  PLUMESCOUT_ASSIGN_OR_RETURN(const int writer,
                              node.Advertise(FullTopic(topics.ros_namespace, topic), ros_type,
                                             {.delivery = Delivery::kLatched, .depth = 1}));
  return writer;
}

}  // namespace

absl::StatusOr<std::unique_ptr<MapPublisher>> MapPublisher::Advertise(
    DdsNode& node, const MapPublisherOptions& options) {
  std::unique_ptr<MapPublisher> publisher(new MapPublisher(node, options));
  const MapTopics& topics = options.topics;
  const auto advertise = [&](const std::string& topic, const char* type) {
    return AdvertiseLatched(node, topics, topic, type);
  };
  PLUMESCOUT_ASSIGN_OR_RETURN(publisher->map_, advertise(topics.map, ros::OccupancyGrid::kType));
  PLUMESCOUT_ASSIGN_OR_RETURN(publisher->gas_mean_,
                              advertise(topics.gas_mean, ros::OccupancyGrid::kType));
  PLUMESCOUT_ASSIGN_OR_RETURN(publisher->gas_variance_,
                              advertise(topics.gas_variance, ros::OccupancyGrid::kType));
  PLUMESCOUT_ASSIGN_OR_RETURN(publisher->gas_, advertise(topics.gas, ros::GridMap::kType));
  PLUMESCOUT_ASSIGN_OR_RETURN(publisher->frontiers_,
                              advertise(topics.frontiers, ros::MarkerArray::kType));
  return publisher;
}

absl::Status MapPublisher::Publish(const MapSnapshot& map, std::int64_t time_ns) {
  const ViewPoint view{{ros::ToTime(time_ns), options_.map_frame}, options_.frame};
  if (map_) PLUMESCOUT_RETURN_IF_ERROR(node_.Publish(*map_, ToOccupancyGrid(map.occupancy, view)));
  if (gas_mean_) {
    const float top = options_.gas_scale_ppm > 0.0 ? static_cast<float>(options_.gas_scale_ppm)
                                                   : TopOf(map.gas_mean_ppm);
    PLUMESCOUT_RETURN_IF_ERROR(
        node_.Publish(*gas_mean_, ToScaledGrid(map.gas_mean_ppm, top, view)));
  }
  if (gas_variance_) {
    PLUMESCOUT_RETURN_IF_ERROR(node_.Publish(
        *gas_variance_, ToScaledGrid(map.gas_variance_ppm2, TopOf(map.gas_variance_ppm2), view)));
  }
  if (gas_) PLUMESCOUT_RETURN_IF_ERROR(node_.Publish(*gas_, ToGridMap(map, view)));
  if (!frontiers_) return absl::OkStatus();
  return node_.Publish(*frontiers_, ToMarkers(map.frontiers, map.occupancy.geometry(), view));
}

}  // namespace plumescout::client
