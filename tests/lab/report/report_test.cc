// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "formats/file_io.h"
#include "lab/report/cairo_handles.h"
#include "lab/report/sheet.h"
#include "tests/support/small_report.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace report_test {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr std::uint64_t kNoLimit = 1 << 24;

TEST(Report, PageAndSheetAreWritten) {
  const TempFolder folder;
  const std::string path = folder.File("out/run");
  ASSERT_EQ(WriteReport(MakeSmallReport(), path), absl::OkStatus());
  EXPECT_THAT(*ReadFile(path + "/report.html", kNoLimit), HasSubstr("Small room"));
  const CairoSurface sheet(cairo_image_surface_create_from_png((path + "/report.png").c_str()));
  EXPECT_GT(cairo_image_surface_get_width(sheet.get()), 4 * kPanelWidth_px);
}

TEST(Report, TheSameDataGiveTheSameBytes) {
  const TempFolder folder;
  ASSERT_TRUE(WriteReport(MakeSmallReport(), folder.File("a")).ok());
  ASSERT_TRUE(WriteReport(MakeSmallReport(), folder.File("b")).ok());
  for (const char* file : {"/report.html", "/report.png"}) {
    EXPECT_EQ(*ReadFile(folder.File("a") + file, kNoLimit),
              *ReadFile(folder.File("b") + file, kNoLimit));
  }
}

TEST(Report, OfATeamHasItsShares) {
  const TempFolder folder;
  ReportData data = MakeSmallReport();
  data.team = TeamPicture{{{"a", {}, {}}, {"b", {}, {}}}};
  ASSERT_TRUE(WriteReport(data, folder.path()).ok());
  EXPECT_THAT(*ReadFile(folder.File("report.html"), kNoLimit), HasSubstr("Shares of the robots"));
}

TEST(Report, OfAMissionWithAnObjectiveSaysWhatCameOfIt) {
  const TempFolder folder;
  ReportData data = MakeSmallReport();
  ASSERT_TRUE(WriteReport(data, folder.path()).ok());
  const std::string page = folder.File("report.html");
  EXPECT_THAT(*ReadFile(page, kNoLimit), Not(HasSubstr("What the mission was for")));
  data.objective = MakeSmallOutcome(data);
  ASSERT_TRUE(WriteReport(data, folder.path()).ok());
  EXPECT_THAT(*ReadFile(page, kNoLimit),
              AllOf(HasSubstr("<h2>What the mission was for"), HasSubstr("So it is."),
                    HasSubstr("alt=\"Objective\"")));
}

TEST(Report, AMissionThatNeverStartedStillHasAReport) {
  const TempFolder folder;
  ReportData data;
  const GridGeometry geometry{0.0, 0.0, 0.1, 3, 2};
  data.map.occupancy = Grid<CellState>(geometry);
  data.map.gas_mean_ppm = Grid<float>(geometry, NAN);
  data.map.gas_variance_ppm2 = Grid<float>(geometry, NAN);
  EXPECT_EQ(WriteReport(data, folder.path()), absl::OkStatus());
}

TEST(Report, RastersThatDoNotFitAreRefused) {
  const TempFolder folder;
  const absl::StatusCode invalid = absl::StatusCode::kInvalidArgument;
  EXPECT_EQ(WriteReport({}, folder.path()).code(), invalid);
  ReportData data = MakeSmallReport();
  data.map.gas_variance_ppm2 = Grid<float>(GridGeometry{0, 0, 1, 2, 2});
  EXPECT_EQ(WriteReport(data, folder.path()).code(), invalid);
  data = MakeSmallReport();
  data.objective = MakeSmallOutcome(data);
  data.objective->verdicts = Grid<ObjectiveVerdict>(GridGeometry{0, 0, 1, 2, 2});
  EXPECT_EQ(WriteReport(data, folder.path()).code(), invalid);
  data = MakeSmallReport();
  data.truth = Grid<CellState>();
  EXPECT_EQ(WriteReport(data, folder.path()).code(), invalid);
}

}  // namespace report_test
}  // namespace plumescout::lab
