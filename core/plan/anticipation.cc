// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/anticipation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>

#include "core/grid/padded.h"
#include "core/grid/ray.h"
#include "core/plan/cost/field_window.h"
#include "core/plan/selection/selection.h"
#include "core/traffic/traffic.h"

namespace plumescout {
namespace {

constexpr double kFullTrust_s = 10.0;
constexpr double kTrustFades_s = 20.0;
constexpr double kLeastTrust = 0.01;
constexpr double kLeastPeriod_s = 0.25;  // readings more frequent than that are put together

struct PromisedReading {
  Point2 place;
  double precision_per_ppm2 = 0.0;
};
using PromisedWay = std::vector<PromisedReading>;

// Whether the robot promises anything: of one that may have lost its place nothing is believed.
bool Drives(const RobotRecord& record, const Belief& belief) {
  return record.state.has_pose && !record.state.silent && !record.state.frame_suspect &&
         IsOnItsWay(record, belief.sample_time_ns);
}

double Trust(double ahead_s) {
  return std::exp(-std::max(0.0, ahead_s - kFullTrust_s) / kTrustFades_s);
}

// The readings of one robot from where it is now, in their order.
PromisedWay ReadingsOf(const RobotRecord& record, const Belief& belief,
                       const PlanningOptions& options) {
  const Trajectory& way = *record.live_trajectory;
  const double precision = belief.options->gas.observation_precision_per_ppm2;
  const double progress_s = Progress_s(record, belief.sample_time_ns);
  const double late_s = Lateness_s(record, belief.sample_time_ns);
  const double period_s = std::max(kLeastPeriod_s, 1.0 / options.reading_rate_hz);
  const double at_once = period_s * options.reading_rate_hz;
  PromisedWay readings;
  for (double ahead_s = period_s; progress_s + ahead_s <= way.duration_s; ahead_s += period_s) {
    const double trust = Trust(late_s + ahead_s);
    if (trust < kLeastTrust) break;
    readings.push_back({PoseAt(way, progress_s + ahead_s).position(), trust * at_once * precision});
  }
  return readings;
}

// A reading costs more the larger the field.
std::size_t MostPromised(const GridGeometry& geometry) {
  constexpr std::size_t kLarge_cells = 100'000;
  constexpr std::size_t kFewest = 8;
  const auto cells = static_cast<std::size_t>(geometry.width) * geometry.height;
  return std::max(kFewest, kMostPromised * kLarge_cells / std::max(kLarge_cells, cells));
}

void AddReadings(const PromisedWay& way, std::size_t together, const GridGeometry& geometry,
                 std::vector<ForeseenCell>& readings) {
  for (std::size_t first = 0; first < way.size(); first += together) {
    const std::size_t end = std::min(first + together, way.size());
    ForeseenCell reading{geometry.CellAt(way[first + (end - first) / 2].place), 0.0};
    for (std::size_t i = first; i < end; ++i) {
      reading.precision_per_ppm2 += way[i].precision_per_ppm2;
    }
    readings.push_back(reading);
  }
}

}  // namespace

std::vector<ForeseenCell> PromisedReadings(const Belief& belief, const RobotId& robot,
                                           const PlanningOptions& options) {
  std::vector<PromisedWay> ways;
  std::size_t count = 0;
  for (const auto& [id, record] : belief.robots) {
    if (id == robot || !Drives(record, belief)) continue;
    ways.push_back(ReadingsOf(record, belief, options));
    count += ways.back().size();
  }
  // Each way may end with fewer than the others.
  const std::size_t room = MostPromised(belief.geometry());
  const std::size_t most = room - std::min(room - 1, ways.size());
  const std::size_t together = std::max<std::size_t>(1, (count + most - 1) / most);
  std::vector<ForeseenCell> readings;
  for (const PromisedWay& way : ways) AddReadings(way, together, belief.geometry(), readings);
  readings.resize(std::min(readings.size(), room));
  return readings;
}

std::optional<Belief> Anticipate(const Belief& belief, const RobotId& robot,
                                 const PlanningOptions& options, const StopFn& stop) {
  if (belief.gas_what_if == nullptr) return std::nullopt;
  const FieldWindow window(belief.geometry(), belief.gas_what_if->geometry());
  std::vector<ForeseenCell> inside;
  for (const ForeseenCell& reading : PromisedReadings(belief, robot, options)) {
    const std::optional<Cell> cell = window.InField(reading.cell);
    if (cell) inside.push_back({*cell, reading.precision_per_ppm2});
  }
  if (inside.empty()) return std::nullopt;
  auto given = belief.gas_what_if->Given(inside, stop);
  if (!given.ok()) return std::nullopt;
  Belief ahead = belief;
  ahead.gas_what_if = *std::move(given);
  const Grid<float> then = ahead.gas_what_if->variance_ppm2(stop);
  if (Stops(stop)) return std::nullopt;
  auto variance = std::make_shared<Grid<float>>(*belief.gas_variance_ppm2);
  const CellRect cells = window.InMap(WholeRaster(then.geometry()));
  ByRows(cells.min.y, cells.end.y, cells.width(), stop, [&](int y) {
    float* const known = GridRow(*variance, y) + cells.min.x;
    const float* const less = GridRow(then, y - cells.min.y);
    for (int x = 0; x < cells.width(); ++x) {
      known[x] = less[x] < known[x] ? less[x] : known[x];  // NaN off free cells
    }
  });
  ahead.gas_variance_ppm2 = std::move(variance);
  return ahead;
}

PromisedSight::PromisedSight(const Belief& belief, const RobotId& robot, double range_m)
    : belief_(belief), range_m_(range_m) {
  constexpr double kLook_s = 0.5;
  for (const auto& [id, record] : belief.robots) {
    if (id == robot || !Drives(record, belief)) continue;
    const Trajectory& way = *record.live_trajectory;
    const double progress_s = Progress_s(record, belief.sample_time_ns);
    const double late_s = Lateness_s(record, belief.sample_time_ns);
    for (double ahead_s = 0.0; progress_s + ahead_s <= way.duration_s; ahead_s += kLook_s) {
      const double trust = Trust(late_s + ahead_s);
      if (trust < kLeastTrust) break;
      looks_.push_back({PoseAt(way, progress_s + ahead_s).position(), trust});
    }
  }
}

double PromisedSight::ShareOf(Point2 place) const {
  const auto is_clear = [this](Cell cell, double) {
    return belief_.occupancy->At(cell, CellState::kUnknown) != CellState::kOccupied;
  };
  double most = 0.0;
  for (const Look& look : looks_) {
    const double share = look.trust * (1.0 - Distance_m(look.from, place) / range_m_);
    const bool shows_more =
        share > most && WalkSegment(belief_.geometry(), look.from, place, is_clear);
    if (shows_more) most = share;
  }
  return most;
}

void LeavePromisedSight(const Belief& belief, Plan& plan) {
  const PromisedSight sight(belief, plan.robot);
  for (Candidate& candidate : plan.candidates) {
    if (!EndsAtTheUnseen(candidate)) continue;
    candidate.unseen_share *= 1.0 - sight.ShareOf(candidate.goal.centroid);
  }
}

}  // namespace plumescout
