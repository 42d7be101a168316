// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/report.h"

#include <filesystem>

#include "core/types/status_macros.h"
#include "formats/file_io.h"
#include "lab/report/figures.h"
#include "lab/report/html_page.h"
#include "lab/report/png.h"
#include "lab/report/sheet.h"

namespace plumescout::lab {
namespace {

absl::Status Validate(const ReportData& data) {
  const GridGeometry& geometry = data.map.occupancy.geometry();
  if (data.map.occupancy.size() == 0 || !(geometry.resolution_m > 0.0)) {
    return absl::InvalidArgumentError("report: the map is empty");
  }
  if (data.map.gas_mean_ppm.geometry() != geometry ||
      data.map.gas_variance_ppm2.geometry() != geometry) {
    return absl::InvalidArgumentError("report: the gas has another geometry than the map");
  }
  if (data.true_gas_ppm && data.true_gas_ppm->geometry() != data.truth.geometry()) {
    return absl::InvalidArgumentError("report: the true gas has another geometry than the truth");
  }
  if (data.objective && data.objective->verdicts.geometry() != geometry) {
    return absl::InvalidArgumentError("report: the verdicts have another geometry than the map");
  }
  return absl::OkStatus();
}

}  // namespace

absl::Status WriteReport(const ReportData& data, const std::string& folder) {
  PLUMESCOUT_RETURN_IF_ERROR(Validate(data));
  ReportFigures figures{data.title, data.key_numbers, MakeMapPanels(data), MakeCharts(data)};
  figures.explorer = data.explorer;
  if (data.objective) {
    figures.notes.push_back(data.objective->explanation);
    figures.tables.push_back(ObjectiveTable(*data.objective, data.map));
  }
  if (data.team) figures.bar_charts.push_back(ShareChart(*data.team));
  const std::filesystem::path path(folder);
  PLUMESCOUT_RETURN_IF_ERROR(MakeFolder(folder));
  PLUMESCOUT_RETURN_IF_ERROR(WriteFile((path / "report.html").string(), MakeHtmlPage(figures)));
  return WritePng(DrawSheet(figures), (path / "report.png").string());
}

}  // namespace plumescout::lab
