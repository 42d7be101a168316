// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/history/journal_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/types/error_reason.h"
#include "formats/journal/journal_file_encoder.h"
#include "server/missions/mission_recovery.h"
#include "tests/support/temp_folder.h"

namespace plumescout::server {
namespace journal_check_test {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr int kEvents = 5;

class JournalCheckTest : public testing::Test {
 protected:
  static JournalStart Start() {
    JournalStart start;
    start.mission = "hall";
    start.last_number = kEvents;
    PlusOptions(start);
    return start;
  }
  static void PlusOptions(JournalStart& start) {
    start = *DecodeStart(EncodeMissionStart(start, MissionOptions{}));
  }
  static std::string File(const JournalStart& start, int events = kEvents) {
    JournalFileEncoder encoder;
    std::string bytes = encoder.Begin(start);
    for (int i = 1; i <= events; ++i) {
      bytes += encoder.Record(EncodeEvent({i, PosteriorRefreshed{i}}));
    }
    return bytes;
  }
  absl::StatusOr<CheckedJournal> Check(const std::string& bytes,
                                       const StopFn& stop = NeverStop()) const {
    const std::string path = folder_.File("put-aside");
    std::ofstream(path, std::ios::binary) << bytes;
    return CheckJournal(path, stop);
  }

  TempFolder folder_;
};

TEST_F(JournalCheckTest, WholeFileTellsWhatIsInIt) {
  const auto journal = Check(File(Start()));
  ASSERT_TRUE(journal.ok()) << journal.status();
  EXPECT_EQ(journal->start, Start());
  EXPECT_EQ(journal->events, kEvents);
  EXPECT_EQ(journal->options.memory_budget_bytes, MissionOptions{}.memory_budget_bytes);
}

TEST_F(JournalCheckTest, FileThatIsCutOffAnywhereIsNot) {
  const std::string whole = File(Start());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const auto cut = Check(whole.substr(0, size));
    ASSERT_EQ(ErrorReason(cut.status()), reason::kExportDamaged) << size << ": " << cut.status();
    ASSERT_THAT(cut.status().message(), Not(HasSubstr("put-aside"))) << size;
  }
  // Between two records it looks whole but for what it says of itself.
  EXPECT_THAT(Check(File(Start(), 3)).status().message(),
              HasSubstr("the file ends after event 3 of 5"));
}

TEST_F(JournalCheckTest, ChangedFileIsNotTaken) {
  const std::string whole = File(Start());
  for (std::size_t at = 12; at < whole.size(); ++at) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 4);
    ASSERT_EQ(ErrorReason(Check(changed).status()), reason::kExportDamaged) << at;
  }
}

TEST_F(JournalCheckTest, MoreEventsThanItSaysAreDamageToo) {
  EXPECT_EQ(ErrorReason(Check(File(Start(), kEvents + 1)).status()), reason::kExportDamaged);
}

TEST_F(JournalCheckTest, NewerFormatIsNamed) {
  std::string newer = File(Start());
  newer[8] = 99;
  const absl::Status status = Check(newer).status();
  EXPECT_TRUE(absl::IsFailedPrecondition(status)) << status;
  EXPECT_THAT(status.message(), HasSubstr("the file: version 99"));
}

TEST_F(JournalCheckTest, RecordingOfAStudyIsNoExport) {
  JournalStart start = Start();
  start.mission = "";
  const absl::Status status = Check(File(start)).status();
  EXPECT_TRUE(absl::IsFailedPrecondition(status)) << status;
  EXPECT_THAT(status.message(), HasSubstr("recording"));
  EXPECT_EQ(ErrorReason(Check("no journal at all").status()), reason::kExportDamaged);
}

TEST_F(JournalCheckTest, EndsWhenItIsToldTo) {
  EXPECT_TRUE(absl::IsCancelled(Check(File(Start()), [] { return true; }).status()));
}

}  // namespace journal_check_test
}  // namespace plumescout::server
