// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/calibration_table.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "lab/trials/statistics.h"

namespace plumescout::lab {
namespace {

std::string Text(double value) {
  return std::isfinite(value) ? absl::StrFormat("%.2f", value) : "–";
}

}  // namespace

void AddCalibration(const MapCalibration& map, const std::string& prefix, Summary& summary) {
  for (const CalibrationFigure& figure : kSigmaFigures) {
    summary.figures.emplace_back(absl::StrCat(prefix, figure.name), map.*figure.value);
  }
}

void AddCalibration(const MapCalibration& map, Study& study) {
  AddCalibration(map, "", study.summary);
  study.figures.key_numbers.emplace_back(
      "1 σ; 2 σ hold; rms z; NLPD",
      absl::StrFormat("%s; %s; %s; %s nats", Text(map.within_1_sigma), Text(map.within_2_sigma),
                      Text(map.rms_z), Text(map.nlpd_nats)));
}

void AddCalibrationColumns(CsvTable& table) {
  for (const CalibrationFigure& figure : kSigmaFigures) table.columns.emplace_back(figure.name);
}

void AddCalibration(const MapCalibration& map, std::vector<double>& row) {
  for (const CalibrationFigure& figure : kSigmaFigures) row.push_back(map.*figure.value);
}

MapCalibration MeanOf(std::span<const MapCalibration> maps) {
  MapCalibration mean;
  for (const MapCalibration& map : maps) mean.estimated_cells += map.estimated_cells;
  for (const CalibrationFigure& figure : kCalibrationFigures) {
    std::vector<double> values;
    for (const MapCalibration& map : maps) {
      if (map.estimated_cells > 0) values.push_back(map.*figure.value);
    }
    mean.*figure.value = SpreadOf(values).mean;
  }
  return mean;
}

double PooledShare(std::span<const MapCalibration> maps, double MapCalibration::*share) {
  double held = 0.0;
  double cells = 0.0;
  for (const MapCalibration& map : maps) {
    if (map.estimated_cells == 0) continue;
    held += map.estimated_cells * map.*share;
    cells += map.estimated_cells;
  }
  return held / cells;
}

void AddCalibration(const std::vector<RowMaps>& rows, Study& study) {
  TextTable table;
  table.title =
      "Do maps know how far off they are? Critical cells that are estimated, against their "
      "variances: 0.68 within 1 σ, 0.95 within 2 σ and rms z 1 if they do. Means over maps with "
      "such cells; pooled: over all of these cells together";
  table.columns = {"row",        "maps",       "cells", "1 σ holds", "2 σ holds",
                   "1 σ pooled", "2 σ pooled", "rms z", "NLPD, nats"};
  for (const auto& [name, maps] : rows) {
    const MapCalibration mean = MeanOf(maps);
    const double within_1 = PooledShare(maps, &MapCalibration::within_1_sigma);
    const double within_2 = PooledShare(maps, &MapCalibration::within_2_sigma);
    const auto told = std::count_if(maps.begin(), maps.end(),
                                    [](const auto& map) { return map.estimated_cells > 0; });
    table.rows.push_back({name, absl::StrFormat("%d of %d", told, maps.size()),
                          absl::StrCat(mean.estimated_cells), Text(mean.within_1_sigma),
                          Text(mean.within_2_sigma), Text(within_1), Text(within_2),
                          Text(mean.rms_z), Text(mean.nlpd_nats)});
    const std::string prefix = name + "_";
    AddCalibration(mean, prefix, study.summary);
    study.summary.figures.emplace_back(prefix + "pooled_within_1_sigma", within_1);
    study.summary.figures.emplace_back(prefix + "pooled_within_2_sigma", within_2);
  }
  study.figures.tables.push_back(std::move(table));
}

}  // namespace plumescout::lab
