#include "tanglebin/dataset/sha256.hpp"

#include <gtest/gtest.h>

#include <string>

namespace tanglebin {
namespace {

// NIST's example values for FIPS 180-4: csrc.nist.gov/projects/cryptographic-standards-and-guidelines.

TEST(Sha256, OfNothing) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(Sha256, OfOneBlock) {
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Sha256, OfTwoBlocks) {
  EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
}

TEST(Sha256, OfAMillionBytes) {
  EXPECT_EQ(sha256(std::string(1000000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, BytesAreBinary) {
  EXPECT_NE(sha256(std::string("a\0b", 3)), sha256("a"));
}

TEST(Sha256, OfBytesThatComePieceByPieceIsThatOfAllOfThem) {
  Sha256 hash;
  std::string all;
  for (int piece = 0; piece < 100; ++piece) {
    const std::string bytes(static_cast<std::size_t>(piece), static_cast<char>(piece));
    hash.add(bytes);
    all += bytes;
    EXPECT_EQ(hash.hex(), sha256(all));  // and it goes on after that
  }
}

}  // namespace
}  // namespace tanglebin
