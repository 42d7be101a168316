// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/web/http_message.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "absl/strings/ascii.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"

namespace plumescout::server {
namespace {

constexpr char kLineEnd[] = "\r\n";
constexpr char kHeadEnd[] = "\r\n\r\n";
constexpr char kText[] = "text/plain; charset=utf-8";

// What a page of ours may load, and from where: from here.
constexpr char kCarefulHeaders[] =
    "Content-Security-Policy: default-src 'none'; script-src 'self'; style-src 'self'; "
    "img-src 'self' data: blob:; connect-src 'self'; base-uri 'none'; form-action 'none'; "
    "frame-ancestors 'none'\r\n"
    "X-Content-Type-Options: nosniff\r\n"
    "Referrer-Policy: no-referrer\r\n"
    "Cross-Origin-Opener-Policy: same-origin\r\n"
    "Cross-Origin-Resource-Policy: same-origin\r\n";

HttpParse Bad(int code, absl::string_view why) {
  HttpParse parse;
  parse.state = HttpParse::State::kBad;
  parse.code = code;
  parse.why = why;
  return parse;
}

absl::string_view Phrase(int code) {
  switch (code) {
    case 200:
      return "OK";
    case 304:
      return "Not Modified";
    case 400:
      return "Bad Request";
    case 403:
      return "Forbidden";
    case 404:
      return "Not Found";
    case 405:
      return "Method Not Allowed";
    case 411:
      return "Length Required";
    case 413:
      return "Payload Too Large";
    case 415:
      return "Unsupported Media Type";
    case 431:
      return "Request Header Fields Too Large";
    default:
      return "Not Implemented";
  }
}

// Tabs do not count.
bool HasControls(absl::string_view text) {
  return std::any_of(text.begin(), text.end(), [](char c) {
    return absl::ascii_iscntrl(static_cast<unsigned char>(c)) && c != '\t';
  });
}

// False if a line is no header, or a header that matters comes twice.
bool ReadHeaders(absl::string_view lines, HttpRequest& request) {
  for (const absl::string_view line : absl::StrSplit(lines, kLineEnd, absl::SkipEmpty())) {
    const std::pair<absl::string_view, absl::string_view> field =
        absl::StrSplit(line, absl::MaxSplits(':', 1));
    if (field.first.size() == line.size() || field.first.empty() || HasControls(line)) return false;
    if (field.first.find_first_of(" \t") != absl::string_view::npos) return false;
    const bool is_new = request.headers
                            .emplace(absl::AsciiStrToLower(field.first),
                                     std::string(absl::StripAsciiWhitespace(field.second)))
                            .second;
    if (!is_new) return false;
  }
  return true;
}

bool ReadRequestLine(absl::string_view line, HttpRequest& request) {
  if (HasControls(line)) return false;
  const std::vector<absl::string_view> words = absl::StrSplit(line, ' ');
  if (words.size() != 3 || words[2] != "HTTP/1.1" || words[1].empty() || words[1][0] != '/') {
    return false;
  }
  request.method = std::string(words[0]);
  request.path = std::string(words[1].substr(0, words[1].find('?')));
  return true;
}

// Digits alone: whoever else reads the request must find the same end of it.
bool ReadLength(absl::string_view text, std::size_t& length) {
  return std::all_of(text.begin(), text.end(), absl::ascii_isdigit) &&
         absl::SimpleAtoi(text, &length);
}

}  // namespace

absl::string_view HttpRequest::Header(const std::string& name) const {
  const auto it = headers.find(name);
  return it == headers.end() ? absl::string_view() : absl::string_view(it->second);
}

HttpParse ParseHttp(absl::string_view received, std::size_t max_body_bytes) {
  const std::size_t head_end = received.find(kHeadEnd);
  if (head_end == absl::string_view::npos) {
    return received.size() < kMaxHttpHeadBytes ? HttpParse() : Bad(431, "the head is too large");
  }
  if (head_end >= kMaxHttpHeadBytes) return Bad(431, "the head is too large");
  const absl::string_view head = received.substr(0, head_end);
  const std::size_t line_end = head.find(kLineEnd);
  const absl::string_view lines =
      line_end == absl::string_view::npos ? absl::string_view() : head.substr(line_end);
  HttpParse parse;
  if (!ReadRequestLine(head.substr(0, line_end), parse.request) ||
      !ReadHeaders(lines, parse.request)) {
    return Bad(400, "no HTTP/1.1 request");
  }
  if (parse.request.headers.count("transfer-encoding") > 0) {
    return Bad(411, "bodies need a Content-Length");
  }
  std::size_t length = 0;
  if (parse.request.headers.count("content-length") > 0 &&
      !ReadLength(parse.request.Header("content-length"), length)) {
    return Bad(400, "bad Content-Length");
  }
  if (length > max_body_bytes) return Bad(413, "the body is too large");
  parse.size = head_end + sizeof(kHeadEnd) - 1 + length;
  if (received.size() < parse.size) return HttpParse();
  parse.state = HttpParse::State::kWhole;
  parse.request.body = std::string(received.substr(parse.size - length, length));
  return parse;
}

std::string HttpHead(int code, absl::string_view type, absl::string_view caching,
                     absl::string_view length_or_chunked) {
  return absl::StrCat("HTTP/1.1 ", code, " ", Phrase(code), "\r\nContent-Type: ", type,
                      "\r\nCache-Control: ", caching, "\r\n", kCarefulHeaders, length_or_chunked,
                      kHeadEnd);
}

std::string HttpAnswerOf(int code, absl::string_view type, absl::string_view caching,
                         absl::string_view body) {
  return absl::StrCat(HttpHead(code, type, caching, absl::StrCat("Content-Length: ", body.size())),
                      body);
}

std::string HttpRefusal(int code, absl::string_view why) {
  return HttpAnswerOf(code, kText, "no-store", absl::StrCat(why, "\n"));
}

std::string HttpChunk(absl::string_view data) {
  return absl::StrCat(absl::Hex(data.size()), kLineEnd, data, kLineEnd);
}

}  // namespace plumescout::server
