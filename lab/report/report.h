// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "absl/status/status.h"
#include "lab/report/report_data.h"

namespace plumescout::lab {

// Writes into `folder`, which is made if need be:
//
//   report.html  a page that needs no other file: figures as SVG, rasters embedded as PNG
//   report.png   the same figures and numbers on one sheet
//
// kInvalidArgument if there is no map at all, or a raster has not the geometry of its occupancy;
// else as WriteFile.
absl::Status WriteReport(const ReportData& data, const std::string& folder);

}  // namespace plumescout::lab
