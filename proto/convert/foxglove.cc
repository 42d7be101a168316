// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/foxglove.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "google/protobuf/timestamp.pb.h"

namespace plumescout {
namespace {

constexpr char kFrame[] = "map";
constexpr double kLine_m = 0.05;
constexpr double kGoal_m = 0.2;
constexpr double kRangeStep_m = 1.0 / 128.0;  // a power of two: its multiples end in zeros
// Maps lie on the ground; what is drawn on them lies a little higher.
constexpr double kAbove_m = 0.02;

foxglove::Color MakeColor(double r, double g, double b, double a) {
  foxglove::Color color;
  color.set_r(r);
  color.set_g(g);
  color.set_b(b);
  color.set_a(a);
  return color;
}

void SetTime(std::int64_t time_ns, google::protobuf::Timestamp& timestamp) {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  timestamp.set_seconds(time_ns / kSecond_ns);
  timestamp.set_nanos(static_cast<std::int32_t>(time_ns % kSecond_ns));
}

// Time and frame, which most messages have.
template <typename Message>
Message MakeMessage(std::int64_t time_ns) {
  Message message;
  SetTime(time_ns, *message.mutable_timestamp());
  message.set_frame_id(kFrame);
  return message;
}

void SetPose(const Pose2& pose, double z_m, foxglove::Pose& out) {
  out.mutable_position()->set_x(pose.x_m);
  out.mutable_position()->set_y(pose.y_m);
  out.mutable_position()->set_z(z_m);
  out.mutable_orientation()->set_z(std::sin(0.5 * pose.yaw_rad));
  out.mutable_orientation()->set_w(std::cos(0.5 * pose.yaw_rad));
}

foxglove::Grid MakeGrid(const GridGeometry& geometry, absl::string_view field,
                        foxglove::PackedElementField::NumericType type, std::uint32_t cell_bytes,
                        std::int64_t time_ns) {
  auto grid = MakeMessage<foxglove::Grid>(time_ns);
  SetPose({geometry.origin_x_m, geometry.origin_y_m, 0.0}, 0.0, *grid.mutable_pose());
  grid.set_column_count(static_cast<std::uint32_t>(geometry.width));
  grid.mutable_cell_size()->set_x(geometry.resolution_m);
  grid.mutable_cell_size()->set_y(geometry.resolution_m);
  grid.set_row_stride(cell_bytes * static_cast<std::uint32_t>(geometry.width));
  grid.set_cell_stride(cell_bytes);
  foxglove::PackedElementField& packed = *grid.add_fields();
  packed.set_name(std::string(field));
  packed.set_type(type);
  return grid;
}

// What values are rounded to multiples of: a power of two, at most 0.2 % of the largest magnitude.
float StepFor(const Grid<float>& values) {
  constexpr int kBits = 9;
  float largest = 0.0F;
  for (const float value : values.values()) {
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  }
  if (largest == 0.0F) return 1.0F;
  return std::max(std::numeric_limits<float>::min(), std::ldexp(1.0F, std::ilogb(largest) - kBits));
}

void AddSphere(Point2 place, double size_m, const foxglove::Color& color,
               foxglove::SceneEntity& entity) {
  foxglove::SpherePrimitive& sphere = *entity.add_spheres();
  SetPose({place.x_m, place.y_m, 0.0}, kAbove_m, *sphere.mutable_pose());
  sphere.mutable_size()->set_x(size_m);
  sphere.mutable_size()->set_y(size_m);
  sphere.mutable_size()->set_z(size_m);
  *sphere.mutable_color() = color;
}

}  // namespace

foxglove::PoseInFrame FoxglovePose(const Pose2& pose, std::int64_t time_ns) {
  auto message = MakeMessage<foxglove::PoseInFrame>(time_ns);
  SetPose(pose, 0.0, *message.mutable_pose());
  return message;
}

foxglove::LaserScan FoxgloveScan(const Scan& scan, const Pose2& pose, std::int64_t time_ns) {
  auto message = MakeMessage<foxglove::LaserScan>(time_ns);
  SetPose(pose, 0.0, *message.mutable_pose());
  const auto steps = static_cast<double>(scan.ranges_m.empty() ? 0 : scan.ranges_m.size() - 1);
  message.set_start_angle(scan.start_angle_rad);
  message.set_end_angle(scan.start_angle_rad + steps * scan.angle_step_rad);
  message.mutable_ranges()->Reserve(static_cast<int>(scan.ranges_m.size()));
  for (const float range_m : scan.ranges_m) {
    message.add_ranges(std::nearbyint(range_m / kRangeStep_m) * kRangeStep_m);
  }
  return message;
}

foxglove::Grid FoxgloveGrid(const Grid<CellState>& occupancy, std::int64_t time_ns) {
  foxglove::Grid grid =
      MakeGrid(occupancy.geometry(), "occupancy", foxglove::PackedElementField::INT8, 1, time_ns);
  std::string& data = *grid.mutable_data();
  data.reserve(occupancy.size());
  for (const CellState state : occupancy.values()) {
    const int value = state == CellState::kOccupied ? 100 : state == CellState::kFree ? 0 : -1;
    data.push_back(static_cast<char>(value));
  }
  return grid;
}

foxglove::Grid FoxgloveGrid(const Grid<float>& values, absl::string_view name,
                            std::int64_t time_ns) {
  foxglove::Grid grid = MakeGrid(values.geometry(), name, foxglove::PackedElementField::FLOAT32,
                                 sizeof(float), time_ns);
  std::string& data = *grid.mutable_data();
  data.resize(values.size() * sizeof(float));
  const float step = StepFor(values);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const float rounded = std::nearbyint(values[i] / step) * step;
    std::memcpy(data.data() + i * sizeof(float), &rounded, sizeof(float));
  }
  return grid;
}

