#include "common/dds/convert.hpp"

#include <gtest/gtest.h>

#include "common/dds/type_support.hpp"
#include "tests/support/tile_octets.hpp"
#include "tests/unit/dds/message_fields.hpp"

namespace lifeline::dds {
namespace {

template <typename Message>
class Convert : public ::testing::Test {};

using Messages =
    ::testing::Types<wire::HelmetPose, wire::HelmetScan, wire::TsdTile, wire::TileRequest,
                     wire::TileCopy, wire::MergeDirective, wire::DirectiveCopy, wire::MergeEvidence,
                     wire::AgentStatus, wire::Detection, wire::Alert>;
TYPED_TEST_SUITE(Convert, Messages);

TYPED_TEST(Convert, every_field_comes_back) {
  const auto message = test::filled<TypeParam>();
  ASSERT_TRUE(test::all_differ(message, TypeParam()));
  typename TypeSupportOf<TypeParam>::Idl sample;

  ASSERT_TRUE(to_idl(message, sample));

  EXPECT_TRUE(test::same(from_idl(sample), message));
}

TYPED_TEST(Convert, a_reused_sample_keeps_nothing_of_the_last_message) {
  typename TypeSupportOf<TypeParam>::Idl sample;
  ASSERT_TRUE(to_idl(test::filled<TypeParam>(), sample));

  ASSERT_TRUE(to_idl(TypeParam(), sample));

  EXPECT_TRUE(test::same(from_idl(sample), TypeParam()));
}

TYPED_TEST(Convert, every_field_survives_the_wire) {
  TypeSupportOf<TypeParam> type;
  const auto message = test::filled<TypeParam>();
  SampleOf<TypeParam> sent, received;
  ASSERT_TRUE(to_idl(message, sent.value));
  rtps::SerializedPayload_t payload(type.m_typeSize);

  ASSERT_TRUE(type.serialize(&sent, &payload));
  ASSERT_TRUE(type.deserialize(&payload, &received));

  EXPECT_TRUE(received.decodable);
  EXPECT_TRUE(test::same(from_idl(received.value), message));
}

TEST(TileOctets, count_what_the_middleware_writes) {
  for (const std::size_t size : {1U, 9U, 10U, 11U, 12U, 500U, 1000U}) {
    auto message = test::filled<wire::TsdTile>();
    message.payload.assign(size, 7);
    message.layer.agent_id.resize(1 + size % 7, 'x');
    TypeSupportOf<wire::TsdTile> type;
    SampleOf<wire::TsdTile> sample;
    ASSERT_TRUE(to_idl(message, sample.value));
    rtps::SerializedPayload_t payload(type.m_typeSize);
    ASSERT_TRUE(type.serialize(&sample, &payload));
    EXPECT_EQ(payload.length, test::tile_octets(message)) << size;
  }
}

TEST(ConvertEnum, a_wide_unknown_value_does_not_become_a_known_one) {
  msg::AgentStatus sample;
  sample.role(static_cast<msg::Role>(0x10000));

  EXPECT_EQ(static_cast<int>(from_idl(sample).role), 255);
}

}  // namespace
}  // namespace lifeline::dds
