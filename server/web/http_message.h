// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "absl/strings/string_view.h"

namespace plumescout::server {

struct HttpRequest {
  std::string method;
  std::string path;                            // without what follows '?'
  std::map<std::string, std::string> headers;  // names in lower case
  std::string body;

  // Empty if there is none.
  absl::string_view Header(const std::string& name) const;
};

// What stands at the front of the bytes that came.
struct HttpParse {
  enum class State { kPartial, kWhole, kBad };
  State state = State::kPartial;
  HttpRequest request = {};    // if whole
  std::size_t size = 0;        // bytes that it took
  int code = 0;                // if bad: what to answer ...
  absl::string_view why = {};  // ... in these words
};

inline constexpr std::size_t kMaxHttpHeadBytes = 16'384;

// HTTP/1.1 with bodies of a length that is said before (Content-Length). Bad is also what is larger
// than the limits.
HttpParse ParseHttp(absl::string_view received, std::size_t max_body_bytes);

// The head of an answer, with the headers that make browsers careful: nothing is loaded from, or
// shown inside, other hosts. `length_or_chunked`: a header line for the body's length.
std::string HttpHead(int code, absl::string_view type, absl::string_view caching,
                     absl::string_view length_or_chunked);
// A whole answer.
std::string HttpAnswerOf(int code, absl::string_view type, absl::string_view caching,
                         absl::string_view body);
// The same in words, for people.
std::string HttpRefusal(int code, absl::string_view why);

inline constexpr char kChunked[] = "Transfer-Encoding: chunked";
inline constexpr char kLastChunk[] = "0\r\n\r\n";
// REQUIRES: `data` is not empty.
std::string HttpChunk(absl::string_view data);

}  // namespace plumescout::server
