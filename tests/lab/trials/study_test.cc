// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/study.h"

#include <gtest/gtest.h>

#include <vector>

#include "formats/file_io.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace study_test {

constexpr std::uint64_t kMaxBytes = 1 << 20;

Study SmallStudy() {
  Study study;
  study.figures.title = "A study";
  study.figures.notes = {"What the paper shows & what ours does."};
  study.table = {{"alpha_per_m", "length_m"}, {{0.5, 3.25}}};
  study.summary.figures = {{"length_m", 3.25}};
  return study;
}

TEST(Study, WritesPagePictureTableAndSummary) {
  const TempFolder folder;
  const std::string out = folder.File("new/study");
  ASSERT_TRUE(WriteStudy(SmallStudy(), out).ok());
  const std::string page = ReadFile(out + "/report.html", kMaxBytes).value();
  EXPECT_NE(page.find("<p>What the paper shows &amp; what ours does.</p>"), std::string::npos);
  EXPECT_EQ(ReadFile(out + "/results.csv", kMaxBytes).value(),
            "alpha_per_m,length_m\r\n0.5,3.25\r\n");
  EXPECT_NE(ReadFile(out + "/summary.json", kMaxBytes).value().find("\"length_m\": 3.25"),
            std::string::npos);
  EXPECT_TRUE(ReadFile(out + "/report.png", kMaxBytes).ok());
}

TEST(PartOfProgress, TellsOfTheWhole) {
  std::vector<double> told;
  ExperimentOptions options;
  options.progress = [&](double share) { told.push_back(share); };
  const auto part = PartOfProgress(options, 0.25, 0.75);
  for (const double share : {0.0, 0.5, 1.0}) part(share);
  EXPECT_EQ(told, (std::vector<double>{0.25, 0.5, 0.75}));
}

TEST(PartOfProgress, MayBeToldThoughNobodyAsks) { PartOfProgress({}, 0.0, 1.0)(0.5); }

TEST(Study, SaysWhereItCannotWrite) {
  const TempFolder folder;
  ASSERT_TRUE(WriteFile(folder.File("file"), "in the way").ok());
  EXPECT_FALSE(WriteStudy(SmallStudy(), folder.File("file")).ok());
}

}  // namespace study_test
}  // namespace plumescout::lab
