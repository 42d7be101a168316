// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "formats/csv.h"
#include "formats/summary.h"
#include "lab/report/sheet.h"

namespace plumescout::lab {

struct ExperimentOptions {
  std::uint64_t seed = 1;
  bool quick = false;                            // fewer points and runs: a few seconds at most
  std::vector<std::string> scenes{};             // scene folders to look at, too
  std::function<void(double share)> progress{};  // told how much is done, [0, 1]; may be empty
};

// What an experiment found.
struct Study {
  ReportFigures figures;
  CsvTable table;  // every single value behind the figures
  Summary summary;
};

// Writes report.html, report.png, results.csv and summary.json into `folder`, which is made if it
// is not there.
absl::Status WriteStudy(const Study& study, const std::string& folder);

}  // namespace plumescout::lab
