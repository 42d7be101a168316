// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "absl/status/statusor.h"

namespace plumescout {

// Cells of which the most rewarding are to be sampled within one cycle of the map, [LHR] (P2).
struct SubsetTourProblem {
  // M cells, 1 ... kMaxTourCells. Where there is no way a distance is infinite. Distances need not
  // obey the triangle inequality, nor be the same both ways.
  std::span<const double> from_start_m;  // M: from the robot, p_o, to each cell
  std::span<const double> between_m;     // M x M by rows: from the cell of the row to another
  std::span<const double> rewards;       // M: r_h, of either sign
  int wanted = 1;                        // T, 1 ... M

  double cycle_s = 0.0;     // t_up, > 0
  double sampling_s = 0.0;  // t_sam, standing at each cell, >= 0
  double speed_mps = 0.0;   // V, > 0
};

inline constexpr int kMaxTourCells = 16;  // 8 MB of table

struct SubsetTour {
  std::vector<int> order;    // cells in the order of visits; empty if none can be sampled
  double length_m = 0.0;     // H
  double reward = 0.0;       // sum over the cells
  int feasible_subsets = 0;  // those of as many cells that fit into the cycle
};

// The way through `wanted` cells with the greatest sum of rewards among those that fit into the
// cycle: H <= (t_up - T t_sam) V, with H the shortest open way from the robot through all cells of
// the subset that ends at the one farthest from the robot, [LHR] Eq. (3); of equally far ones, at
// that of least index. Sums are taken in the order of falling rewards, so that equal rewards make
// equal sums. Of equal sums the shorter way, then the lesser number with bit i set for cell i.
//
// If no subset of that size fits, the same for the greatest size of which one does (ours; of random
// sampling [LHR] IV-B says as much).
//
// Exact: one table of Held and Karp over all subsets prices every one of them, where the paper
// solves an integer program for each. Cost: O(2^M M^2) time, 2^M kMaxTourCells doubles.
// Errors: kInvalidArgument naming index and value of a distance that is NaN or negative or of a
// reward that is not finite; for M, T, sizes, times and speed out of range.
absl::StatusOr<SubsetTour> BestSubsetTour(const SubsetTourProblem& problem);

}  // namespace plumescout
