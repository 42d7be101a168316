// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/access/token_file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "tests/server/token_line.h"
#include "tests/support/temp_folder.h"

namespace plumescout::server {
namespace token_file_test {

using ::testing::EndsWith;
using ::testing::HasSubstr;

const absl::Time kNow = absl::FromUnixSeconds(1'800'000'000);

class TokenFileTest : public testing::Test {
 protected:
  void Write(const std::string& text) { std::ofstream(path_) << text; }
  // In the file as it is now.
  absl::StatusOr<Principal> Find(TokenFile& file, const std::string& token) {
    file.Look();
    return file.Find(token, kNow);
  }

  TempFolder folder_;
  const std::string path_ = folder_.File("tokens");
};

TEST_F(TokenFileTest, HashIsSha256) {
  const Sha256 hash = HashOf("abc");
  EXPECT_EQ(absl::BytesToHexString({reinterpret_cast<const char*>(hash.data()), hash.size()}),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST_F(TokenFileTest, ATokenSaysWhoseItIs) {
  Write(absl::StrCat("# tokens\n\n", TokenLine("secret-a", "alice operator acme never"),
                     TokenLine("secret-s", "scout robot - 2100-01-01T00:00:00Z")));
  const auto file = TokenFile::Open(path_);
  ASSERT_TRUE(file.ok()) << file.status();
  EXPECT_EQ(*Find(**file, "secret-a"), (Principal{"alice", "acme", Role::kOperator, false}));
  EXPECT_EQ(*Find(**file, "secret-s"), (Principal{"scout", "", Role::kRobot, true}));
  for (const char* wrong : {"", "secret", "secret-A", "secret-a ", "secret-aa"}) {
    EXPECT_EQ(Find(**file, wrong).status(), absl::UnauthenticatedError("the token is not known"));
  }
  EXPECT_FALSE(Find(**file, std::string(100'000, 'a')).ok());
}

TEST_F(TokenFileTest, ATokenExpires) {
  Write(TokenLine("secret", absl::StrCat("alice viewer - ", absl::FormatTime(kNow))));
  const auto file = TokenFile::Open(path_);
  ASSERT_TRUE(file.ok()) << file.status();
  EXPECT_TRUE((*file)->Find("secret", kNow - absl::Seconds(1)).ok());
  EXPECT_EQ((*file)->Find("secret", kNow).status(),
            absl::UnauthenticatedError("the token has expired"));
}

TEST_F(TokenFileTest, WhatIsRevokedOrAddedIsSoAtTheNextLook) {
  const std::string alice = TokenLine("secret-a", "alice operator acme never");
  const std::string bob = TokenLine("secret-b", "bob operator acme never");
  Write(alice);
  const auto file = TokenFile::Open(path_);
  ASSERT_TRUE(file.ok()) << file.status();
  for (int i = 0; i < 3; ++i) {
    Write(absl::StrCat(alice, bob));
    EXPECT_TRUE(Find(**file, "secret-b").ok());
    Write(alice);
    EXPECT_FALSE(Find(**file, "secret-b").ok());
    EXPECT_TRUE(Find(**file, "secret-a").ok());
  }
  std::filesystem::remove(path_);
  EXPECT_FALSE(Find(**file, "secret-a").ok());
  Write(alice);
  EXPECT_TRUE(Find(**file, "secret-a").ok());
}

TEST_F(TokenFileTest, AFileThatIsReplacedIsReadAgain) {
  Write(TokenLine("secret-a", "alice operator acme never"));
  const auto file = TokenFile::Open(path_);
  ASSERT_TRUE(file.ok()) << file.status();
  const std::string other = folder_.File("other");
  std::ofstream(other) << TokenLine("secret-b", "alice operator acme never");  // the same size
  std::filesystem::rename(other, path_);
  EXPECT_FALSE(Find(**file, "secret-a").ok());
  EXPECT_TRUE(Find(**file, "secret-b").ok());
}

TEST_F(TokenFileTest, NobodyNeedsToTellItToLook) {
  Write(TokenLine("secret-a", "alice operator acme never"));
  const auto file = TokenFile::Open(path_);
  ASSERT_TRUE(file.ok()) << file.status();
  Write(TokenLine("secret-b", "bob operator acme never"));
  while (!(*file)->Find("secret-b", kNow).ok()) std::this_thread::yield();
  EXPECT_FALSE((*file)->Find("secret-a", kNow).ok());
}

// A pipe that nobody writes to stands for a disk that does not answer.
TEST_F(TokenFileTest, WhoeverAsksWaitsForNoDisk) {
  Write(TokenLine("secret-a", "alice operator acme never"));
  const auto file = TokenFile::Open(path_);
  ASSERT_TRUE(file.ok()) << file.status();
  const std::string pipe = folder_.File("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::filesystem::remove(path_);
  std::filesystem::create_hard_link(pipe, path_);
  (*file)->Find("secret-a", kNow).status().IgnoreError();  // would hang

  const std::string other = folder_.File("other");
  std::ofstream(other) << TokenLine("secret-b", "bob operator acme never");
  std::filesystem::rename(other, path_);
  while (!(*file)->Find("secret-b", kNow).ok()) {
    const int end = open(pipe.c_str(), O_WRONLY | O_NONBLOCK);  // sends away who reads it
    if (end >= 0) close(end);
    std::this_thread::yield();
  }
}

TEST_F(TokenFileTest, ASpoiltLineHoldsNoTokenAndHarmsNoOther) {
  const std::string alice = TokenLine("secret-a", "alice operator acme never");
  Write(alice);
  const auto file = TokenFile::Open(path_);
  ASSERT_TRUE(file.ok()) << file.status();
  Write(absl::StrCat("rubbish\n", TokenLine("secret-b", "bob king acme never"), alice));
  EXPECT_TRUE(Find(**file, "secret-a").ok());
  EXPECT_FALSE(Find(**file, "secret-b").ok());
}

TEST_F(TokenFileTest, AFileThatIsWrongFromTheBeginningIsRefused) {
  EXPECT_TRUE(absl::IsNotFound(TokenFile::Open(path_).status()));
  Write(absl::StrCat(TokenLine("secret", "alice operator acme never"), "\nrubbish\n"));
  EXPECT_THAT(std::string(TokenFile::Open(path_).status().message()),
              EndsWith(":3: must be HASH NAME ROLE TENANT EXPIRY"));
}

TEST_F(TokenFileTest, ErrorsOfALineSayWhatIsWrong) {
  const auto error_of = [](const std::string& line) {
    return std::string(ParseTokenLine(line).status().message());
  };
  const std::string hash(64, 'a');
  EXPECT_THAT(error_of("abc alice viewer - never"), HasSubstr("64 hexadecimal digits"));
  EXPECT_THAT(error_of(hash + " alice king - never"), HasSubstr("role \"king\""));
  EXPECT_THAT(error_of(hash + " Scout robot - never"), HasSubstr("name = \"Scout\""));
  EXPECT_THAT(error_of(hash + " alice viewer - tomorrow"), HasSubstr("expiry \"tomorrow\""));
  EXPECT_THAT(error_of(hash + " alice viewer never"), HasSubstr("HASH NAME ROLE TENANT EXPIRY"));
  EXPECT_EQ(error_of(hash + "\talice viewer  -  never"), "");
}

}  // namespace token_file_test
}  // namespace plumescout::server
