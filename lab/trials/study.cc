// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/study.h"

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "formats/file_io.h"
#include "lab/report/html_page.h"
#include "lab/report/png.h"

namespace plumescout::lab {

std::function<void(double share)> PartOfProgress(const ExperimentOptions& options, double from,
                                                 double to) {
  return [progress = options.progress, from, to](double share) {
    if (progress) progress(from + (to - from) * share);
  };
}

absl::Status WriteStudy(const Study& study, const std::string& folder) {
  PLUMESCOUT_RETURN_IF_ERROR(MakeFolder(folder));
  PLUMESCOUT_RETURN_IF_ERROR(
      WriteFile(absl::StrCat(folder, "/report.html"), MakeHtmlPage(study.figures)));
  PLUMESCOUT_RETURN_IF_ERROR(
      WritePng(DrawSheet(study.figures), absl::StrCat(folder, "/report.png")));
  PLUMESCOUT_RETURN_IF_ERROR(WriteCsv(study.table, absl::StrCat(folder, "/results.csv")));
  return WriteSummary(study.summary, absl::StrCat(folder, "/summary.json"));
}

}  // namespace plumescout::lab
