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

// One drive anew: the first map after `time_s`, or the last if the drive ended before.
absl::StatusOr<MapPanel> PictureTime(const SamplingPlan& plan, std::size_t row, std::size_t number,
                                     double time_s);

// The mean error of several drives over time, a curve for each row. Drives that ended early keep
// their last value.
struct NamedDrives {
  std::string name;
  Rgb color;
  std::vector<SamplingDrive> drives;
};
Chart MakeMeanErrorChart(const std::vector<NamedDrives>& rows, const std::string& title);

// Every drive: row and case as labels, then seed, distance, samples, times and errors.
CsvTable MakeDriveTable(const SamplingPlan& plan,
                        const std::vector<std::vector<SamplingDrive>>& drives);

}  // namespace plumescout::lab
