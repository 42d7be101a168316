// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/flow_pictures.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "lab/report/palette.h"

namespace plumescout::lab {
namespace {

constexpr Stroke kStreamLine{{255, 255, 255}, 1.0};

// Corner of a cell and the value there.
struct Corner {
  Point2 at;
  double value;
};

// Where the contour of `level` crosses the sides of the square of corners, which go round it: none,
// two or four points.
std::vector<Point2> Crossings(const std::array<Corner, 4>& corners, double level) {
  std::vector<Point2> crossings;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Corner& a = corners[i];
    const Corner& b = corners[(i + 1) % corners.size()];
    if ((a.value < level) == (b.value < level)) continue;
    const double share = (level - a.value) / (b.value - a.value);
    crossings.push_back(
        {a.at.x_m + share * (b.at.x_m - a.at.x_m), a.at.y_m + share * (b.at.y_m - a.at.y_m)});
  }
  return crossings;
}

// Marching squares.
void AddStreamLines(const MacField& velocity, const FlowPicture& picture, MapPanel& panel) {
  const GridGeometry& geometry = velocity.geometry();
  const std::vector<double> stream = StreamFunction(velocity);
  const auto corner = [&](int x, int y) {
    const Point2 center = geometry.Center({x, y});
    const double half_m = 0.5 * geometry.resolution_m;
    return Corner{{center.x_m - half_m, center.y_m - half_m}, stream[velocity.UFace(x, y)]};
  };
  for (std::size_t i = 0; i < geometry.size(); ++i) {
    const auto [x, y] = geometry.CellAtIndex(i);
    if (!picture.region.Surrounds(geometry.Center({x, y}))) continue;
    const std::array<Corner, 4> corners = {corner(x, y), corner(x + 1, y), corner(x + 1, y + 1),
                                           corner(x, y + 1)};
    for (const double level : picture.stream_values) {
      const std::vector<Point2> crossings = Crossings(corners, level);
      for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
        panel.lines.push_back({{crossings[k], crossings[k + 1]}, kStreamLine});
      }
    }
  }
}

}  // namespace

std::vector<double> StreamFunction(const MacField& velocity) {
  const auto [width, height] = std::pair(velocity.geometry().width, velocity.geometry().height);
  const double cell_m = velocity.geometry().resolution_m;
  std::vector<double> stream(velocity.UFace(0, height + 1));  // corners have the faces' numbering
  for (int x = 0; x < width; ++x) {
    stream[velocity.UFace(x + 1, 0)] = stream[velocity.UFace(x, 0)] - velocity.v(x, 0) * cell_m;
  }
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x <= width; ++x) {
      stream[velocity.UFace(x, y + 1)] = stream[velocity.UFace(x, y)] + velocity.u(x, y) * cell_m;
    }
  }
  return stream;
}

MapPanel DrawFlow(const FlowDomain& domain, const MacField& velocity, const FlowPicture& picture) {
  const ColorScale scale{ColorMap::kGas, 0.0, picture.fastest_mps, false};
  MapPanel panel;
  panel.title = picture.title;
  panel.region = picture.region;
  panel.cells = PaintCells(domain.fluid.geometry(), panel.region, [&](Cell cell) {
    if (domain.fluid.At(cell, 0) == 0) return kWallColor;
    const Velocity air = velocity.AtCenter(cell);
    return scale(std::hypot(air.u_mps, air.v_mps));
  });
  AddStreamLines(velocity, picture, panel);
  panel.color_bar = ColorBar{scale, "speed"};
  return panel;
}

}  // namespace plumescout::lab
