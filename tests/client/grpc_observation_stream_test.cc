// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What streams over a connection may meet; what all streams promise is in ingest_contract_test.cc.
#include "client/grpc_observation_stream.h"

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/synchronization/notification.h"
#include "tests/client/ingest_traffic.h"

namespace plumescout::client {
namespace grpc_observation_stream_test {

constexpr StreamTimeouts kPatient = {.open = kPatience, .write = kPatience};
constexpr StreamTimeouts kQuick = {.open = absl::Milliseconds(50), .write = absl::Milliseconds(50)};
constexpr char kBootId[] = "boot-1";
constexpr std::int64_t kLease = 42;

using ServerStream =
    grpc::ServerReaderWriter<v1::StreamObservationsResponse, v1::StreamObservationsRequest>;
// What a server does with a stream.
using StreamScript = std::function<grpc::Status(ServerStream&)>;

v1::StreamObservationsResponse Opened(std::int64_t credit = 256) {
  v1::StreamObservationsResponse frame;
  frame.mutable_opened()->set_server_boot_id(kBootId);
  frame.mutable_opened()->mutable_ingest_state()->set_credit_sequence(credit);
  return frame;
}

v1::StreamObservationsResponse Ack(std::int64_t applied) {
  v1::StreamObservationsResponse frame;
  frame.mutable_ack()->set_applied_sequence(applied);
  return frame;
}

// A server of streams that does what a test says.
class ScriptedServer final : public v1::IngestService::Service {
 public:
  explicit ScriptedServer(StreamScript script) : script_(std::move(script)) {
    grpc::ServerBuilder builder;
    builder.RegisterService(this);
    server_ = builder.BuildAndStart();
    stub_ = v1::IngestService::NewStub(server_->InProcessChannel({}));
  }
  ~ScriptedServer() override { server_->Shutdown(std::chrono::system_clock::now()); }

  absl::StatusOr<std::unique_ptr<ObservationStream>> Open(
      const StreamTimeouts& timeouts, std::function<std::int64_t()> robot_clock_ns = nullptr) {
    RobotSession session;
    session.robot_clock_ns = std::move(robot_clock_ns);
    session.mission = "house";
    session.robot = "scout";
    session.lease_token = kLease;
    session.server_boot_id = kBootId;
    session.durable_sequence = 17;
    return OpenGrpcObservationStream(routes_, *stub_, session, timeouts);
  }

 private:
  grpc::Status StreamObservations(grpc::ServerContext*, ServerStream* stream) override {
    return script_(*stream);
  }

