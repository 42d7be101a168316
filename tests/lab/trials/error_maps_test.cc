// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/error_maps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace plumescout::lab {
namespace error_maps_test {

constexpr double kThreshold_ppm = 2.5;
constexpr float kStrong_ppm = 30.0F;
constexpr float kWeak_ppm = 4.0F;

// A row of 42 free cells and a wall: two of 30 ppm, 38 of 4 ppm, two of 1 ppm (not critical).
Scene RowOfCells() {
  const GridGeometry geometry{0.0, 0.0, 0.1, 43, 1};
  Scene scene;
  scene.name = "row";
  scene.occupancy = Grid<CellState>(geometry, CellState::kFree);
  scene.occupancy[42] = CellState::kOccupied;
  scene.conc_mean_ppm = Grid<float>(geometry, kWeak_ppm);
  scene.conc_mean_ppm[0] = scene.conc_mean_ppm[7] = kStrong_ppm;
  scene.conc_mean_ppm[40] = scene.conc_mean_ppm[41] = 1.0F;
  scene.conc_mean_ppm[42] = 1000.0F;
  scene.critical_threshold_ppm = kThreshold_ppm;
  return scene;
}

TrialRecord RecordWithMap(const Scene& scene, float mean_ppm) {
  TrialRecord record;
  record.mean_ppm.emplace_back(scene.geometry(), mean_ppm);
  return record;
}

TEST(ErrorMaps, TellTheErrorWhereThereIsMostGasFromTheRest) {
  const Scene scene = RowOfCells();
  const std::vector<TrialRecord> trials = {RecordWithMap(scene, 10.0F), RecordWithMap(scene, 4.0F)};
  EXPECT_EQ(PartErrors_ppm(scene, trials, 0, GasPart::kMost), (std::vector<double>{20.0, 26.0}));
  EXPECT_EQ(PartErrors_ppm(scene, trials, 0, GasPart::kRest), (std::vector<double>{6.0, 0.0}));
}

TEST(ErrorMaps, CountWhatIsNotEstimatedAsCleanAir) {
  const Scene scene = RowOfCells();
  const std::vector<TrialRecord> none = {
      RecordWithMap(scene, std::numeric_limits<float>::quiet_NaN())};
  EXPECT_EQ(PartErrors_ppm(scene, none, 0, GasPart::kMost), std::vector<double>{kStrong_ppm});
}

TEST(ErrorMaps, ShareOfSquaresIsThatOfCriticalCells) {
  const Scene scene = RowOfCells();
  const double most = 2.0 * 900.0;
  const double rest = 38.0 * 16.0;
  EXPECT_DOUBLE_EQ(ShareOfSquares(scene, GasPart::kMost), most / (most + rest));
  EXPECT_DOUBLE_EQ(ShareOfSquares(scene, GasPart::kRest), rest / (most + rest));
}

TEST(ErrorMaps, HaveNoPartsWithoutGas) {
  Scene scene = RowOfCells();
  scene.critical_threshold_ppm = 1e6;
  EXPECT_EQ(ShareOfSquares(scene, GasPart::kMost), 0.0);
  EXPECT_EQ(PartErrors_ppm(scene, {RecordWithMap(scene, 1.0F)}, 0, GasPart::kMost),
            std::vector<double>{0.0});
}

TEST(ErrorMaps, ThePanelOutlinesCriticalCells) {
  const Scene scene = RowOfCells();
  const MapPanel panel = MakeErrorPanel(scene, {RecordWithMap(scene, 0.0F)}, 0, "60 s");
  EXPECT_EQ(panel.title, "60 s");
  EXPECT_GE(panel.lines.size(), 1u);
  for (const MapLine& line : panel.lines) {
    for (const Point2& end : line.points) EXPECT_LE(end.x_m, 4.0 + 1e-9);  // the critical ones
  }
}

}  // namespace error_maps_test
}  // namespace plumescout::lab
