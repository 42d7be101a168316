// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "lab/formats/csv.h"
#include "lab/formats/summary.h"
#include "lab/trials/map_calibration.h"
#include "lab/trials/study.h"

namespace plumescout::lab {

// Whether maps know how far off they are, as studies and runs tell it (kSigmaFigures).

// Of one map: figures named PREFIX and what they are.
void AddCalibration(const MapCalibration& map, const std::string& prefix, Summary& summary);
// The same without prefix, and as a key number.
void AddCalibration(const MapCalibration& map, Study& study);

// As further columns of a table, and in a row of it.
void AddCalibrationColumns(CsvTable& table);
void AddCalibration(const MapCalibration& map, std::vector<double>& row);

// The maps that the missions of one row of a study end with.
struct RowMaps {
  std::string name;
  std::vector<MapCalibration> maps;
};

// Means over the maps that estimate a critical cell, which all count the same; NaN if there are
// none. Cells are summed.
MapCalibration MeanOf(std::span<const MapCalibration> maps);
// The share of all cells of all maps together; NaN without.
double PooledShare(std::span<const MapCalibration> maps, double MapCalibration::*share);

// A table, and figures named ROW_FIGURE: means, and pooled_within_1_sigma and
// pooled_within_2_sigma.
void AddCalibration(const std::vector<RowMaps>& rows, Study& study);

}  // namespace plumescout::lab
