// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/recording_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "formats/file_io.h"
#include "tests/support/temp_folder.h"

namespace plumescout {
namespace recording_file_test {

using std::chrono::seconds;
using ::testing::HasSubstr;

class RecordingFileTest : public testing::Test {
 protected:
  std::string Read(const std::string& name) {
    return ReadFile(folder_.File(name), 1000).value_or("none");
  }

  const TempFolder folder_;
  RecordingFileOptions options_;
  const RecordingFile::Time now_ = std::chrono::steady_clock::now();
};

TEST_F(RecordingFileTest, NoneIsOverwritten) {
  for (const char* bytes : {"one", "two", "three"}) {
    RecordingFile file(options_);
    ASSERT_TRUE(file.Begin(folder_.File("deep/below/hall")).ok());
    ASSERT_TRUE(file.Append(bytes).ok());
    file.End();
  }
  EXPECT_EQ(Read("deep/below/hall.mcap"), "one");
  EXPECT_EQ(Read("deep/below/hall-2.mcap"), "two");
  EXPECT_EQ(Read("deep/below/hall-3.mcap"), "three");
}

TEST_F(RecordingFileTest, AFileIsFullByItsBytesAndTheNextIsNot) {
  options_.max_file_bytes = 5;
  RecordingFile file(options_);
  ASSERT_TRUE(file.Begin(folder_.File("a")).ok());
  ASSERT_TRUE(file.Append("1234").ok());
  EXPECT_FALSE(file.is_full());
  ASSERT_TRUE(file.Append("5").ok());
  EXPECT_TRUE(file.is_full());
  file.End();
  ASSERT_TRUE(file.Begin(folder_.File("b")).ok());
  EXPECT_FALSE(file.is_full());
}

TEST_F(RecordingFileTest, AChunkIsDueAfterItsFirstMessage) {
  RecordingFile file(options_);
  ASSERT_TRUE(file.Begin(folder_.File("a")).ok());
  EXPECT_FALSE(file.IsChunkDue(now_ + seconds(100))) << "there is nothing in it";
  file.NoteMessage(now_);
  file.NoteMessage(now_ + seconds(9));
  EXPECT_FALSE(file.IsChunkDue(now_ + seconds(9)));
  EXPECT_TRUE(file.IsChunkDue(now_ + seconds(10)));
  ASSERT_TRUE(file.Append("").ok());
  EXPECT_TRUE(file.IsChunkDue(now_ + seconds(10))) << "no chunk came";
  ASSERT_TRUE(file.Append("chunk").ok());
  EXPECT_FALSE(file.IsChunkDue(now_ + seconds(100)));
}

TEST_F(RecordingFileTest, AfterOneThatCouldNotBeWrittenItRests) {
  options_.open = [](const std::string&) -> absl::StatusOr<AppendBytes> {
    return AppendBytes([](absl::string_view) {
      return absl::UnavailableError("a.mcap: No space left on device");
    });
  };
  RecordingFile file(options_);
  ASSERT_TRUE(file.Begin(folder_.File("a")).ok());
  EXPECT_THAT(std::string(file.Append("bytes").message()), HasSubstr("No space left"));
  EXPECT_FALSE(file.rests(now_));
  file.GiveUp(now_);
  EXPECT_TRUE(file.rests(now_ + seconds(29)));
  EXPECT_FALSE(file.rests(now_ + seconds(30)));
}

TEST_F(RecordingFileTest, AFolderThatIsNoneIsNamed) {
  RecordingFile file(options_);
  const absl::Status status = file.Begin("/proc/no-such-place/hall");
  EXPECT_TRUE(absl::IsUnavailable(status)) << status;
  EXPECT_THAT(std::string(status.message()), HasSubstr("/proc/no-such-place"));
}

}  // namespace recording_file_test
}  // namespace plumescout
