// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "lab/formats/csv.h"
#include "lab/report/chart.h"
#include "lab/trials/calibration_table.h"
#include "lab/trials/statistics.h"
#include "lab/trials/trial_study.h"

namespace plumescout::lab {

// What trials of several rows are compared by, and how that is shown.

using MetricFn = double (*)(const MapMetrics&);
double Rmse_ppm(const MapMetrics& metrics);
double Entropy_nats(const MapMetrics& metrics);         // total, as the papers print it
double EntropyPerCell_nats(const MapMetrics& metrics);  // so that buildings can be compared
double Completeness(const MapMetrics& metrics);

// A value of the trials of a row, pair by pair with other rows: in one building by trial; of
// several buildings each has one, the mean of its trials, which are not independent.
std::vector<double> UnitsOf(const std::vector<SceneRecords>& records, std::size_t row,
                            const std::function<double(const TrialRecord&)>& value);
// The same of the metric at the end.
std::vector<double> Finals(const std::vector<SceneRecords>& records, std::size_t row,
                           MetricFn metric);

// The metric over time, a curve for each row, the mean over those units; for those in `with_band`
// also the 95 % interval of the mean, dashed. Trials that end early keep their last value.
// Completeness is shown from 0 to 1.
struct RowStyle {
  std::string name;
  Rgb color;
  bool with_band = false;
};
Chart MakeMetricChart(const std::vector<SceneRecords>& records, const std::vector<RowStyle>& rows,
                      const std::string& title, MetricFn metric);

// What the oracle (oracle.h) reaches in every building with as many readings as the first trial of
// `row` took: a bound to measure gains by. Errors: as ReadScene and PlaceReadings.
absl::StatusOr<std::vector<MapMetrics>> OracleMetrics(const TrialPlan& plan,
                                                      const std::vector<SceneRecords>& records,
                                                      std::size_t row,
                                                      const std::function<void(double)>& progress);

// The maps that missions end with, by row; PREFIX and the row's name as names.
std::vector<RowMaps> FinalMaps(const TrialPlan& plan, const std::vector<SceneRecords>& records,
                               const std::string& prefix = "");

// Every trial: scene and row as labels, then seed, metrics at the end, distance, plans, collisions,
// calibration.
CsvTable MakeTrialTable(const TrialPlan& plan, const std::vector<SceneRecords>& records);

}  // namespace plumescout::lab
