// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/calls/active_streams.h"

#include <gtest/gtest.h>

namespace plumescout::server {
namespace active_streams_test {

class RecordingStream final : public EndableStream {
 public:
  void End(const absl::Status& status) override { ended = status; }
  absl::Status ended;
};

TEST(ActiveStreamsTest, EndAllReachesOpenStreams) {
  ActiveStreams streams;
  const auto stream = std::make_shared<RecordingStream>();
  streams.Add(stream);
  streams.EndAll(absl::UnavailableError("over"));
  EXPECT_TRUE(absl::IsUnavailable(stream->ended));
}

TEST(ActiveStreamsTest, RemovedStreamsAreLeftAlone) {
  ActiveStreams streams;
  const auto stream = std::make_shared<RecordingStream>();
  streams.Add(stream);
  EXPECT_EQ(streams.size(), 1);
  streams.Remove(stream.get());
  EXPECT_EQ(streams.size(), 0);
  streams.EndAll(absl::UnavailableError("over"));
  EXPECT_TRUE(stream->ended.ok());
}

TEST(ActiveStreamsTest, StreamsThatComeTooLateEndAtOnce) {
  ActiveStreams streams;
  streams.EndAll(absl::UnavailableError("over"));
  const auto stream = std::make_shared<RecordingStream>();
  streams.Add(stream);
  EXPECT_TRUE(absl::IsUnavailable(stream->ended));
}

TEST(ActiveStreamsTest, StreamsThatDiedAreSkipped) {
  ActiveStreams streams;
  streams.Add(std::make_shared<RecordingStream>());
  streams.EndAll(absl::UnavailableError("over"));
  EXPECT_EQ(streams.size(), 1);  // until its owner removes it
}

TEST(ActiveStreamsTest, StreamsOfWhomIsLockedOutEnd) {
  ActiveStreams streams;
  const auto revoked = std::make_shared<RecordingStream>();
  const auto known = std::make_shared<RecordingStream>();
  const auto anybody = std::make_shared<RecordingStream>();
  for (const auto& stream : {revoked, known, anybody}) streams.Add(stream);
  streams.LetIn(revoked.get(), [] { return absl::UnauthenticatedError("revoked"); });
  streams.LetIn(known.get(), [] { return absl::OkStatus(); });
  streams.LetIn(anybody.get(), nullptr);
  EXPECT_EQ(streams.EndLockedOut(), 1);
  EXPECT_EQ(revoked->ended, absl::UnauthenticatedError("revoked"));
  EXPECT_TRUE(known->ended.ok());
  EXPECT_TRUE(anybody->ended.ok());
}

TEST(ActiveStreamsTest, WhoIsLetInAfterItsEndIsForgotten) {
  ActiveStreams streams;
  const auto stream = std::make_shared<RecordingStream>();
  streams.LetIn(stream.get(), [] { return absl::UnauthenticatedError("revoked"); });
  EXPECT_EQ(streams.EndLockedOut(), 0);
}

}  // namespace active_streams_test
}  // namespace plumescout::server
