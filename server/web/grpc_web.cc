// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/web/grpc_web.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "absl/strings/escaping.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/strip.h"
#include "google/protobuf/descriptor.h"
#include "server/access/rpc.h"

namespace plumescout::server {
namespace {

constexpr char kPackage[] = "plumescout.v1.";
constexpr char kPlain = 0;
constexpr char kTrailers = static_cast<char>(0x80);
constexpr std::size_t kMaxTimeoutDigits = 8;

std::string Frame(char flags, absl::string_view data) {
  const auto size = static_cast<std::uint32_t>(data.size());
  const char prefix[kGrpcWebPrefixBytes] = {flags, static_cast<char>(size >> 24),
                                            static_cast<char>(size >> 16),
                                            static_cast<char>(size >> 8), static_cast<char>(size)};
  return absl::StrCat(absl::string_view(prefix, kGrpcWebPrefixBytes), data);
}

// As gRPC writes messages of statuses: what is not visible ASCII, and '%', as %XX.
std::string PercentEncoded(absl::string_view text) {
  std::string encoded;
  for (const char c : text) {
    if (c >= ' ' && c <= '~' && c != '%') {
      encoded += c;
    } else {
      absl::StrAppend(&encoded, "%", absl::Hex(static_cast<unsigned char>(c), absl::kZeroPad2));
    }
  }
  return encoded;
}

bool TakesOneRequest(const RpcRow& row, bool& is_stream) {
  const google::protobuf::ServiceDescriptor* const service =
      google::protobuf::DescriptorPool::generated_pool()->FindServiceByName(
          absl::StrCat(kPackage, row.service));
  if (service == nullptr) return false;
  const google::protobuf::MethodDescriptor* const method =
      service->FindMethodByName(std::string(row.method));
  if (method == nullptr || method->client_streaming()) return false;
  is_stream = method->server_streaming();
  return true;
}

std::optional<absl::Duration> UnitOfTimeout(char letter) {
  switch (letter) {
    case 'H':
      return absl::Hours(1);
    case 'M':
      return absl::Minutes(1);
    case 'S':
      return absl::Seconds(1);
    case 'm':
      return absl::Milliseconds(1);
    case 'u':
      return absl::Microseconds(1);
    case 'n':
      return absl::Nanoseconds(1);
    default:
      return std::nullopt;
  }
}

}  // namespace

std::optional<WebMethod> FindWebMethod(absl::string_view path) {
  for (const RpcRow& row : RpcTable()) {
    WebMethod method{absl::StrCat("/", kPackage, row.service, "/", row.method)};
    if (path != method.path) continue;
    if (!TakesOneRequest(row, method.is_stream)) return std::nullopt;
    return method;
  }
  return std::nullopt;
}

std::optional<std::string> MessageOfBody(absl::string_view body) {
  if (body.size() < kGrpcWebPrefixBytes || body[0] != kPlain) return std::nullopt;
  std::size_t size = 0;
  for (int i = 1; i < kGrpcWebPrefixBytes; ++i) {
    size = size << 8 | static_cast<unsigned char>(body[static_cast<std::size_t>(i)]);
  }
  if (size != body.size() - kGrpcWebPrefixBytes) return std::nullopt;
  return std::string(body.substr(kGrpcWebPrefixBytes));
}

std::string MessageFrame(absl::string_view message) { return Frame(kPlain, message); }

std::string TrailerFrame(const grpc::Status& status) {
  std::string trailers =
      absl::StrCat("grpc-status: ", static_cast<int>(status.error_code()), "\r\n");
  if (!status.error_message().empty()) {
    absl::StrAppend(&trailers, "grpc-message: ", PercentEncoded(status.error_message()), "\r\n");
  }
  if (!status.error_details().empty()) {
    absl::StrAppend(
        &trailers, "grpc-status-details-bin: ", absl::Base64Escape(status.error_details()), "\r\n");
  }
  return Frame(kTrailers, trailers);
}

std::optional<absl::Duration> ParseGrpcTimeout(absl::string_view text) {
  if (text.size() < 2 || text.size() > kMaxTimeoutDigits + 1) return std::nullopt;
  std::int64_t count = 0;
  if (!absl::SimpleAtoi(text.substr(0, text.size() - 1), &count) || count < 0) return std::nullopt;
  const std::optional<absl::Duration> unit = UnitOfTimeout(text.back());
  if (!unit) return std::nullopt;
  return std::min(count * *unit, kMaxGrpcTimeout);
}

}  // namespace plumescout::server
