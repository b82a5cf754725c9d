#include "common/ros2/cdr_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/recordings.hpp"

namespace lifeline::ros2 {
namespace {

using test::Encoding;
using test::MessageWriter;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

using Bytes = std::vector<std::uint8_t>;

TEST(CdrReader, ReadsAlignedFieldsInBothByteOrders) {
  for (const Encoding encoding : {Encoding::cdr_little, Encoding::cdr_big}) {
    const Bytes bytes = MessageWriter(encoding)
                            .add(std::uint8_t{7})
                            .add(std::int32_t{-5})
                            .add(std::uint8_t{8})
                            .add(2.5)
                            .add(std::uint16_t{513})
                            .add(1.25F)
                            .bytes();
    auto reader = CdrReader::open_cdr(bytes);
    ASSERT_TRUE(reader);
    EXPECT_EQ(reader->read<std::uint8_t>(), 7);
    EXPECT_EQ(reader->read<std::int32_t>(), -5);
    EXPECT_EQ(reader->read<std::uint8_t>(), 8);
    EXPECT_EQ(reader->read<double>(), 2.5);
    EXPECT_EQ(reader->read<std::uint16_t>(), 513);
    EXPECT_EQ(reader->read<float>(), 1.25F);
    EXPECT_TRUE(reader->ok());
  }
}

TEST(CdrReader, TakesBytesAsTheStandardLaysThemOut) {
  // little-endian: u8 1, three bytes of padding, u32 2, text "ab" with its zero, padding, float 1
  const Bytes bytes{0, 1, 0, 0, 1,   0,   0, 0, 2, 0, 0,    0,
                    3, 0, 0, 0, 'a', 'b', 0, 0, 0, 0, 0x80, 0x3f};
  auto reader = CdrReader::open_cdr(bytes);
  ASSERT_TRUE(reader);
  EXPECT_EQ(reader->read<std::uint8_t>(), 1);
  EXPECT_EQ(reader->read<std::uint32_t>(), 2U);
  reader->skip_text();
  EXPECT_EQ(reader->read<float>(), 1.0F);
  EXPECT_TRUE(reader->ok());
}

TEST(CdrReader, ReadsRos1FieldsWithoutPadding) {
  const Bytes bytes = MessageWriter(Encoding::ros1)
                          .add(std::uint8_t{1})
                          .add_text("abc")
                          .add(std::uint32_t{9})
                          .bytes();
  EXPECT_EQ(bytes.size(), 12U);
  CdrReader reader = CdrReader::open_ros1(bytes);
  EXPECT_EQ(reader.read<std::uint8_t>(), 1);
  reader.skip_text();
  EXPECT_EQ(reader.read<std::uint32_t>(), 9U);
  EXPECT_TRUE(reader.ok());
}

TEST(CdrReader, ReadsAndSkipsSequencesOfFloats) {
  const Bytes bytes = MessageWriter(Encoding::cdr_little)
                          .add_floats({1.0F, 2.0F})
                          .add_floats({3.0F})
                          .add_floats({4.0F})
                          .bytes();
  auto reader = CdrReader::open_cdr(bytes);
  ASSERT_TRUE(reader);
  EXPECT_THAT(reader->read_floats(2), ElementsAre(1.0F, 2.0F));
  reader->skip_floats();
  EXPECT_THAT(reader->read_floats(10), ElementsAre(4.0F));
  EXPECT_TRUE(reader->ok());
}

TEST(CdrReader, RefusesEncapsulationsOtherThanPlainCdr) {
  for (const Bytes& bytes : {Bytes{0, 2, 0, 0}, Bytes{0, 7, 0, 0}, Bytes{1, 1, 0, 0}}) {
    const auto reader = CdrReader::open_cdr(bytes);
    ASSERT_FALSE(reader);
    EXPECT_EQ(reader.error().text,
              fmt::format("encapsulation 0x{:02x}{:02x} is not plain CDR", bytes[0], bytes[1]));
  }
  const auto reader = CdrReader::open_cdr(Bytes{0, 1, 0});
  ASSERT_FALSE(reader);
  EXPECT_EQ(reader.error().text, "3 bytes are too few for a message");
}

TEST(CdrReader, ReadsZeroAndStaysFailedBeyondTheEnd) {
  const Bytes bytes{0, 1, 0, 0, 1, 2, 3};
  auto reader = CdrReader::open_cdr(bytes);
  ASSERT_TRUE(reader);
  EXPECT_EQ(reader->read<std::uint32_t>(), 0U);
  EXPECT_FALSE(reader->ok());
  EXPECT_EQ(reader->read<std::uint8_t>(), 0);  // there is a byte, but the message is lost
  EXPECT_FALSE(reader->ok());
}

TEST(CdrReader, RefusesASequenceLongerThanAllowedOrThanItsBytes) {
  const Bytes three = MessageWriter(Encoding::cdr_little).add_floats({1, 2, 3}).bytes();
  auto reader = CdrReader::open_cdr(three);
  ASSERT_TRUE(reader);
  EXPECT_THAT(reader->read_floats(2), IsEmpty());
  EXPECT_FALSE(reader->ok());

  const Bytes claims = MessageWriter(Encoding::cdr_little).add(0xffffffffU).add(1.0F).bytes();
  for (const bool skip : {false, true}) {
    auto liar = CdrReader::open_cdr(claims);
    ASSERT_TRUE(liar);
    if (skip) liar->skip_floats();
    if (!skip) {
      EXPECT_THAT(liar->read_floats(SIZE_MAX), IsEmpty());
    }
    EXPECT_FALSE(liar->ok());
  }
}

TEST(CdrReader, RefusesATextLongerThanItsBytes) {
  const Bytes bytes = MessageWriter(Encoding::cdr_little).add(100U).add(1U).bytes();
  auto reader = CdrReader::open_cdr(bytes);
  ASSERT_TRUE(reader);
  reader->skip_text();
  EXPECT_FALSE(reader->ok());
}

}  // namespace
}  // namespace lifeline::ros2
