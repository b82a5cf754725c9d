#include "common/base/sha256.hpp"

#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace lifeline {
namespace {

std::span<const std::uint8_t> octets(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

std::string hash(std::string_view text) {
  return to_hex(Sha256().add(octets(text)).finish());
}

// FIPS 180-4, the examples of NIST.
TEST(Sha256, GivesTheKnownDigests) {
  EXPECT_EQ(hash(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(hash("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(hash("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(hash(std::string(1'000'000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, PiecesCountAsTheWhole) {
  EXPECT_EQ(Sha256().add(octets("a")).add(octets("bc")).finish(),
            Sha256().add(octets("abc")).finish());
}

TEST(Sha256, IntegersGoInLeastOctetFirst) {
  EXPECT_EQ(Sha256().add_integer(0x0102030405060708U).finish(),
            Sha256().add(octets("\x08\x07\x06\x05\x04\x03\x02\x01")).finish());
}

TEST(Sha256, NeighbouringTextsDoNotRunTogether) {
  EXPECT_NE(Sha256().add_text("ab").add_text("c").finish(),
            Sha256().add_text("a").add_text("bc").finish());
}

TEST(ToHex, WritesTwoDigitsForEachOctet) {
  EXPECT_EQ(to_hex(std::vector<std::uint8_t>{0x00, 0x0f, 0xa0, 0xff}), "000fa0ff");
  EXPECT_EQ(to_hex({}), "");
}

}  // namespace
}  // namespace lifeline
