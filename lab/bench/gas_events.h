// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "core/gas/field/field_engine.h"
#include "core/gas/information.h"
#include "core/types/rng.h"

namespace plumescout::lab {

// Readings and scans as missions have them, and the field that they should lead to.
class GasEvents {
 public:
  // `cells`: the inputs to begin with, row by row of a map that is `width` cells wide.
  GasEvents(std::size_t width, std::vector<CellInput> cells, std::uint64_t seed)
      : width_(width), cells_(std::move(cells)), rng_(seed) {}

  std::size_t ActiveCell();
  // The next reading of `robots` that take turns, half a metre on in the way of each; they go
  // straight on and turn where that is blocked. It reads the plume of the map.
  std::vector<CellChange> Reading(int robots);
  // The worst that can be asked: of a random active cell, any value.
  std::vector<CellChange> ReadingAnywhere();
  // What all robots' scans of one moment change: 40 cells within 3 m of each become free or cease
  // to be. Every other one is a cell that changed long ago and changes back.
  std::vector<CellChange> Scan(int robots);

  const std::vector<CellInput>& cells() const { return cells_; }
  // All from scratch.
  FieldEngine Fresh(const FieldTolerance& tolerance = {}) const;
  // Worst difference of `field` from that; on the variance as share.
  FieldDeviation ErrorOf(const FieldEngine& field) const;
  // The same field as matrices, for other solvers, with its cells' variables in their order.
  Information AsMatrix() const;
  // Worst difference of `field` from what such a solver made of that.
  FieldDeviation ErrorOf(const FieldEngine& field, std::span<const double> deviation_ppm,
                     std::span<const double> variance_ppm2) const;

 private:
  struct Robot {
    double x_cells = 0.0;
    double y_cells = 0.0;
    double heading_rad = 0.0;
  };

  Robot NewRobot();
  bool IsFree(const Robot& at) const;
  bool Advance(Robot& robot) const;
  std::size_t CellOf(const Robot& robot) const;
  std::vector<CellChange> ReadAt(std::size_t cell, double deviation_ppm);
  CellChange Flip(std::size_t cell);

  std::size_t width_;
  std::vector<CellInput> cells_;
  Rng rng_;
  std::deque<Robot> robots_;         // the next to read first
  std::deque<std::size_t> flipped_;  // the oldest first
};

}  // namespace plumescout::lab
