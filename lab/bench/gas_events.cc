// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/gas_events.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/types/options.h"
#include "lab/bench/gas_case.h"

namespace plumescout::lab {
namespace {

constexpr int kFlipsPerRobot = 40;
constexpr std::int64_t kReach_cells = 30;
constexpr std::size_t kFlippedAtOnce = 200;

std::int64_t Offset(Rng& rng) {
  return static_cast<std::int64_t>(rng.Below(2 * kReach_cells + 1)) - kReach_cells;
}

}  // namespace

std::size_t GasEvents::ActiveCell() {
  std::size_t cell = 0;
  do {
    cell = rng_.Below(cells_.size());
  } while (!cells_[cell].active);
  return cell;
}

GasEvents::Robot GasEvents::NewRobot() {
  const std::size_t cell = ActiveCell();
  return {static_cast<double>(cell % width_), static_cast<double>(cell / width_),
          rng_.Uniform(0.0, 2.0 * std::numbers::pi)};
}

bool GasEvents::IsFree(const Robot& at) const {
  const auto height = static_cast<double>(cells_.size() / width_);
  const bool inside = at.x_cells >= 0.0 && at.x_cells < static_cast<double>(width_) &&
                      at.y_cells >= 0.0 && at.y_cells < height;
  return inside && cells_[CellOf(at)].active;
}

std::size_t GasEvents::CellOf(const Robot& robot) const {
  return static_cast<std::size_t>(robot.y_cells) * width_ + static_cast<std::size_t>(robot.x_cells);
}

// Whether the way to the next reading is free: then the robot goes there.
bool GasEvents::Advance(Robot& robot) const {
  constexpr int kCellsPerReading = 5;  // 1 m/s, 2 Hz
  Robot ahead = robot;
  for (int step = 0; step < kCellsPerReading; ++step) {
    ahead.x_cells += std::cos(ahead.heading_rad);
    ahead.y_cells += std::sin(ahead.heading_rad);
    if (!IsFree(ahead)) return false;
  }
  robot = ahead;
  return true;
}

std::vector<CellChange> GasEvents::Reading(int robots) {
  constexpr int kTurns = 20;  // then it is shut in, and another goes on elsewhere
  constexpr double kNoise_ppm = 0.5;
  while (robots_.size() < static_cast<std::size_t>(robots)) robots_.push_back(NewRobot());
  Robot robot = robots_.front();
  robots_.pop_front();
  for (int turn = 0; !Advance(robot); ++turn) {
    if (turn == kTurns) {
      robot = NewRobot();
      break;
    }
    robot.heading_rad += rng_.Uniform(0.5, 1.5);
  }
  robots_.push_back(robot);
  const auto width = static_cast<double>(width_);
  const auto height = static_cast<double>(cells_.size() / width_);
  const double plume_ppm = Plume_ppm(width, height, robot.x_cells, robot.y_cells);
  return ReadAt(CellOf(robot), plume_ppm + kNoise_ppm * rng_.Gaussian());
}

std::vector<CellChange> GasEvents::ReadingAnywhere() {
  constexpr double kPeak_ppm = 50.0;
  const std::size_t cell = ActiveCell();
  return ReadAt(cell, rng_.Uniform(0.0, kPeak_ppm));
}

std::vector<CellChange> GasEvents::ReadAt(std::size_t cell, double deviation_ppm) {
  const double precision = GasOptions().observation_precision_per_ppm2;
  cells_[cell].precision += precision;
  cells_[cell].weighted_deviation += precision * deviation_ppm;
  return {{cell, cells_[cell]}};
}

std::vector<CellChange> GasEvents::Scan(int robots) {
  const auto width = static_cast<std::int64_t>(width_);
  const std::int64_t height = static_cast<std::int64_t>(cells_.size()) / width;
  std::vector<CellChange> changes;
  for (int robot = 0; robot < robots; ++robot) {
    const auto at = static_cast<std::int64_t>(ActiveCell());
    for (int flips = 0; flips < kFlipsPerRobot;) {
      if (flips % 2 == 1 && flipped_.size() > kFlippedAtOnce) {
        changes.push_back(Flip(flipped_.front()));
        flipped_.pop_front();
        ++flips;
        continue;
      }
      const std::int64_t x = at % width + Offset(rng_);
      const std::int64_t y = at / width + Offset(rng_);
      if (x < 0 || y < 0 || x >= width || y >= height) continue;
      flipped_.push_back(static_cast<std::size_t>(y * width + x));
      changes.push_back(Flip(flipped_.back()));
      ++flips;
    }
  }
  return changes;
}

CellChange GasEvents::Flip(std::size_t cell) {
  cells_[cell].active = !cells_[cell].active;
  return {cell, cells_[cell]};
}

FieldEngine GasEvents::Fresh(const FieldTolerance& tolerance) const {
  const GasOptions gas;
  FieldOptions options;
  options.prior = {gas.prior_precision_per_ppm2, gas.background_precision_per_ppm2};
  options.tolerance = tolerance;
  return FieldEngine(width_, cells_.size() / width_, cells_, options);
}

FieldDeviation GasEvents::ErrorOf(const FieldEngine& field) const {
  const FieldEngine fresh = Fresh();
  std::vector<double> deviation_ppm, variance_ppm2;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (!cells_[i].active) continue;
    deviation_ppm.push_back(fresh.mean_ppm(i));
    variance_ppm2.push_back(fresh.variance_ppm2(i));
  }
  return ErrorOf(field, deviation_ppm, variance_ppm2);
}

Information GasEvents::AsMatrix() const {
  const auto width = static_cast<int>(width_);
  GridGeometry geometry;
  geometry.width = width;
  geometry.height = static_cast<int>(cells_.size()) / width;
  Grid<CellState> states(geometry, CellState::kOccupied);
  std::vector<Evidence> evidence;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (!cells_[i].active) continue;
    states[i] = CellState::kFree;
    evidence.push_back({cells_[i].precision, cells_[i].weighted_deviation});
  }
  return BuildInformation(GmrfGraph(states), evidence, {});
}

FieldDeviation GasEvents::ErrorOf(const FieldEngine& field, std::span<const double> deviation_ppm,
                              std::span<const double> variance_ppm2) const {
  FieldDeviation error;
  std::size_t variable = 0;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (!cells_[i].active) continue;
    const double ratio = field.variance_ppm2(i) / variance_ppm2[variable];
    const double mean_error_ppm = std::abs(field.mean_ppm(i) - deviation_ppm[variable++]);
    error.mean_ppm = std::max(error.mean_ppm, mean_error_ppm);
    error.variance_ratio = std::max(error.variance_ratio, std::abs(ratio - 1.0));
  }
  return error;
}

}  // namespace plumescout::lab
