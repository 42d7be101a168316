// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/belief/belief.h"
#include "lab/formats/scene.h"

namespace plumescout::lab {

// What a mission says at its end, beside the truth: the mean over time.
struct ObjectiveTruth {
  // Of the cells that are decided (see JudgeCells) the share for which what is said is so.
  double right_share = 0.0;
  double decided_cells = 0.0;
  // Whether the statement as a whole is so: of clean air that no cell that robots can reach is
  // above the threshold, and of unclean air that the place told is; of a map above the threshold
  // that the share above is no less than the confidence; of the strongest place that the true one
  // among the cells that robots can reach is within radius_m, and without a source that none is
  // above the threshold. False for what is neither met nor refuted.
  bool is_right = false;
  double greatest_ppm = 0.0;  // of the cells that robots can reach
};

// REQUIRES: the belief's mission has an objective other than a complete map, and a robot.
ObjectiveTruth CompareWithTruth(const Belief& belief, const Scene& truth);

}  // namespace plumescout::lab
