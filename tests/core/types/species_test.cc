// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/types/species.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace plumescout {
namespace species_test {

using ::testing::HasSubstr;

MissionOptions Named(const std::vector<std::string>& names) {
  MissionOptions options;
  for (const std::string& name : names) options.gas_species.emplace_back().name = name;
  return options;
}

TEST(SpeciesTest, AMissionWithoutNamesHasOneGas) {
  const MissionOptions options;
  EXPECT_EQ(SpeciesCount(options), 1u);
  EXPECT_EQ(SpeciesName(options, 0), "");
  EXPECT_EQ(FindSpecies(options, ""), 0u);
  EXPECT_FALSE(FindSpecies(options, "methane").has_value());
  EXPECT_EQ(SpeciesNames(options), "");
  EXPECT_EQ(GasOptionsOfAll(options).size(), 1u);
  EXPECT_TRUE(ValidateSpecies(options).ok());
}

TEST(SpeciesTest, NamesTellGasesApart) {
  const MissionOptions options = Named({"methane", "hydrogen-sulfide"});
  EXPECT_EQ(SpeciesCount(options), 2u);
  EXPECT_EQ(SpeciesName(options, 1), "hydrogen-sulfide");
  EXPECT_EQ(FindSpecies(options, ""), 0u) << "the first";
  EXPECT_EQ(FindSpecies(options, "methane"), 0u);
  EXPECT_EQ(FindSpecies(options, "hydrogen-sulfide"), 1u);
  EXPECT_FALSE(FindSpecies(options, "ozone").has_value());
  EXPECT_EQ(SpeciesNames(options), "\"methane\", \"hydrogen-sulfide\"");
  EXPECT_TRUE(ValidateSpecies(options).ok());
}

TEST(SpeciesTest, AFurtherGasMayHaveAModelOfItsOwn) {
  MissionOptions options = Named({"methane", "ozone"});
  options.gas.prior_precision_per_ppm2 = 2.0;
  options.gas.ageing_half_life_s = 90.0;
  options.gas_species[1] = {"ozone", 30.0, 40.0, 0.02, 0.25};
  EXPECT_TRUE(Validate(options).ok());
  const GasOptions first = GasOptionsOf(options, 0);
  EXPECT_EQ(first.prior_precision_per_ppm2, 2.0);
  EXPECT_EQ(first.background_mean_ppm, options.gas.background_mean_ppm);
  const GasOptions second = GasOptionsOf(options, 1);
  EXPECT_EQ(second.prior_precision_per_ppm2, 30.0);
  EXPECT_EQ(second.observation_precision_per_ppm2, 40.0);
  EXPECT_EQ(second.background_precision_per_ppm2, 0.02);
  EXPECT_EQ(second.background_mean_ppm, 0.25);
  EXPECT_EQ(second.ageing_half_life_s, 90.0) << "as all have";
}

TEST(SpeciesTest, RefusalsNameFieldAndValue) {
  const auto refusal = [](const MissionOptions& options) {
    const absl::Status status = Validate(options);
    EXPECT_TRUE(absl::IsInvalidArgument(status)) << status;
    return std::string(status.message());
  };
  EXPECT_THAT(refusal(Named({"a", "b", "c", "d", "e"})), HasSubstr("gas_species = 5 gases"));
  EXPECT_TRUE(Validate(Named({"a", "b", "c", "d"})).ok());
  EXPECT_THAT(refusal(Named({""})), HasSubstr("gas_species[0].name = \"\""));
  EXPECT_THAT(refusal(Named({"a", "H2S"})), HasSubstr("gas_species[1].name = \"H2S\""));
  EXPECT_THAT(refusal(Named({"a", "b", "a"})),
              HasSubstr("gas_species[2].name = \"a\" is that of another gas"));
  MissionOptions options = Named({"a", "b"});
  options.gas_species[1].background_mean_ppm = -1.0;
  EXPECT_THAT(refusal(options), HasSubstr("gas_species[1].background_mean_ppm = -1"));
  options.gas_species[1].background_mean_ppm = 1.0;
  options.gas_species[1].prior_precision_per_ppm2 = 0.0;
  EXPECT_THAT(refusal(options), HasSubstr("gas_species[1].prior_precision_per_ppm2 = 0"));
  options = Named({"a", "b"});
  options.gas_species[0].observation_precision_per_ppm2 = 5.0;
  EXPECT_THAT(refusal(options),
              HasSubstr("gas_species[0].observation_precision_per_ppm2 = 5 must be unset"));
}

}  // namespace species_test
}  // namespace plumescout