foxglove::SceneUpdate FoxgloveWay(absl::string_view id, const Trajectory& trajectory,
                                  std::int64_t time_ns) {
  foxglove::SceneUpdate update;
  auto& entity = *update.add_entities() = MakeMessage<foxglove::SceneEntity>(time_ns);
  entity.set_id(std::string(id));
  foxglove::LinePrimitive& line = *entity.add_lines();
  SetPose({}, 0.0, *line.mutable_pose());
  line.set_thickness(kLine_m);
  *line.mutable_color() = MakeColor(0.1, 0.7, 0.2, 1.0);
  for (const Waypoint& waypoint : trajectory.waypoints) {
    foxglove::Point3& point = *line.add_points();
    point.set_x(waypoint.pose.x_m);
    point.set_y(waypoint.pose.y_m);
    point.set_z(kAbove_m);
  }
  if (!trajectory.waypoints.empty()) {
    AddSphere(trajectory.waypoints.back().pose.position(), kGoal_m, line.color(), entity);
  }
  return update;
}

foxglove::SceneUpdate FoxgloveGone(absl::string_view id, std::int64_t time_ns) {
  foxglove::SceneUpdate update;
  foxglove::SceneEntityDeletion& deletion = *update.add_deletions();
  SetTime(time_ns, *deletion.mutable_timestamp());
  deletion.set_type(foxglove::SceneEntityDeletion::MATCHING_ID);
  deletion.set_id(std::string(id));
  return update;
}

foxglove::SceneUpdate FoxgloveFrontiers(const std::vector<Frontier>& frontiers,
                                        const GridGeometry& geometry, std::int64_t time_ns) {
  std::size_t cell_count = 0;
  for (const Frontier& frontier : frontiers) cell_count += frontier.cells.size();
  const std::size_t stride = 1 + cell_count / (kMostFrontierMarks + 1);
  std::size_t place = 0;  // among all cells
  foxglove::SceneUpdate update;
  for (const FrontierKind kind : {FrontierKind::kOccupancy, FrontierKind::kGas}) {
    const bool is_gas = kind == FrontierKind::kGas;
    auto& entity = *update.add_entities() = MakeMessage<foxglove::SceneEntity>(time_ns);
    entity.set_id(is_gas ? "frontiers/gas" : "frontiers/occupancy");
    for (const Frontier& frontier : frontiers) {
      if (frontier.kind != kind) continue;
      const double opacity = frontier.reachable && !frontier.too_small ? 1.0 : 0.3;
      const foxglove::Color color =
          is_gas ? MakeColor(0.9, 0.4, 0.1, opacity) : MakeColor(0.1, 0.4, 0.9, opacity);
      for (const Cell cell : frontier.cells) {
        if (place++ % stride != 0) continue;
        AddSphere(geometry.Center(cell), geometry.resolution_m, color, entity);
      }
    }
  }
  return update;
}

foxglove::Log FoxgloveLog(foxglove::Log::Level level, absl::string_view name,
                          absl::string_view message, std::int64_t time_ns) {
  foxglove::Log log;
  SetTime(time_ns, *log.mutable_timestamp());
  log.set_level(level);
  log.set_name(std::string(name));
  log.set_message(std::string(message));
  return log;
}

}  // namespace plumescout
