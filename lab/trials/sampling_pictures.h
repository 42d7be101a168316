// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "lab/formats/csv.h"
#include "lab/report/chart.h"
#include "lab/report/map_panel.h"
#include "lab/trials/sampling_study.h"

namespace plumescout::lab {

// How studies of robots that stop and sample are shown.

// Time-averaged gas, buildings and sources.
MapPanel TruthPanel(const Scene& scene);

// One drive anew: the estimated gas after the named updates of its map (1: after the first plan,
// ascending), on the scale of the truth, with the sites sampled so far, the way there, and the
// sites of the last plan. Updates that the drive does not come to are left out.
absl::StatusOr<std::vector<MapPanel>> PictureUpdates(const SamplingPlan& plan, std::size_t row,
                                                     std::size_t number,
                                                     const std::vector<int>& updates);

// One drive anew: for each of the times, ascending, the first map after it, or the last if the
// drive ended before: the estimated gas on the scale of the truth, and its variance.
struct TimePictures {
  std::vector<MapPanel> means;
  std::vector<MapPanel> variances;
};
absl::StatusOr<TimePictures> PictureTimes(const SamplingPlan& plan, std::size_t row,
                                          std::size_t number, const std::vector<double>& times_s);

// The gas of that moment, on the scale of the truth.
MapPanel MomentPanel(const Scene& scene, double time_s);

// As [IPP] Fig. 2: the gas of a moment, the starts of all cases in the world of case `number`, and
// the way of one drive anew.
absl::StatusOr<MapPanel> StagePanel(const SamplingPlan& plan, std::size_t row, std::size_t number,
                                    double time_s);

// The error over time, a chart for each row beside the reference: means over worlds (of the means
// over the drives in a world) with their 95 % intervals, and a dot where the median of the drives
// that come there samples the cell of a source. Drives that ended early keep their last value.
// All charts have the same range, colours and legend. REQUIRES: all rows have a drive of each case.
struct NamedDrives {
  std::string name;
  std::vector<SamplingDrive> drives;
};
std::vector<Chart> MakeErrorCharts(const SamplingPlan& plan, const NamedDrives& reference,
                                   const std::vector<NamedDrives>& rows);

// Every drive: row and case as labels, then seed, distance, samples, times, errors and calibration.
CsvTable MakeDriveTable(const SamplingPlan& plan,
                        const std::vector<std::vector<SamplingDrive>>& drives);

}  // namespace plumescout::lab
