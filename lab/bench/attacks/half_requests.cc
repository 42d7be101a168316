// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/string_view.h"
#include "absl/time/clock.h"
#include "core/types/status_macros.h"
#include "lab/bench/attacks/attack_bed.h"
#include "lab/bench/attacks/http2_frames.h"
#include "lab/bench/attacks/raw_connection.h"

namespace plumescout::lab {
namespace {

constexpr int kConnections = 64;
constexpr int kCalls = 100;  // of each; as many as a server takes
// A request as large as servers take, of which the last byte never comes.
constexpr std::uint32_t kRequest_bytes = 262'144;
constexpr std::size_t kSent_bytes = kRequest_bytes - 1;
constexpr std::int64_t kFrame_bytes = 16'384;
constexpr std::int64_t kInitialWindow_bytes = 65'535;  // RFC 9113, section 6.9.2
// A server bounds what connections hold together, and learns of more only once it has come: 64 MiB
// become 150 to 190 MB, and up to 260 where others keep the processor busy. Without a bound they
// are 1,070 MB at least, busy or not.
constexpr double kMayGrow_mb = 256.0;
constexpr double kMayGrowBesideOthers_mb = 512.0;
constexpr absl::Duration kToSendMuch = absl::Seconds(3);
constexpr std::size_t kFrameHead_bytes = 9;

// Calls of one connection, each sent as far as the server lets it be.
class HalfCalls {
 public:
  explicit HalfCalls(std::unique_ptr<RawConnection> connection)
      : connection_(std::move(connection)), calls_(kCalls) {}

  absl::Status Begin() {
    std::string frames = absl::StrCat(kHttp2Preface, Frame(FrameType::kSettings, 0, 0, ""));
    for (int call = 0; call < kCalls; ++call) {
      absl::StrAppend(&frames,
                      Frame(FrameType::kHeaders, kEndHeaders, StreamOf(call), CallHeaders()));
    }
    return connection_->Send(frames);
  }

  // True: something was sent.
  absl::StatusOr<bool> GoOn() {
    HeedWindows(connection_->Receive());
    std::string frames;
    for (int call = 0; call < kCalls; ++call) AppendData(call, frames);
    PLUMESCOUT_RETURN_IF_ERROR(connection_->Send(frames));
    return !frames.empty();
  }

  std::int64_t sent_bytes() const { return sent_bytes_; }

 private:
  struct Call {
    std::int64_t window_bytes = kInitialWindow_bytes;
    std::size_t sent_bytes = 0;
  };

  static std::uint32_t StreamOf(int call) { return static_cast<std::uint32_t>(2 * call + 1); }

  void HeedWindows(const std::string& received) {
    unread_ += received;
    std::size_t at = 0;
    while (unread_.size() - at >= kFrameHead_bytes) {
      const absl::string_view head = absl::string_view(unread_).substr(at, kFrameHead_bytes);
      const std::size_t size = ReadBigEndian(head.substr(0, 3));
      if (unread_.size() - at < kFrameHead_bytes + size) break;
      const absl::string_view payload =
          absl::string_view(unread_).substr(at + kFrameHead_bytes, size);
      if (head[3] == static_cast<char>(FrameType::kWindowUpdate)) {
        Widen(ReadBigEndian(head.substr(5)), ReadBigEndian(payload));
      }
      at += kFrameHead_bytes + size;
    }
    unread_.erase(0, at);
  }

  void Widen(std::uint32_t stream, std::int64_t bytes) {
    const std::size_t call = stream / 2;
    if (stream == 0) {
      window_bytes_ += bytes;
    } else if (call < calls_.size()) {
      calls_[call].window_bytes += bytes;
    }
  }

  void AppendData(int index, std::string& frames) {
    Call& call = calls_[static_cast<std::size_t>(index)];
    while (call.sent_bytes < kSent_bytes) {
      const std::int64_t room =
          std::min({window_bytes_, call.window_bytes, kFrame_bytes,
                    static_cast<std::int64_t>(kSent_bytes - call.sent_bytes)});
      constexpr std::int64_t kPrefix_bytes = 5;  // of a message of gRPC: plain, and how long
      if (room < kPrefix_bytes) return;
      std::string data(static_cast<std::size_t>(room), '\0');
      if (call.sent_bytes == 0) data.replace(1, 4, BigEndian(kRequest_bytes - kPrefix_bytes));
      absl::StrAppend(&frames, Frame(FrameType::kData, 0, StreamOf(index), data));
      call.sent_bytes += data.size();
      call.window_bytes -= room;
      window_bytes_ -= room;
      sent_bytes_ += room;
    }
  }

  std::unique_ptr<RawConnection> connection_;
  std::vector<Call> calls_;
  std::int64_t window_bytes_ = kInitialWindow_bytes;
  std::int64_t sent_bytes_ = 0;
  std::string unread_;
};

absl::StatusOr<std::vector<Bar>> Run(const AttackSettings& settings) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto bed, AttackBed::Start(settings));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto before, bed->server().Usage());
  std::vector<HalfCalls> connections;
  const absl::Time end = absl::Now() + std::max(settings.time, kToSendMuch);
  double refused = 0.0;
  double sent_mb = 0.0;
  while (absl::Now() < end) {
    if (connections.size() < kConnections) {
      PLUMESCOUT_ASSIGN_OR_RETURN(auto connection, RawConnection::Open(bed->target()));
      HalfCalls calls(std::move(connection));
      if (calls.Begin().ok()) connections.push_back(std::move(calls));
    }
    const auto refuses = [&](HalfCalls& calls) {
      const std::int64_t before_bytes = calls.sent_bytes();
      const bool is_open = calls.GoOn().ok();
      constexpr double kMega = 1e6;
      sent_mb += static_cast<double>(calls.sent_bytes() - before_bytes) / kMega;
      refused += is_open ? 0.0 : 1.0;
      return !is_open;
    };
    std::erase_if(connections, refuses);
    absl::SleepFor(absl::Milliseconds(1));
  }
  std::vector<Bar> bars = bed->Judge(bed->Take());
  // Calls of others may end before the attacker's. A front, which knows who calls, sees to that
  // that nobody has so many: a server alone is for networks that one trusts.
  for (Bar& bar : bars) {
    if (absl::EndsWith(bar.name, ", ms") || bar.name == "honest calls failed") bar.limit.reset();
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto after, bed->server().Usage());
  bars.push_back({"grown by, MB", after.peak_rss_mb - before.rss_mb,
                  settings.beside_others ? kMayGrowBesideOthers_mb : kMayGrow_mb});
  bars.push_back({"sent, MB", sent_mb});
  bars.push_back({"connections ended by the server", refused});
  return bars;
}

}  // namespace

Attack HalfRequestsAttack() {
  return {"half_requests", "6,400 calls, of each request all but the last byte",
          "held all that came, 1.6 GB in 6 s", &Run};
}

}  // namespace plumescout::lab
