// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/map_conversion.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "absl/strings/str_cat.h"
#include "client/ros2/transform.h"

namespace plumescout::client {
namespace {

constexpr std::int8_t kUnknownCell = -1;
constexpr float kFullScale = 100.0F;

std::int8_t ToPercent(CellState state) {
  if (state == CellState::kUnknown) return kUnknownCell;
  return state == CellState::kFree ? 0 : static_cast<std::int8_t>(kFullScale);
}

ros::OccupancyGrid EmptyGrid(const GridGeometry& geometry, const ViewPoint& view) {
  ros::OccupancyGrid grid;
  grid.header = view.header;
  grid.info.map_load_time = view.header.stamp;
  grid.info.resolution = static_cast<float>(geometry.resolution_m);
  grid.info.width = static_cast<std::uint32_t>(geometry.width);
  grid.info.height = static_cast<std::uint32_t>(geometry.height);
  grid.info.origin =
      FromPlanar(InRobot(view.frame, {geometry.origin_x_m, geometry.origin_y_m, 0.0}));
  grid.data.reserve(geometry.size());
  return grid;
}

// A grid map is a matrix, column by column, whose first row and column are those of the largest x
// and y.
ros::Float32MultiArray ToMatrix(const Grid<float>& layer) {
  const auto rows = static_cast<std::uint32_t>(layer.width());
  const auto columns = static_cast<std::uint32_t>(layer.height());
  ros::Float32MultiArray matrix;
  matrix.dim = {{"column_index", columns, rows * columns}, {"row_index", rows, rows}};
  matrix.data.assign(layer.values().rbegin(), layer.values().rend());
  return matrix;
}

}  // namespace

ros::OccupancyGrid ToOccupancyGrid(const Grid<CellState>& occupancy, const ViewPoint& view) {
  ros::OccupancyGrid grid = EmptyGrid(occupancy.geometry(), view);
  for (const CellState state : occupancy.values()) grid.data.push_back(ToPercent(state));
  return grid;
}

ros::OccupancyGrid ToScaledGrid(const Grid<float>& layer, float top, const ViewPoint& view) {
  ros::OccupancyGrid grid = EmptyGrid(layer.geometry(), view);
  for (const float value : layer.values()) {
    const float percent = std::clamp(value / top * kFullScale, 0.0F, kFullScale);
    grid.data.push_back(std::isnan(value) ? kUnknownCell
                                          : static_cast<std::int8_t>(std::lround(percent)));
  }
  return grid;
}

float TopOf(const Grid<float>& layer) {
  float top = 0.0F;
  for (const float value : layer.values()) {
    if (value > top) top = value;  // NaN is not
  }
  return top > 0.0F ? top : 1.0F;
}

ros::GridMap ToGridMap(const MapSnapshot& map, const ViewPoint& view) {
  const GridGeometry& geometry = map.gas_mean_ppm.geometry();
  ros::GridMap message;
  message.header = view.header;
  message.info.resolution = geometry.resolution_m;
  message.info.length_x = geometry.width * geometry.resolution_m;
  message.info.length_y = geometry.height * geometry.resolution_m;
  message.info.pose =
      FromPlanar(InRobot(view.frame, {geometry.origin_x_m + message.info.length_x / 2.0,
                                      geometry.origin_y_m + message.info.length_y / 2.0, 0.0}));
  const auto add = [&message](std::string name, const Grid<float>& layer) {
    message.layers.push_back(std::move(name));
    message.data.push_back(ToMatrix(layer));
  };
  add("gas_mean_ppm", map.gas_mean_ppm);
  add("gas_variance_ppm2", map.gas_variance_ppm2);
  for (const GasLayers& gas : map.further_gases) {
    add(absl::StrCat("gas_mean_ppm_", gas.species), gas.mean_ppm);
    add(absl::StrCat("gas_variance_ppm2_", gas.species), gas.variance_ppm2);
  }
  return message;
}

}  // namespace plumescout::client
