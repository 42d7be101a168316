// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "lab/formats/csv.h"
#include "lab/formats/summary.h"
#include "lab/report/sheet.h"

namespace plumescout::lab {

// EpisodeOptions::end_margin_m of all studies: figures were made when robots drove on to the cell
// of a frontier itself, where one mission in seven touched a wall that was not on the map yet.
inline constexpr double kStudiedEndMargin_m = 0.0;

struct ExperimentOptions {
  std::uint64_t seed = 1;
  bool quick = false;                            // less of everything: a minute at most
  std::optional<int> trials{};                   // >= 1; default: as many as the paper's
  std::vector<std::string> scenes{};             // scene folders in place of the study's own
  std::string folder{};                          // for scenes and trials on the way; may stand
  int jobs = 1;                                  // trials at once, >= 1
  std::function<void(double share)> progress{};  // told how much is done, [0, 1]; may be empty
};

// Of a part of an experiment that goes from the share `from` of the whole to `to`: tells
// options.progress, if there is one. Never empty: who has a share to tell may call it.
std::function<void(double share)> PartOfProgress(const ExperimentOptions& options, double from,
                                                 double to);

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
