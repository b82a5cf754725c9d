#include "common/dds/guarded_type.hpp"

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "common/dds/bounds.hpp"
#include "common/dds/convert.hpp"
#include "common/dds/type_support.hpp"
#include "tests/unit/dds/message_fields.hpp"

namespace lifeline::dds {
namespace {

using Octets = std::vector<std::uint8_t>;

template <typename Message>
class GuardedTypeOf : public ::testing::Test {
 protected:
  Octets encode(const Message& message) {
    SampleOf<Message> sample;
    EXPECT_TRUE(to_idl(message, sample.value));
    rtps::SerializedPayload_t payload(type_.m_typeSize);
    EXPECT_TRUE(type_.serialize(&sample, &payload));
    return {payload.data, payload.data + payload.length};
  }

  /// As the middleware does it: the sample always arrives, decodable or not.
  SampleOf<Message> decode(const Octets& octets) {
    rtps::SerializedPayload_t payload(static_cast<std::uint32_t>(octets.size()) + 1);
    std::copy(octets.begin(), octets.end(), payload.data);
    payload.length = static_cast<std::uint32_t>(octets.size());
    SampleOf<Message> sample;
    EXPECT_TRUE(type_.deserialize(&payload, &sample));
    rtps::InstanceHandle_t handle;
    EXPECT_TRUE(type_.getKey(&sample, &handle, false));
    EXPECT_TRUE(handle.isDefined());
    return sample;
  }

  TypeSupportOf<Message> type_;
};

using Messages =
    ::testing::Types<wire::HelmetPose, wire::HelmetScan, wire::TsdTile, wire::TileRequest,
                     wire::TileCopy, wire::MergeDirective, wire::DirectiveCopy, wire::MergeEvidence,
                     wire::AgentStatus, wire::Detection, wire::Alert>;
TYPED_TEST_SUITE(GuardedTypeOf, Messages);

TYPED_TEST(GuardedTypeOf, announces_no_type_objects) {
  EXPECT_FALSE(this->type_.auto_fill_type_object());
  EXPECT_FALSE(this->type_.auto_fill_type_information());
}

TYPED_TEST(GuardedTypeOf, a_truncated_sample_is_not_decodable) {
  const auto octets = this->encode(test::filled<TypeParam>());
  for (std::size_t size = 0; size < octets.size(); ++size) {
    const auto sample = this->decode(Octets(octets.begin(), octets.begin() + long(size)));
    ASSERT_FALSE(sample.decodable) << size << " of " << octets.size() << " octets";
  }
}

TYPED_TEST(GuardedTypeOf, a_sample_with_octets_left_over_is_not_decodable) {
  auto octets = this->encode(test::filled<TypeParam>());
  octets.insert(octets.end(), 4, 0);

  EXPECT_FALSE(this->decode(octets).decodable);
}

TYPED_TEST(GuardedTypeOf, damaged_samples_neither_throw_nor_exceed_what_came_in) {
  const auto octets = this->encode(test::filled<TypeParam>());
  std::mt19937 random(20240229);
  std::size_t decodable = 0;
  for (int i = 0; i < 3000; ++i) {
    auto damaged = octets;
    for (std::uint32_t n = random() % 4 + 1; n > 0; --n) {
      damaged[random() % damaged.size()] = static_cast<std::uint8_t>(random());
    }
    const auto sample = this->decode(damaged);
    if (!sample.decodable) continue;
    ++decodable;
    const auto message = from_idl(sample.value);
    (void)check_bounds(message);
  }
  EXPECT_GT(decodable, 0U);     // damage to a number only changes it
  EXPECT_LT(decodable, 3000U);  // damage to a length is noticed
}

using GuardedStatus = GuardedTypeOf<wire::AgentStatus>;

TEST_F(GuardedStatus, a_boolean_that_is_none_is_not_decodable) {
  wire::AgentStatus status;
  status.battery_percent = 0xA5;  // stands right before the boolean
  auto octets = encode(status);
  const auto at = std::find(octets.begin(), octets.end(), 0xA5);
  ASSERT_NE(at, octets.end());
  *(at + 1) = 2;

  EXPECT_FALSE(decode(octets).decodable);
}

TEST_F(GuardedStatus, a_claimed_length_is_not_allocated) {
  // The last field is a sequence of names: nothing but its length, empty.
  auto octets = encode(wire::AgentStatus());
  for (const std::uint8_t claimed : Octets{0x01, 0x7F, 0xFF}) {
    std::fill(octets.end() - 4, octets.end(), claimed);
    const auto sample = decode(octets);
    EXPECT_FALSE(sample.decodable);
    EXPECT_LE(sample.value.peers_heard().capacity(), octets.size());
  }
}

using GuardedPose = GuardedTypeOf<wire::HelmetPose>;

TEST_F(GuardedPose, keys_follow_the_key_field_alone) {
  const auto key_of = [this](wire::HelmetPose pose) {
    SampleOf<wire::HelmetPose> sample;
    EXPECT_TRUE(to_idl(pose, sample.value));
    rtps::InstanceHandle_t handle;
    EXPECT_TRUE(type_.getKey(&sample, &handle, false));
    return handle;
  };
  auto pose = test::filled<wire::HelmetPose>();
  const auto before = key_of(pose);
  pose.map_id += 1;
  EXPECT_EQ(key_of(pose), before);
  pose.agent_id += "b";
  EXPECT_FALSE(key_of(pose) == before);
}

}  // namespace
}  // namespace lifeline::dds
