#include "common/dds/cdr_samples.hpp"

#include <gtest/gtest.h>

#include "tests/unit/dds/message_fields.hpp"

namespace lifeline::dds {
namespace {

template <typename Message>
class CdrSamples : public ::testing::Test {};

using Messages =
    ::testing::Types<wire::HelmetPose, wire::HelmetScan, wire::TsdTile, wire::TileRequest,
                     wire::TileCopy, wire::MergeDirective, wire::DirectiveCopy, wire::MergeEvidence,
                     wire::AgentStatus, wire::Detection, wire::Alert>;
TYPED_TEST_SUITE(CdrSamples, Messages);

TYPED_TEST(CdrSamples, every_field_comes_back) {
  auto message = test::filled<TypeParam>();
  message.envelope.signature.clear();
  const auto octets = to_cdr(message);
  ASSERT_TRUE(octets) << octets.error().text;
  EXPECT_EQ((*octets)[1], 1) << "little-endian, as it travels";
  const auto back = from_cdr<TypeParam>(*octets);
  ASSERT_TRUE(back) << back.error().text;
  EXPECT_TRUE(test::same(*back, message));
}

TYPED_TEST(CdrSamples, what_is_cut_short_or_too_long_is_refused) {
  auto message = test::filled<TypeParam>();
  message.envelope.signature.clear();
  const auto octets = to_cdr(message).value();
  for (std::size_t size = 0; size + 4 < octets.size(); ++size) {
    EXPECT_FALSE(from_cdr<TypeParam>(std::span(octets).first(size))) << size;
  }
  std::vector<std::uint8_t> longer(octets.size() + 1'000'000);
  std::copy(octets.begin(), octets.end(), longer.begin());
  EXPECT_FALSE(from_cdr<TypeParam>(longer));
}

}  // namespace
}  // namespace lifeline::dds
