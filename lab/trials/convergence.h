// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lab/sim/field_error.h"

namespace plumescout::lab {

// How soon maps become good. Curves are ascending in time; between two points a map is as it was at
// the earlier one.

// RMSE convergence time of [LHR] Table II, "the time of RMSE convergence to its steady state
// value": the first time from which on the error stays within this share of its final value. None
// if there are no points, or the last is not finite. The paper names no share, but its numbers
// leave room for a small one alone: 95.33 min for the sweep are 2600 m at 5 m/s and 2600 samples of
// 2 s, 202.72 min for random sampling are 34,807 m and 2601 samples: both the whole mission.
inline constexpr double kSteadyShare = 0.002;
std::optional<double> ConvergenceTime_s(const ErrorCurve& errors,
                                        double steady_share = kSteadyShare);

// When the error first is below the limit, as T_r of [IPP] Table I counts; none if it never is.
std::optional<double> TimeBelow_s(const ErrorCurve& errors, double limit_ppm);

// The last point; the first of the points with the least error. None if there are no points.
std::optional<ErrorPoint> FinalError(const ErrorCurve& errors);
std::optional<ErrorPoint> LeastError(const ErrorCurve& errors);

// Times 0, step, 2 step ... up to the last that is not beyond `end_s`. REQUIRES: step_s > 0.
std::vector<double> EvenTimes_s(double end_s, double step_s);

// The curve at these times, ascending: what the map was then. Before the first point it counts as
// that point. REQUIRES: errors not empty.
ErrorCurve Resampled(const ErrorCurve& errors, std::span<const double> times_s);

// The mean of the curves at these times. Runs that ended early count on with their last map.
// REQUIRES: no curve is empty; at least one curve.
ErrorCurve MeanCurve(std::span<const ErrorCurve> curves, std::span<const double> times_s);

}  // namespace plumescout::lab
