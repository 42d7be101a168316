// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/segment_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "formats/file_io.h"
#include "tests/client/log_traffic.h"
#include "tests/support/temp_folder.h"

namespace plumescout::client {
namespace segment_file_test {

using ::testing::HasSubstr;

class SegmentFileTest : public ::testing::Test {
 protected:
  void SetUp() override {
    auto file = SegmentFile::Create(path_, disk_.System());
    ASSERT_TRUE(file.ok()) << file.status();
    file_ = *std::move(file);
  }
  std::string Content() const { return *ReadFile(path_, 1000); }

  const TempFolder folder_;
  const std::string path_ = folder_.File("segment");
  FailingDisk disk_;
  std::unique_ptr<SegmentFile> file_;
};

TEST_F(SegmentFileTest, GrowsByPieces) {
  ASSERT_TRUE(file_->Append("one").ok());
  ASSERT_TRUE(file_->Append("two").ok());

  EXPECT_EQ(Content(), "onetwo");
  EXPECT_EQ(file_->size_bytes(), 6U);
  EXPECT_TRUE(file_->Sync().ok());
  EXPECT_FALSE(file_->broken());
}

TEST_F(SegmentFileTest, WhatDoesNotFitIsTakenBackWhole) {
  ASSERT_TRUE(file_->Append("one").ok());
  disk_.full = true;
  disk_.half_writes = 1;

  const absl::Status status = file_->Append("twenty");

  EXPECT_TRUE(absl::IsUnavailable(status)) << status;
  EXPECT_THAT(std::string(status.message()), HasSubstr(path_));
  EXPECT_THAT(std::string(status.message()), HasSubstr("No space left"));
  EXPECT_EQ(Content(), "one");
  EXPECT_FALSE(file_->broken());

  disk_.full = false;
  ASSERT_TRUE(file_->Append("two").ok());
  EXPECT_EQ(Content(), "onetwo");
}

TEST_F(SegmentFileTest, AFailedSyncBreaksIt) {
  disk_.syncs = false;
  EXPECT_TRUE(absl::IsUnavailable(file_->Sync()));
  EXPECT_TRUE(file_->broken());
}

TEST_F(SegmentFileTest, NoFileIsWrittenOver) {
  EXPECT_TRUE(absl::IsUnavailable(SegmentFile::Create(path_, {}).status()));
}

TEST_F(SegmentFileTest, PathsAreSyncedIfTheyAreThere) {
  EXPECT_TRUE(SyncPath(folder_.path()).ok());
  EXPECT_TRUE(absl::IsUnavailable(SyncPath(folder_.File("none"))));
}

}  // namespace segment_file_test
}  // namespace plumescout::client
