// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/bench_summary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "CLI/App.hpp"
#include "CLI/Config.hpp"
#include "CLI/Formatter.hpp"
#include "lab/about/about.h"

namespace plumescout::lab {
namespace bench_summary_test {

using Figures = std::vector<std::pair<std::string, double>>;

TEST(BenchSummary, KeepsFiguresInOrderAndSaysWhatTheyWereMeasuredOn) {
  BenchSummary summary(7);
  summary.Set("two_ms", 2.5);
  summary.Set("one_ms", 1.5);
  EXPECT_EQ(summary.summary().figures, (Figures{{"two_ms", 2.5}, {"one_ms", 1.5}}));
  EXPECT_EQ(summary.summary().about, AboutThisRun(7));
}

TEST(BenchSummary, LeavesOutWhatCouldNotBeMeasured) {
  BenchSummary summary(1);
  summary.Set("nan_ms", std::numeric_limits<double>::quiet_NaN());
  summary.Set("infinite_ms", std::numeric_limits<double>::infinity());
  EXPECT_TRUE(summary.summary().figures.empty());
}

TEST(BenchSummary, KeepsTheLastValueOfAName) {
  BenchSummary summary(1);
  summary.Set("one_ms", 1.0);
  summary.Set("one_ms", 3.0);
  EXPECT_EQ(summary.summary().figures, (Figures{{"one_ms", 3.0}}));
}

TEST(RunBench, WritesTheSummaryOfItsBodyWithTheSeedGiven) {
  const std::string path = ::testing::TempDir() + "bench_summary_test.json";
  std::string arguments[] = {"bench", "--seed", "9", "--summary", path};
  char* argv[] = {arguments[0].data(), arguments[1].data(), arguments[2].data(),
                  arguments[3].data(), arguments[4].data()};
  CLI::App app("bench");
  EXPECT_EQ(RunBench(app, 5, argv,
                     [](BenchSummary& summary) {
                       summary.Set("answer", 42.0);
                       return absl::OkStatus();
                     }),
            0);
  std::ifstream file(path);
  const auto json = nlohmann::json::parse(file);
  EXPECT_EQ(json["answer"], 42.0);
  EXPECT_EQ(json["about"]["seed"], "9");
}

TEST(RunBench, FailsWhenItsBodyFailsOrAFlagIsUnknown) {
  std::string arguments[] = {"bench", "--no-such-flag"};
  char* argv[] = {arguments[0].data(), arguments[1].data()};
  CLI::App app("bench");
  EXPECT_NE(RunBench(app, 1, argv, [](BenchSummary&) { return absl::InternalError("no"); }), 0);
  CLI::App other("bench");
  EXPECT_NE(RunBench(other, 2, argv, [](BenchSummary&) { return absl::OkStatus(); }), 0);
}

}  // namespace bench_summary_test
}  // namespace plumescout::lab
