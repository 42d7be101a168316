// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/heap.h"

#include <gtest/gtest.h>
#include <malloc.h>

#include <cstddef>
#include <cstdlib>
#include <memory>

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

}  // namespace heap_test
}  // namespace plumescout::server