  const StreamScript script_;
  std::unique_ptr<grpc::Server> server_;
  MissionRoutes routes_;
  std::unique_ptr<v1::IngestService::Stub> stub_;
};

// Opens as asked to.
void Greet(ServerStream& stream) {
  v1::StreamObservationsRequest first;
  stream.Read(&first);
  stream.Write(Opened());
}

// Reads whatever comes until the client is gone.
grpc::Status Listen(ServerStream& stream) {
  v1::StreamObservationsRequest frame;
  while (stream.Read(&frame)) {
  }
  return grpc::Status::OK;
}

TEST(GrpcObservationStreamTest, TheFirstFrameNamesRobotAndLease) {
  v1::StreamObservationsRequest first;
  ScriptedServer server([&](ServerStream& stream) {
    stream.Read(&first);
    stream.Write(Opened());
    return Listen(stream);
  });

  const auto stream = server.Open(kPatient);

  ASSERT_TRUE(stream.ok()) << stream.status();
  EXPECT_EQ(first.open().robot(), "missions/house/robots/scout");
  EXPECT_EQ(first.open().lease_token(), kLease);
  EXPECT_EQ(first.open().durable_sequence(), 17);
  EXPECT_EQ((*stream)->opened().credit_sequence, 256);
}

TEST(GrpcObservationStreamTest, BatchesSayWhenTheyWereSentIfThereIsAClock) {
  for (const std::int64_t now_ns : {0, 1234}) {
    std::int64_t sent_time_ns = -1;
    absl::Notification heard;
    ScriptedServer server([&](ServerStream& stream) {
      Greet(stream);
      v1::StreamObservationsRequest frame;
      stream.Read(&frame);
      sent_time_ns = frame.batch().sent_time_ns();
      heard.Notify();
      return Listen(stream);
    });
    std::function<std::int64_t()> clock;
    if (now_ns != 0) clock = [now_ns] { return now_ns; };
    const auto stream = server.Open(kPatient, clock);
    ASSERT_TRUE(stream.ok()) << stream.status();
    ASSERT_TRUE((*stream)->Write({{1, 5, {}, GasReading{1.0}}}).ok());
    heard.WaitForNotification();
    EXPECT_EQ(sent_time_ns, now_ns);
  }
}

TEST(GrpcObservationStreamTest, AServerThatHasRestartedWithItsDataIsKnownByItsBoot) {
  ScriptedServer server([](ServerStream& stream) {
    v1::StreamObservationsResponse frame = Opened();
    frame.mutable_opened()->set_server_boot_id("boot-2");
    stream.Write(frame);
    return Listen(stream);
  });

  const auto stream = server.Open(kPatient);
  ASSERT_TRUE(stream.ok()) << stream.status();
  EXPECT_EQ((*stream)->server_boot_id(), "boot-2");
}

TEST(GrpcObservationStreamTest, ARefusalToOpenIsPassedOn) {
  ScriptedServer server([](ServerStream&) {
    return grpc::Status(grpc::StatusCode::NOT_FOUND, "ROBOT_NOT_FOUND: robot \"scout\"");
  });

  EXPECT_EQ(server.Open(kPatient).status(),
            absl::NotFoundError("ROBOT_NOT_FOUND: robot \"scout\""));
}

TEST(GrpcObservationStreamTest, AServerThatDoesNotAnswerIsGivenUp) {
  ScriptedServer server(Listen);

  const absl::Status status = server.Open(kQuick).status();

  EXPECT_TRUE(absl::IsUnavailable(status)) << status;
}

TEST(GrpcObservationStreamTest, AFirstFrameThatDoesNotOpenIsAnError) {
  ScriptedServer server([](ServerStream& stream) {
    stream.Write(Ack(3));
    return Listen(stream);
  });

  EXPECT_TRUE(absl::IsInternal(server.Open(kPatient).status()));
}

TEST(GrpcObservationStreamTest, FramesThatHaveNoPlaceAreAnError) {
  for (const auto& frame : {Opened(), v1::StreamObservationsResponse()}) {
    ScriptedServer server([&](ServerStream& stream) {
      Greet(stream);
      stream.Write(frame);
      return Listen(stream);
    });
    const auto stream = server.Open(kPatient);
    ASSERT_TRUE(stream.ok()) << stream.status();

    EXPECT_TRUE(absl::IsInternal((*stream)->Read(kPatience).status()));
  }
}

TEST(GrpcObservationStreamTest, WhateverTheServerSaidBeforeItLeftIsRead) {
  ScriptedServer server([](ServerStream& stream) {
    Greet(stream);
    for (std::int64_t applied = 1; applied <= 3; ++applied) stream.Write(Ack(applied));
    return grpc::Status(grpc::StatusCode::UNAVAILABLE, "going away");
  });
  const auto stream = server.Open(kPatient);
  ASSERT_TRUE(stream.ok()) << stream.status();

  EXPECT_TRUE(ReadUntilApplied(**stream, 3).ok());

  EXPECT_EQ((*stream)->Read(kPatience).status(), absl::UnavailableError("going away"));
  EXPECT_EQ((*stream)->Write(GasRange(1, 1)), absl::UnavailableError("going away"));
  EXPECT_EQ((*stream)->Finish(), absl::UnavailableError("going away"));
}

TEST(GrpcObservationStreamTest, AServerThatClosesWithoutAReasonIsUnavailable) {
  for (const grpc::StatusCode code :
       {grpc::StatusCode::OK, grpc::StatusCode::CANCELLED, grpc::StatusCode::DEADLINE_EXCEEDED}) {
    ScriptedServer server([code](ServerStream& stream) {
      Greet(stream);
      return grpc::Status(code, "");
    });
    const auto stream = server.Open(kPatient);
    ASSERT_TRUE(stream.ok()) << stream.status();

    // Not kDeadlineExceeded, by which Read says that the stream lives.
    EXPECT_TRUE(absl::IsUnavailable((*stream)->Read(kPatience).status())) << code;
  }
}

TEST(GrpcObservationStreamTest, AServerThatStopsReadingIsGivenUp) {
  absl::Notification given_up;
  ScriptedServer server([&](ServerStream& stream) {
    Greet(stream);
    given_up.WaitForNotificationWithTimeout(kPatience);
    return grpc::Status::OK;
  });
  const auto stream = server.Open({.open = kPatience, .write = absl::Milliseconds(50)});
  ASSERT_TRUE(stream.ok()) << stream.status();

  absl::Status written;
  constexpr int kMostWrites = 10'000;  // more than any buffer on the way takes
  const std::vector<Observation> batch = LookAround(250);
  for (int i = 0; i < kMostWrites && written.ok(); ++i) written = (*stream)->Write(batch);
  given_up.Notify();

  EXPECT_TRUE(absl::IsUnavailable(written)) << written;
}

TEST(GrpcObservationStreamTest, AStreamThatIsDroppedIsCancelled) {
  absl::Notification cancelled;
  ScriptedServer server([&](ServerStream& stream) {
    Greet(stream);
    Listen(stream);
    cancelled.Notify();
    return grpc::Status::OK;
  });

  server.Open(kPatient)->reset();

  EXPECT_TRUE(cancelled.WaitForNotificationWithTimeout(kPatience));
}

TEST(GrpcObservationStreamTest, FinishWaitsForTheServersLastWord) {
  ScriptedServer server([](ServerStream& stream) {
    Greet(stream);
    Listen(stream);
    stream.Write(Ack(5));
    return grpc::Status::OK;
  });
  const auto stream = server.Open(kPatient);
  ASSERT_TRUE(stream.ok()) << stream.status();

  EXPECT_EQ((*stream)->Finish(), absl::OkStatus());
  EXPECT_EQ((*stream)->Finish(), absl::OkStatus());  // and may be asked for again
}

TEST(GrpcObservationStreamTest, LargeBatchesAreCutIntoFramesThatAServerTakes) {
  constexpr std::size_t kServerLimit_bytes = 262'144;  // limits.max_receive_bytes
  std::vector<std::int64_t> received;
  std::size_t largest_bytes = 0;
  ScriptedServer server([&](ServerStream& stream) {
    Greet(stream);
    v1::StreamObservationsRequest frame;
    while (stream.Read(&frame)) {
      largest_bytes = std::max(largest_bytes, frame.ByteSizeLong());
      for (const auto& observation : frame.batch().observations()) {
        received.push_back(observation.sequence());
      }
    }
    return grpc::Status::OK;
  });
  const auto stream = server.Open(kPatient);
  ASSERT_TRUE(stream.ok()) << stream.status();
  std::vector<Observation> batch = GasRange(1, 50);
  constexpr std::size_t kBeams = 5000;  // of 2 bytes each: 500 kB in all
  for (Observation& observation : batch) {
    observation.payload = Scan{0.0, 0.001, 20.0, std::vector<float>(kBeams, 3.0F)};
  }

  ASSERT_EQ((*stream)->Write(batch), absl::OkStatus());
  ASSERT_EQ((*stream)->Finish(), absl::OkStatus());

  EXPECT_LE(largest_bytes, kServerLimit_bytes);
  ASSERT_EQ(received.size(), batch.size());
  for (std::size_t i = 0; i < batch.size(); ++i) EXPECT_EQ(received[i], batch[i].sequence);
}

// On a connection that has as many streams as the server allows, the next one waits for its turn.
TEST(GrpcObservationStreamTest, AStreamThatDoesNotGetItsTurnIsGivenUp) {
  class Listener final : public v1::IngestService::Service {
    grpc::Status StreamObservations(grpc::ServerContext*, ServerStream* stream) override {
      Greet(*stream);
      return Listen(*stream);
    }
  } service;
  int port = 0;
  grpc::ServerBuilder builder;
  builder.AddChannelArgument(GRPC_ARG_MAX_CONCURRENT_STREAMS, 1);
  builder.AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &port);
  builder.RegisterService(&service);
  const auto server = builder.BuildAndStart();
  const auto stub = v1::IngestService::NewStub(
      grpc::CreateChannel(absl::StrCat("127.0.0.1:", port), grpc::InsecureChannelCredentials()));
  MissionRoutes routes;
  RobotSession session;
  session.mission = "house";
  session.robot = "scout";
  auto first = OpenGrpcObservationStream(routes, *stub, session, kPatient);
  ASSERT_TRUE(first.ok()) << first.status();

  const absl::Status second = OpenGrpcObservationStream(routes, *stub, session, kQuick).status();

  EXPECT_TRUE(absl::IsUnavailable(second)) << second;
  first->reset();
  server->Shutdown(std::chrono::system_clock::now());
}

}  // namespace grpc_observation_stream_test
}  // namespace plumescout::client
