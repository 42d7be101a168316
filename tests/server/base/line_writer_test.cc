// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/line_writer.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <string>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/string_view.h"
#include "absl/strings/strip.h"

namespace plumescout::server {
namespace line_writer_test {

constexpr std::size_t kRoom_bytes = 4096;
constexpr absl::Duration kPatience = absl::Seconds(60);

// A pipe that takes 4096 bytes before somebody reads.
class Pipe {
 public:
  Pipe() {
    EXPECT_EQ(pipe2(ends_.data(), O_CLOEXEC), 0);
    EXPECT_GE(fcntl(ends_[1], F_SETPIPE_SZ, 4096), 4096);
  }
  ~Pipe() {
    CloseReader();
    close(ends_[1]);
  }
  int writer() const { return ends_[1]; }
  void CloseReader() {
    if (ends_[0] >= 0) close(ends_[0]);
    ends_[0] = -1;
  }
  void Fill() {
    const std::string line = std::string(4095, 'x') + "\n";
    EXPECT_EQ(write(ends_[1], line.data(), line.size()), 4096);
  }
  std::string ReadLine() {
    std::string line;
    char c = 0;
    while (read(ends_[0], &c, 1) == 1 && c != '\n') line.push_back(c);
    return line;
  }

 private:
  std::array<int, 2> ends_{-1, -1};
};

std::string Notice(std::int64_t dropped) { return absl::StrCat("dropped ", dropped, "\n"); }

TEST(LineWriterTest, LinesComeOutInOrder) {
  Pipe pipe;
  LineWriter writer(pipe.writer(), kRoom_bytes, Notice);
  for (int i = 0; i < 100; ++i) writer.Push(absl::StrCat("line ", i, "\n"));
  for (int i = 0; i < 100; ++i) EXPECT_EQ(pipe.ReadLine(), absl::StrCat("line ", i));
  EXPECT_TRUE(writer.Flush(kPatience));
  EXPECT_EQ(writer.counts().written, 100);
  EXPECT_EQ(writer.counts().dropped, 0);
}

TEST(LineWriterTest, WhoDoesNotReadHoldsUpNobodyAndIsToldWhatWasDropped) {
  Pipe pipe;
  pipe.Fill();
  LineWriter writer(pipe.writer(), kRoom_bytes, Notice);
  int pushed = 0;
  while (writer.counts().dropped < 10) writer.Push(absl::StrCat("line ", pushed++, "\n"));
  EXPECT_FALSE(writer.Flush(absl::Milliseconds(1)));
  EXPECT_EQ(pipe.ReadLine().size(), 4095u);  // what filled it
  // Each line comes, or stands in a notice at its place.
  int dropped = 0;
  for (int next = 0; next < pushed;) {
    const std::string line = pipe.ReadLine();
    absl::string_view text = line;
    int more = 0;
    if (absl::ConsumePrefix(&text, "dropped ") && absl::SimpleAtoi(text, &more)) {
      dropped += more;
      next += more;
    } else {
      ASSERT_EQ(line, absl::StrCat("line ", next));
      ++next;
    }
  }
  EXPECT_EQ(dropped, writer.counts().dropped);
  writer.Push("later\n");
  EXPECT_EQ(pipe.ReadLine(), "later");
  EXPECT_TRUE(writer.Flush(kPatience));
}

TEST(LineWriterTest, WhoDoesNotReadHoldsUpNoEnd) {
  Pipe pipe;
  {
    LineWriter writer(pipe.writer(), kRoom_bytes, Notice);
    while (writer.counts().dropped == 0) writer.Push(absl::StrCat(std::string(100, 'x'), "\n"));
  }
  EXPECT_EQ(pipe.ReadLine(), std::string(100, 'x'));
}

TEST(LineWriterTest, LinesForNobodyAreDropped) {
  const auto before = signal(SIGPIPE, SIG_IGN);
  Pipe pipe;
  pipe.CloseReader();
  LineWriter writer(pipe.writer(), kRoom_bytes, Notice);
  for (int i = 1; i <= 3; ++i) {
    writer.Push("line\n");
    EXPECT_TRUE(writer.Flush(kPatience));
    EXPECT_EQ(writer.counts().dropped, i);
  }
  EXPECT_EQ(writer.counts().written, 0);
  signal(SIGPIPE, before);
}

TEST(LineWriterTest, LineLongerThanAPipeIsWrittenWhole) {
  const std::string line(20'000, 'x');
  Pipe pipe;
  LineWriter writer(pipe.writer(), 1 << 20, Notice);
  writer.Push(line + "\n");
  EXPECT_EQ(pipe.ReadLine(), line);
}

}  // namespace line_writer_test
}  // namespace plumescout::server
