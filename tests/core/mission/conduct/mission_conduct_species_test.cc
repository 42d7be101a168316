// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// Audits of missions that map several gases.

#include <gtest/gtest.h>

#include <cstddef>
#include <utility>
#include <vector>

#include "core/mission/conduct/mission_conduct.h"
#include "tests/support/room_run.h"

namespace plumescout {
namespace mission_conduct_species_test {

TEST(MissionConductSpecies, AFindingIsCountedForItsGas) {
  MissionOptions options;
  options.gas_species.emplace_back().name = "methane";
  options.gas_species.emplace_back().name = "ozone";
  MissionConduct conduct(Mission::Create(options).value());
  ASSERT_TRUE(conduct.Register(RobotRegistered{"r1", 0.2, 1}).ok());
  const std::vector<Observation> log = support::RoomRun();
  std::vector<IncomingObservation> half(log.size() / 2);
  for (std::size_t i = 0; i < half.size(); ++i) half[i].observation = log[i];
  ASSERT_TRUE(conduct.Ingest("r1", 1, std::move(half)).status.ok());
  ASSERT_EQ(conduct.mission().epoch(), nullptr) << "nothing is due";
  conduct.TakeFinding({.mean_ppm = 1e-6, .species = 1});
  EXPECT_EQ(conduct.Snapshot()->Gas(0).audits, GasAudits());
  EXPECT_EQ(conduct.Snapshot()->Gas(1).audits, (GasAudits{1, 1e-6, 0.0, 0}));
  EXPECT_EQ(conduct.mission().epoch(), nullptr) << "nothing is to be mended";
  conduct.TakeFinding({.mean_ppm = 2.0, .certified = false, .species = 1});
  EXPECT_EQ(conduct.Snapshot()->Gas(0).audits.alarms, 0);
  EXPECT_EQ(conduct.Snapshot()->Gas(1).audits, (GasAudits{2, 2.0, 0.0, 1}));
  EXPECT_NE(conduct.mission().epoch(), nullptr) << "all fields are made anew";
}

}  // namespace mission_conduct_species_test
}  // namespace plumescout
