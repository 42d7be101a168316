// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/program/run_folder.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "formats/file_io.h"
#include "tests/lab/sim/small_scene.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace run_folder_test {

nlohmann::json SummaryOf(const MapSnapshot& map) {
  const TempFolder folder;
  TeamResult team;
  team.robots.resize(1);
  team.robots[0].path = {{0.0, {1.0, 2.0, 0.0}}, {0.2, {1.5, 2.25, 0.0}}};
  team.samples = {{.time_s = 5.0, .revision = 1, .metrics = {}}};
  const lab::Run run{
      .world = SmallWorld(), .team = team, .final_map = map, .strategy = "plumescout"};
  EXPECT_TRUE(WriteRunFolder(run, folder.path()).ok());
  constexpr std::uint64_t kMaxBytes = 1 << 20;
  return nlohmann::json::parse(ReadFile(folder.File("summary.json"), kMaxBytes).value());
}

TEST(RunFolder, TheSummarySaysWhetherTheMapKnowsItsErrors) {
  MapSnapshot map;
  map.occupancy = SmallWorld().scene().occupancy;
  map.gas_mean_ppm = SmallWorld().scene().conc_mean_ppm;  // without error
  map.gas_variance_ppm2 = Grid<float>(map.occupancy.geometry(), 0.25F);
  const nlohmann::json known = SummaryOf(map);
  EXPECT_EQ(known.at("within_1_sigma"), 1.0);
  EXPECT_EQ(known.at("within_2_sigma"), 1.0);
  EXPECT_EQ(known.at("rms_z"), 0.0);
  EXPECT_TRUE(known.contains("nlpd_nats"));
  map.gas_variance_ppm2 = Grid<float>(map.occupancy.geometry(), 0.0F);
  EXPECT_FALSE(SummaryOf(map).contains("rms_z")) << "not measured";
}

}  // namespace run_folder_test
}  // namespace plumescout::lab
