#include "core/checksum.h"

#include <gtest/gtest.h>

#include <vector>

namespace nacre {
namespace {

std::vector<std::byte> some_bytes(std::size_t count) {
  std::vector<std::byte> bytes(count);
  for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::byte>((7 * i + 3) & 255);
  return bytes;
}

// Computed with libxxhash 0.8.1 from the same bytes.
TEST(Checksum, IsXxh64) {
  EXPECT_EQ(xxh64({}), 0xef46db3751d8e999ULL);
  EXPECT_EQ(xxh64(some_bytes(1)), 0x1f25c8d0bc1f4bb6ULL);
  EXPECT_EQ(xxh64(some_bytes(14), 1), 0xb2f6c1644fefe871ULL);
  EXPECT_EQ(xxh64(some_bytes(222)), 0x8488aa61fc67f7ebULL);
  EXPECT_EQ(xxh64(some_bytes(100), 2654435761), 0x86f549ede5ac87e2ULL);
}

TEST(Checksum, GoesToTextAndBack) {
  std::uint64_t back = 0;
  ASSERT_TRUE(parse_checksum(checksum_text(0x0123456789abcdefULL), back));
  EXPECT_EQ(back, 0x0123456789abcdefULL);
  EXPECT_EQ(checksum_text(0xf), "000000000000000f");
}

TEST(Checksum, RefusesOtherText) {
  std::uint64_t untouched = 7;
  for (const char* text :
       {"", "123", "0123456789abcdeg", "0123456789ABCDEF", "0123456789abcdef0"}) {
    EXPECT_FALSE(parse_checksum(text, untouched)) << text;
  }
  EXPECT_EQ(untouched, 7u);
}

}  // namespace
}  // namespace nacre
