// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/ros/messages.h"

// The messages of ROS 2 in which robots are told where to go, and people are shown maps: fields as
// in formats/ros/messages.h.
namespace plumescout::ros {

struct TwistStamped {
  static constexpr char kType[] = "geometry_msgs/msg/TwistStamped";
  Header header = {};
  Twist twist = {};
  static void Visit(auto& archive, auto& m) { archive(m.header, m.twist); }
};

struct PoseStamped {
  static constexpr char kType[] = "geometry_msgs/msg/PoseStamped";
  Header header = {};
  Pose pose = {};
  static void Visit(auto& archive, auto& m) { archive(m.header, m.pose); }
};

struct Path {
  static constexpr char kType[] = "nav_msgs/msg/Path";
  Header header = {};
  std::vector<PoseStamped> poses = {};
  static void Visit(auto& archive, auto& m) { archive(m.header, m.poses); }
};

struct MapMetaData {
  Time map_load_time = {};
  float resolution = 0.0F;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  Pose origin = {};  // of the lower left corner
  static void Visit(auto& archive, auto& m) {
    archive(m.map_load_time, m.resolution, m.width, m.height, m.origin);
  }
};

struct OccupancyGrid {
  static constexpr char kType[] = "nav_msgs/msg/OccupancyGrid";
  Header header = {};
  MapMetaData info = {};
  std::vector<std::int8_t> data = {};  // row by row from the lower left; 0 to 100, -1: unknown
  static void Visit(auto& archive, auto& m) { archive(m.header, m.info, m.data); }
};

struct MultiArrayDimension {
  std::string label = {};
  std::uint32_t size = 0;
  std::uint32_t stride = 0;
  static void Visit(auto& archive, auto& m) { archive(m.label, m.size, m.stride); }
};

struct Float32MultiArray {
  std::vector<MultiArrayDimension> dim = {};
  std::uint32_t data_offset = 0;
  std::vector<float> data = {};
  static void Visit(auto& archive, auto& m) { archive(m.dim, m.data_offset, m.data); }
};

struct GridMapInfo {
  double resolution = 0.0;
  double length_x = 0.0;
  double length_y = 0.0;
  Pose pose = {};  // of the centre
  static void Visit(auto& archive, auto& m) {
    archive(m.resolution, m.length_x, m.length_y, m.pose);
  }
};

struct GridMap {
  static constexpr char kType[] = "grid_map_msgs/msg/GridMap";
  Header header = {};
  GridMapInfo info = {};
  std::vector<std::string> layers = {};
  std::vector<std::string> basic_layers = {};
  std::vector<Float32MultiArray> data = {};  // one for each layer
  std::uint16_t outer_start_index = 0;
  std::uint16_t inner_start_index = 0;
  static void Visit(auto& archive, auto& m) {
    archive(m.header, m.info, m.layers, m.basic_layers, m.data, m.outer_start_index,
            m.inner_start_index);
  }
};

struct Color {
  float r = 0.0F;
  float g = 0.0F;
  float b = 0.0F;
  float a = 1.0F;
  static void Visit(auto& archive, auto& m) { archive(m.r, m.g, m.b, m.a); }
};

struct Marker {
  static constexpr std::int32_t kSphere = 2;
  static constexpr std::int32_t kPoints = 8;
  static constexpr std::int32_t kDeleteAll = 3;
  Header header = {};
  std::string ns = {};
  std::int32_t id = 0;
  std::int32_t type = 0;
  std::int32_t action = 0;
  Pose pose = {};
  Vector3 scale = {};
  Color color = {};
  Time lifetime = {};  // a duration; 0: for ever
  bool frame_locked = false;
  std::vector<Vector3> points = {};
  std::vector<Color> colors = {};
  // Of markers with pictures, texts and meshes, which ours are not.
  std::string texture_resource = {};
  Header texture_header = {};
  std::string texture_format = {};
  std::vector<std::uint8_t> texture_data = {};
  std::vector<double> uv_coordinates = {};
  std::string text = {};
  std::string mesh_resource = {};
  std::string mesh_filename = {};
  std::vector<std::uint8_t> mesh_data = {};
  bool mesh_use_embedded_materials = false;
  static void Visit(auto& archive, auto& m) {
    archive(m.header, m.ns, m.id, m.type, m.action, m.pose, m.scale, m.color, m.lifetime,
            m.frame_locked, m.points, m.colors, m.texture_resource, m.texture_header,
            m.texture_format, m.texture_data, m.uv_coordinates, m.text, m.mesh_resource,
            m.mesh_filename, m.mesh_data, m.mesh_use_embedded_materials);
  }
};

struct MarkerArray {
  static constexpr char kType[] = "visualization_msgs/msg/MarkerArray";
  std::vector<Marker> markers = {};
  static void Visit(auto& archive, auto& m) { archive(m.markers); }
};

}  // namespace plumescout::ros
