// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What browsers send: HTTP as it comes, and gRPC-Web in it.

#include <cstdint>

#include "absl/strings/string_view.h"
#include "server/web/grpc_web.h"
#include "server/web/http_message.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kMaxBody_bytes = 4096;
  const absl::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto parse = plumescout::server::ParseHttp(bytes, kMaxBody_bytes);
  using State = plumescout::server::HttpParse::State;
  if (parse.state == State::kWhole) {
    if (parse.size > size || parse.request.body.size() > kMaxBody_bytes) __builtin_trap();
    plumescout::server::FindWebMethod(parse.request.path);
    plumescout::server::MessageOfBody(parse.request.body);
    plumescout::server::ParseGrpcTimeout(parse.request.Header("grpc-timeout"));
  }
  plumescout::server::FindWebMethod(bytes);
  plumescout::server::ParseGrpcTimeout(bytes);
  // A frame is read as what it was made of.
  const auto message = plumescout::server::MessageOfBody(plumescout::server::MessageFrame(bytes));
  if (!message || *message != bytes) __builtin_trap();
  return 0;
}
