// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/web/http_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace plumescout::server {
namespace http_message_test {

using ::testing::HasSubstr;
using State = HttpParse::State;

constexpr std::size_t kMaxBody = 10;

TEST(HttpMessage, RequestIsTakenOnceItIsWhole) {
  const std::string text = "POST /a/B?c HTTP/1.1\r\nHost: x:1\r\nContent-LENGTH:  3 \r\n\r\nxyz";
  for (std::size_t size = 0; size < text.size(); ++size) {
    EXPECT_EQ(ParseHttp(text.substr(0, size), kMaxBody).state, State::kPartial) << size;
  }
  const HttpParse parse = ParseHttp(text + "GET /", kMaxBody);
  ASSERT_EQ(parse.state, State::kWhole);
  EXPECT_EQ(parse.size, text.size());
  EXPECT_EQ(parse.request.method, "POST");
  EXPECT_EQ(parse.request.path, "/a/B");
  EXPECT_EQ(parse.request.Header("host"), "x:1");
  EXPECT_EQ(parse.request.Header("origin"), "");
  EXPECT_EQ(parse.request.body, "xyz");
}

TEST(HttpMessage, HeadersAreNotNeeded) {
  EXPECT_EQ(ParseHttp("GET / HTTP/1.1\r\n\r\n", kMaxBody).state, State::kWhole);
}

TEST(HttpMessage, WhatIsNoRequestIsBad) {
  for (const char* text :
       {"\r\n\r\n", "GET /\r\n\r\n", "GET / HTTP/1.0\r\n\r\n", "GET http://x/ HTTP/1.1\r\n\r\n",
        "GET / HTTP/1.1\r\nno header\r\n\r\n", "GET / HTTP/1.1\r\n: x\r\n\r\n",
        "GET / HTTP/1.1\r\na : x\r\n\r\n", "GET / HTTP/1.1\r\na: 1\r\nA: 2\r\n\r\n",
        "GET / HTTP/1.1\r\nContent-Length: -1\r\n\r\n",
        "GET / HTTP/1.1\r\nContent-Length: 1x\r\n\r\n",
        "GET / HTTP/1.1\r\nContent-Length: +5\r\n\r\n",
        "GET / HTTP/1.1\r\nContent-Length: 1 1\r\n\r\n",
        "GET / HTTP/1.1\r\nContent-Length:\r\n\r\n", "GET / HTTP/1.1\r\na: x\nb: y\r\n\r\n",
        "GET / HTTP/1.1\r\na: x\ry\r\n\r\n", "GET / HTTP/1.1\r\na: \x01\r\n\r\n",
        "GET / HTTP/1.1\r\na: \x7f\r\n\r\n", "GET /\x01 HTTP/1.1\r\n\r\n"}) {
    const HttpParse parse = ParseHttp(text, kMaxBody);
    EXPECT_EQ(parse.state, State::kBad) << text;
    EXPECT_EQ(parse.code, 400) << text;
  }
}

TEST(HttpMessage, NulIsNoPartOfARequest) {
  const std::string text("GET / HTTP/1.1\r\na: x\0y\r\n\r\n", 26);
  EXPECT_EQ(ParseHttp(text, kMaxBody).code, 400);
}

TEST(HttpMessage, TabsMayStandInHeaders) {
  EXPECT_EQ(ParseHttp("GET / HTTP/1.1\r\na:\tx\ty\r\n\r\n", kMaxBody).request.Header("a"), "x\ty");
}

TEST(HttpMessage, BodiesAreBounded) {
  EXPECT_EQ(ParseHttp("POST / HTTP/1.1\r\nContent-Length: 10\r\n\r\n", kMaxBody).state,
            State::kPartial);
  EXPECT_EQ(ParseHttp("POST / HTTP/1.1\r\nContent-Length: 11\r\n\r\n", kMaxBody).code, 413);
  EXPECT_EQ(ParseHttp("POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n", kMaxBody).code, 411);
  EXPECT_EQ(ParseHttp("POST / HTTP/1.1\r\nTransfer-Encoding:\r\n\r\n", kMaxBody).code, 411);
}

TEST(HttpMessage, HeadsAreBounded) {
  const std::string head = "GET / HTTP/1.1\r\na: " + std::string(kMaxHttpHeadBytes, 'x');
  EXPECT_EQ(ParseHttp(head, kMaxBody).code, 431);
  EXPECT_EQ(ParseHttp(head + "\r\n\r\n", kMaxBody).code, 431);
}

TEST(HttpMessage, AnswersKeepPagesToThisHost) {
  const std::string answer = HttpAnswerOf(200, "text/html", "no-cache", "<p>");
  EXPECT_THAT(answer, ::testing::StartsWith("HTTP/1.1 200 OK\r\nContent-Type: text/html\r\n"));
  EXPECT_THAT(answer, ::testing::EndsWith("Content-Length: 3\r\n\r\n<p>"));
  EXPECT_THAT(answer, HasSubstr("\r\nContent-Security-Policy: default-src 'none'; "));
  EXPECT_THAT(answer, HasSubstr("\r\nCache-Control: no-cache\r\n"));
  EXPECT_THAT(HttpRefusal(404, "no such file"), ::testing::EndsWith("\r\n\r\nno such file\n"));
}

TEST(HttpMessage, ChunksSayTheirSizeInHexadecimal) {
  EXPECT_EQ(HttpChunk(std::string(26, 'x')), "1a\r\n" + std::string(26, 'x') + "\r\n");
}

}  // namespace http_message_test
}  // namespace plumescout::server
