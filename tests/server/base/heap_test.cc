// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/heap.h"

#include <gtest/gtest.h>
#include <malloc.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <thread>
#include <vector>

#include "absl/synchronization/barrier.h"

namespace plumescout::server {
namespace heap_test {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || defined(__clang__)
constexpr bool kIsTheLibrarys = false;  // sanitizers bring a heap of their own
#else
constexpr bool kIsTheLibrarys = true;
#endif

using Block = std::unique_ptr<void, void (*)(void*)>;

Block Take(std::size_t bytes) { return {std::malloc(bytes), std::free}; }

TEST(HeapTest, LargeBlocksGoBackToTheSystemHoweverLargeOnesWereFreedBefore) {
  if (!kIsTheLibrarys) GTEST_SKIP() << "not the heap of the C library";
  ReturnLargeBlocks();
  Take(std::size_t{24} << 20).reset();
  const auto before = mallinfo2();
  const Block large = Take(std::size_t{2} << 20);
  const auto with = mallinfo2();
  EXPECT_EQ(with.hblks, before.hblks + 1) << "a mapping of its own";
  const Block small = Take(std::size_t{256} << 10);
  EXPECT_EQ(mallinfo2().hblks, with.hblks);
}

// In a process that has no threads yet: how many arenas there are once many threads have allocated.
[[noreturn]] void ExitWithArenas(int threads) {
  LimitArenas();
  {
    absl::Barrier all(threads);
    std::vector<std::thread> running;
    for (int i = 0; i < threads; ++i) {
      running.emplace_back([&all] {
        const Block block = Take(1024);
        all.Block();
      });
    }
    for (std::thread& thread : running) thread.join();
  }
  char* text = nullptr;
  std::size_t size = 0;
  std::FILE* const file = open_memstream(&text, &size);
  malloc_info(0, file);
  std::fclose(file);
  int arenas = 0;
  for (const char* at = text; (at = std::strstr(at, "<heap nr=")) != nullptr; ++at) ++arenas;
  std::_Exit(arenas);
}

class ArenasTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!kIsTheLibrarys) GTEST_SKIP() << "not the heap of the C library";
    const bool is_told = std::getenv("MALLOC_ARENA_MAX") || std::getenv("GLIBC_TUNABLES");
    if (is_told) GTEST_SKIP() << "the environment says how many";
    GTEST_FLAG_SET(death_test_style, "threadsafe");
  }
  const int limit_ = std::max(2, static_cast<int>(std::thread::hardware_concurrency()));
  const int threads_ = limit_ + 3;
};

TEST_F(ArenasTest, ThreadsShareOneForEachCore) {
  EXPECT_EXIT(ExitWithArenas(threads_), testing::ExitedWithCode(limit_), "");
}

TEST_F(ArenasTest, TheEnvironmentGoesFirst) {
  const auto more = [this](int status) {
    return WIFEXITED(status) && WEXITSTATUS(status) > limit_;
  };
  const auto exit_with = [this](const char* name, const char* value) {
    setenv(name, value, 1);  // too late for the library to heed
    ExitWithArenas(threads_);
  };
  EXPECT_EXIT(exit_with("MALLOC_ARENA_MAX", "9"), more, "");
  EXPECT_EXIT(exit_with("GLIBC_TUNABLES", "glibc.malloc.arena_max=9"), more, "");
}

}  // namespace heap_test
}  // namespace plumescout::server
