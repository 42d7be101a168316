// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <cstdlib>
#include <vector>

#include "core/types/cell_state.h"
#include "core/types/grid.h"
#include "core/types/options.h"
#include "core/types/rng.h"

namespace plumescout::testing {

// A reading as the model sees it: cell, precision, concentration.
struct DenseReading {
  Cell cell;
  double precision = 10.0;
  double concentration_ppm = 0.0;
};

// The field of [IPP] Eq. (1)-(6) written out: the rows of J with their precision and target, and
// dense algebra. Shares no code with the library.
class DenseField {
 public:
  DenseField(const Grid<CellState>& states, const std::vector<DenseReading>& readings,
             const GasOptions& options) {
    for (std::size_t i = 0; i < states.size(); ++i) {
      if (states[i] == CellState::kFree) cells_.push_back(states.geometry().CellAtIndex(i));
    }
    AddPriorRows(options.prior_precision_per_ppm2);
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      AddRow(options.background_precision_per_ppm2, options.background_mean_ppm)(Index(i)) = 1.0;
    }
    for (const DenseReading& reading : readings) {
      for (std::size_t i = 0; i < cells_.size(); ++i) {
        if (cells_[i] != reading.cell) continue;
        AddRow(reading.precision, reading.concentration_ppm)(Index(i)) = 1.0;
      }
    }
    Solve();
  }

  const std::vector<Cell>& cells() const { return cells_; }  // in the order of the vectors
  const Eigen::MatrixXd& hessian() const { return hessian_; }
  const Eigen::VectorXd& information() const { return information_; }  // J^T Lambda y
  const Eigen::VectorXd& mean_ppm() const { return mean_ppm_; }
  const Eigen::VectorXd& variance_ppm2() const { return variance_ppm2_; }

 private:
  static Eigen::Index Index(std::size_t i) { return static_cast<Eigen::Index>(i); }

  Eigen::VectorXd& AddRow(double precision, double target) {
    precisions_.push_back(precision);
    targets_.push_back(target);
    rows_.push_back(Eigen::VectorXd::Zero(Index(cells_.size())));
    return rows_.back();
  }

  void AddPriorRows(double precision) {
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      for (std::size_t j = i + 1; j < cells_.size(); ++j) {
        const int distance =
            std::abs(cells_[i].x - cells_[j].x) + std::abs(cells_[i].y - cells_[j].y);
        if (distance != 1) continue;
        Eigen::VectorXd& row = AddRow(precision, 0.0);
        row(Index(i)) = 1.0;
        row(Index(j)) = -1.0;
      }
    }
  }

  void Solve() {
    Eigen::MatrixXd j(Index(rows_.size()), Index(cells_.size()));
    for (std::size_t k = 0; k < rows_.size(); ++k) j.row(Index(k)) = rows_[k].transpose();
    const auto lambda = Eigen::Map<const Eigen::VectorXd>(precisions_.data(), j.rows());
    const auto y = Eigen::Map<const Eigen::VectorXd>(targets_.data(), j.rows());
    hessian_ = j.transpose() * lambda.asDiagonal() * j;
    information_ = j.transpose() * lambda.asDiagonal() * y;
    const Eigen::MatrixXd inverse = hessian_.inverse();
    mean_ppm_ = inverse * information_;
    variance_ppm2_ = inverse.diagonal();
  }

  std::vector<Cell> cells_;
  std::vector<double> precisions_;
  std::vector<double> targets_;
  std::vector<Eigen::VectorXd> rows_;
  Eigen::MatrixXd hessian_;
  Eigen::VectorXd information_;
  Eigen::VectorXd mean_ppm_;
  Eigen::VectorXd variance_ppm2_;
};

// Free cells with random obstacles and unknown cells: walls, pockets, disconnected components.
inline Grid<CellState> RandomStates(int width, int height, double blocked_share, Rng& rng) {
  GridGeometry geometry;
  geometry.width = width;
  geometry.height = height;
  Grid<CellState> states(geometry, CellState::kFree);
  for (CellState& state : states.values()) {
    const double draw = rng.Uniform01();
    if (draw < blocked_share) {
      state = draw < 0.5 * blocked_share ? CellState::kUnknown : CellState::kOccupied;
    }
  }
  return states;
}

inline std::vector<DenseReading> RandomReadings(const Grid<CellState>& states, int count,
                                                Rng& rng) {
  std::vector<DenseReading> readings;
  while (static_cast<int>(readings.size()) < count) {
    const Cell cell = states.geometry().CellAtIndex(rng.Below(states.size()));
    if (states[cell] != CellState::kFree) continue;
    readings.push_back({cell, rng.Uniform(0.5, 20.0), rng.Uniform(0.0, 50.0)});
  }
  return readings;
}

}  // namespace plumescout::testing
