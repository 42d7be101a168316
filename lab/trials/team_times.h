// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "lab/trials/row_figures.h"
#include "lab/trials/trial.h"

namespace plumescout::lab {

// When a run has reached a level, and whether it has.
struct ReachedAt {
  double time_s = 0.0;  // its end if it has not
  bool reached = false;
};

// The first time from which a metric that falls stays at `level` or below to the end; of one that
// rises, at `level` or above. REQUIRES: a curve that is not empty.
ReachedAt FallsTo(const std::vector<CurvePoint>& curve, MetricFn metric, double level);
ReachedAt RisesTo(const std::vector<CurvePoint>& curve, MetricFn metric, double level);

// The level at which a share of what the run lowers the metric by is done.
double LevelAtShare(const std::vector<CurvePoint>& curve, MetricFn metric, double share);

// exp of the mean of the logarithms; 1 without values. REQUIRES: values > 0.
double GeometricMean(const std::vector<double>& values);

}  // namespace plumescout::lab
