// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/selection/expected_information.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/grid/mask.h"
#include "core/plan/cost/field_window.h"
#include "core/plan/cost/relevance.h"

namespace plumescout {
namespace {

// A way and how far along it each vertex lies.
struct MeasuredWay {
  explicit MeasuredWay(const std::vector<Point2>& path) : vertices(path) {
    for (std::size_t i = 0; i < path.size(); ++i) {
      at_m.push_back(i == 0 ? 0.0 : at_m.back() + Distance_m(path[i - 1], path[i]));
    }
  }

  // REQUIRES: a vertex, 0 <= way_m <= at_m.back().
  Point2 PointAt(double way_m) const {
    const auto next = std::upper_bound(at_m.begin(), at_m.end(), way_m);
    if (next == at_m.end()) return vertices.back();
    const auto i = static_cast<std::size_t>(next - at_m.begin());  // >= 1: at_m begins with 0
    const double share = (way_m - at_m[i - 1]) / (at_m[i] - at_m[i - 1]);
    return {vertices[i - 1].x_m + share * (vertices[i].x_m - vertices[i - 1].x_m),
            vertices[i - 1].y_m + share * (vertices[i].y_m - vertices[i - 1].y_m)};
  }

  const std::vector<Point2>& vertices;
  std::vector<double> at_m;
};

}  // namespace

std::vector<Cell> ReadingCells(const std::vector<Point2>& path, const GridGeometry& geometry,
                               const PlanningOptions& options) {
  std::vector<Cell> cells;
  if (path.empty()) return cells;
  const MeasuredWay way(path);
  const double length_m = way.at_m.back();
  const double spacing_m = options.speed_mps / options.reading_rate_hz;
  const double standing =
      std::floor(options.dwell_s * options.reading_rate_hz) * static_cast<double>(path.size() - 1);
  const double driving = std::floor(length_m / spacing_m);
  // Thinned evenly, moving and standing alike.
  const double thinning = std::max(1.0, (driving + standing) / static_cast<double>(kMaxReadings));
  for (double k = 1.0; k * thinning <= driving; k += 1.0) {
    cells.push_back(geometry.CellAt(way.PointAt(k * thinning * spacing_m)));
  }
  for (double k = 1.0; k * thinning <= standing; k += 1.0) {
    const double vertex = std::ceil(k * thinning * static_cast<double>(path.size() - 1) / standing);
    cells.push_back(
        geometry.CellAt(path[std::min(static_cast<std::size_t>(vertex), path.size() - 1)]));
  }
  return cells;
}

ExpectedInformation::ExpectedInformation(const Belief& belief, const StopFn& stop)
    : belief_(belief) {
  if (belief.gas_what_if == nullptr) return;
  const GasWhatIf& field = *belief.gas_what_if;
  const CellRect free = BoundsOf(field.states(), CellState::kFree);
  const FieldWindow window(belief.geometry(), field.geometry());
  const std::vector<float> weights = Relevance(belief, window.InMap(free), stop);
  if (Stops(stop)) return;
  fall_ = field.FallOf(weights, free, stop);
}

void ExpectedInformation::FindBounds(const StopFn& stop) {
  if (fall_) fall_->FindBounds(stop);
}

std::optional<double> ExpectedInformation::Of(const std::vector<Cell>& readings,
                                              const StopFn& stop) {
  return Ask(&EntropyFall::Of, readings, stop);
}

std::optional<double> ExpectedInformation::AtMost(const std::vector<Cell>& readings,
                                                  const StopFn& stop) {
  return Ask(&EntropyFall::AtMost, readings, stop);
}

std::optional<double> ExpectedInformation::Ask(Measure measure, const std::vector<Cell>& readings,
                                               const StopFn& stop) {
  if (!fall_) return std::nullopt;
  const FieldWindow window(belief_.geometry(), belief_.gas_what_if->geometry());
  std::vector<Cell> inside;
  for (const Cell reading : readings) {
    if (const std::optional<Cell> cell = window.InField(reading)) inside.push_back(*cell);
  }
  const double precision = belief_.options->gas.observation_precision_per_ppm2;
  auto columns = belief_.gas_what_if->ColumnsIfRead(inside, precision, stop, std::move(used_));
  if (!columns.ok()) return std::nullopt;
  used_ = *std::move(columns);
  return used_ ? ((*fall_).*measure)(*used_, stop) : 0.0;
}

}  // namespace plumescout
