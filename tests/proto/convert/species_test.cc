// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/species.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "proto/convert/status.h"

namespace plumescout {
namespace species_test {

using ::testing::HasSubstr;

MissionOptions Two() {
  MissionOptions options;
  options.gas_species.emplace_back().name = "methane";
  options.gas_species.emplace_back().name = "ozone";
  return options;
}

TEST(SpeciesFromProto, FindsWhatIsNamed) {
  EXPECT_EQ(SpeciesFromProto("", MissionOptions(), "species").value(), 0u);
  EXPECT_EQ(SpeciesFromProto("", Two(), "species").value(), 0u);
  EXPECT_EQ(SpeciesFromProto("methane", Two(), "species").value(), 0u);
  EXPECT_EQ(SpeciesFromProto("ozone", Two(), "species").value(), 1u);
}

TEST(SpeciesFromProto, SaysWhichThereAre) {
  const absl::Status unknown = SpeciesFromProto("xenon", Two(), "species").status();
  ASSERT_EQ(FieldViolations(unknown).size(), 1u);
  EXPECT_EQ(FieldViolations(unknown)[0].field, "species");
  EXPECT_THAT(unknown.message(), HasSubstr("= \"xenon\" must be empty or one of \"methane\", "));
  EXPECT_THAT(SpeciesFromProto("methane", MissionOptions(), "species").status().message(),
              HasSubstr("the mission names no gas"));
}

TEST(CheckSpecies, EachIsNamedOnce) {
  EXPECT_TRUE(CheckSpecies({}, Two(), "species").ok());
  EXPECT_TRUE(CheckSpecies({"ozone", "methane"}, Two(), "species").ok());
  const auto blamed = [](const std::vector<std::string>& names) {
    return FieldViolations(CheckSpecies(names, Two(), "species")).at(0).field;
  };
  EXPECT_EQ(blamed({"ozone", "xenon"}), "species[1]");
  EXPECT_EQ(blamed({"ozone", "methane", "ozone"}), "species[2]");
  EXPECT_EQ(blamed({"", "methane"}), "species[1]") << "both are the first";
}

}  // namespace species_test
}  // namespace plumescout
