// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/types/options.h"
#include "lab/rivals/gas_mapper.h"
#include "lab/rivals/posterior.h"

namespace plumescout::lab {

// The Markov random field of [IPP] section II behind the interface that methods are compared by:
// exact, solved anew for every map. Readings do not age, and those in cells that are not free do
// not count in that map. One gas cell per cell of the map, whatever options.lattice_factor says.
class GmrfMapper final : public GasMapper {
 public:
  // REQUIRES: Validate(options).ok().
  explicit GmrfMapper(const GasOptions& options) : options_(options) {}

  absl::Status Add(Point2 position, const GasReading& reading) override;
  // Errors: those of PosteriorSolver::Solve. Cost: one factorisation and selected inversion.
  absl::StatusOr<MappedGas> MapOver(const Grid<CellState>& states) override;

 private:
  struct Reading {
    Point2 position;
    Evidence evidence;
  };

  GasOptions options_;
  std::vector<Reading> readings_;
  PosteriorSolver solver_;
};

}  // namespace plumescout::lab
