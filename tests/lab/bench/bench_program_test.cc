// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/bench_program.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace plumescout::lab {
namespace bench_program_test {

struct Asked {
  int worlds = 5;
  std::string only;
  bool whole = false;
  bool ran = false;
  int exit_code = 0;
};

Asked RunWith(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "bench");
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  Asked asked;
  asked.exit_code = BenchProgram("A bench")
                        .AddCount("--worlds", asked.worlds, "Halls")
                        .AddText("--only", asked.only, "One case")
                        .AddSwitch("--whole", asked.whole, "All of it")
                        .Run(static_cast<int>(argv.size()), argv.data(), [&](BenchSummary&) {
                          asked.ran = true;
                          return absl::OkStatus();
                        });
  return asked;
}

TEST(BenchProgram, ReadsItsFlagsBeforeItRuns) {
  const Asked asked = RunWith({"--worlds", "3", "--only", "16x20m", "--whole"});
  EXPECT_TRUE(asked.ran);
  EXPECT_EQ(asked.exit_code, 0);
  EXPECT_EQ(asked.worlds, 3);
  EXPECT_EQ(asked.only, "16x20m");
  EXPECT_TRUE(asked.whole);
}

TEST(BenchProgram, KeepsDefaultsAndRefusesCountsBelowOne) {
  EXPECT_EQ(RunWith({}).worlds, 5);
  const Asked refused = RunWith({"--worlds", "0"});
  EXPECT_FALSE(refused.ran);
  EXPECT_NE(refused.exit_code, 0);
}

}  // namespace bench_program_test
}  // namespace plumescout::lab
