#include "agents/rplidar/protocol.hpp"

#include <numeric>

#include <gmock/gmock.h>

namespace lifeline::rplidar {
namespace {

using testing::ElementsAre;
using Buffer = std::vector<std::uint8_t>;

Buffer operator+(Buffer a, const Buffer& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

const Buffer kHealthAnswer{0xA5, 0x5A, 0x03, 0x00, 0x00, 0x00, 0x06, 0x02, 0x34, 0x12};

TEST(Requests, without_payload_are_two_bytes) {
  EXPECT_THAT(encode_request(Command::stop), ElementsAre(0xA5, 0x25));
  EXPECT_THAT(encode_request(Command::reset), ElementsAre(0xA5, 0x40));
  EXPECT_THAT(encode_request(Command::scan), ElementsAre(0xA5, 0x20));
  EXPECT_THAT(encode_request(Command::get_info), ElementsAre(0xA5, 0x50));
  EXPECT_THAT(encode_request(Command::get_health), ElementsAre(0xA5, 0x52));
}

TEST(Requests, with_payload_end_with_their_checksum) {
  // The express request is the one that the protocol's description prints.
  EXPECT_THAT(encode_request(Command::express_scan, express_payload(0)),
              ElementsAre(0xA5, 0x82, 0x05, 0, 0, 0, 0, 0, 0x22));
  EXPECT_THAT(encode_request(Command::express_scan, express_payload(3)),
              ElementsAre(0xA5, 0x82, 0x05, 3, 0, 0, 0, 0, 0x21));
  EXPECT_THAT(encode_request(Command::set_motor_pwm, motor_payload(600)),
              ElementsAre(0xA5, 0xF0, 0x02, 0x58, 0x02, 0x0D));
  EXPECT_THAT(encode_request(Command::get_lidar_conf, conf_payload(ConfEntry::mode_count)),
              ElementsAre(0xA5, 0x84, 0x04, 0x70, 0, 0, 0, 0x55));
  EXPECT_THAT(encode_request(Command::get_lidar_conf, conf_payload(ConfEntry::us_per_sample, 2)),
              ElementsAre(0xA5, 0x84, 0x06, 0x71, 0, 0, 0, 2, 0, 0x54));
}

TEST(Answers, descriptors_tell_length_mode_and_type) {
  const auto single = parse_descriptor(Buffer{0xA5, 0x5A, 0x14, 0, 0, 0, 0x04});
  ASSERT_TRUE(single);
  EXPECT_EQ(single->length, 20U);
  EXPECT_FALSE(single->repeating);
  EXPECT_EQ(single->type, 0x04);
  const auto repeating = parse_descriptor(Buffer{0xA5, 0x5A, 0x54, 0, 0, 0x40, 0x82});
  ASSERT_TRUE(repeating);
  EXPECT_EQ(repeating->length, 84U);
  EXPECT_TRUE(repeating->repeating);
  EXPECT_FALSE(parse_descriptor(Buffer{0xA5, 0x5B, 0x54, 0, 0, 0x40, 0x82}));
  EXPECT_FALSE(parse_descriptor(Buffer{0xA5, 0x5A, 0x54, 0, 0, 0x80, 0x82}));
  EXPECT_FALSE(parse_descriptor(Buffer{0xA5, 0x5A, 0x54, 0, 0, 0x40}));
}

TEST(Answers, info_names_model_firmware_and_serial_number) {
  Buffer answer{0x31, 0x1B, 0x01, 0x06};
  for (int i = 0; i < 16; ++i) answer.push_back(static_cast<std::uint8_t>(0xA0 + i));
  const auto info = parse_info(answer);
  ASSERT_TRUE(info);
  EXPECT_EQ(info->model, 0x31);
  EXPECT_EQ(info->firmware_major, 1);
  EXPECT_EQ(info->firmware_minor, 27);
  EXPECT_EQ(info->hardware, 6);
  EXPECT_EQ(info->serial_number, "A0A1A2A3A4A5A6A7A8A9AAABACADAEAF");
  answer.pop_back();
  EXPECT_FALSE(parse_info(answer));
}

TEST(Answers, health_is_a_status_and_a_code) {
  const auto health = parse_health(Buffer{0x02, 0x34, 0x12});
  ASSERT_TRUE(health);
  EXPECT_EQ(health->status, HealthStatus::error);
  EXPECT_EQ(health->error_code, 0x1234);
  EXPECT_FALSE(parse_health(Buffer{0x03, 0, 0}));
  EXPECT_FALSE(parse_health(Buffer{0x00, 0}));
}

TEST(Answers, a_configuration_is_taken_only_for_the_entry_asked_for) {
  const Buffer answer{0x71, 0, 0, 0, 0x00, 0x3F, 0, 0};
  const auto value = conf_value(answer, ConfEntry::us_per_sample);
  ASSERT_TRUE(value);
  EXPECT_EQ(parse_number(*value, 4), 63U * 256U);
  EXPECT_FALSE(conf_value(answer, ConfEntry::max_distance));
  EXPECT_FALSE(conf_value(Buffer{0x71, 0, 0}, ConfEntry::us_per_sample));
}

TEST(Answers, names_end_at_their_zero_and_are_printable) {
  EXPECT_EQ(parse_name(Buffer{'B', 'o', 'o', 's', 't', 0, 'x'}), "Boost");
  EXPECT_EQ(parse_name(Buffer{'a', 0x1B, 0xFF}), "a??");
  EXPECT_EQ(parse_name(Buffer(100, 'x')).size(), 32U);
  EXPECT_EQ(parse_name({}), "");
}

TEST(AnswerFinder, finds_the_answer_however_it_is_cut) {
  for (std::size_t cut = 0; cut <= kHealthAnswer.size(); ++cut) {
    AnswerFinder finder(AnswerType::health);
    const Bytes all(kHealthAnswer);
    const bool early = finder.push(all.first(cut));
    EXPECT_EQ(early, cut == kHealthAnswer.size());
    EXPECT_TRUE(finder.push(all.subspan(cut)));
    EXPECT_THAT(Buffer(finder.answer().begin(), finder.answer().end()),
                ElementsAre(0x02, 0x34, 0x12));
  }
}

TEST(AnswerFinder, passes_over_what_was_still_on_its_way) {
  AnswerFinder finder(AnswerType::health);
  const Buffer leftovers{0xA5, 0xA5, 0x5A, 0x17, 0xA5, 0x5A, 0x14, 0, 0, 0, 0x04, 9, 0xA5};
  EXPECT_TRUE(finder.push(leftovers + kHealthAnswer + Buffer{7, 8}));
  EXPECT_EQ(parse_health(finder.answer())->error_code, 0x1234);
  EXPECT_THAT(Buffer(finder.rest().begin(), finder.rest().end()), ElementsAre(7, 8));
}

TEST(AnswerFinder, a_repeating_answer_is_there_with_its_descriptor) {
  AnswerFinder finder(AnswerType::express_capsules);
  EXPECT_TRUE(finder.push(Buffer{0xA5, 0x5A, 0x54, 0, 0, 0x40, 0x82, 1, 2}));
  EXPECT_TRUE(finder.answer().empty());
  EXPECT_THAT(Buffer(finder.rest().begin(), finder.rest().end()), ElementsAre(1, 2));
}

TEST(AnswerFinder, a_length_that_no_answer_has_is_no_answer) {
  AnswerFinder finder(AnswerType::health);
  EXPECT_FALSE(finder.push(Buffer{0xA5, 0x5A, 0xFF, 0xFF, 0xFF, 0x3F, 0x06}));
  EXPECT_TRUE(finder.heard());
  EXPECT_TRUE(finder.push(kHealthAnswer));
}

}  // namespace
}  // namespace lifeline::rplidar
