#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <zlib.h>

#include "agents/ahrs/ahrs_decoder.hpp"
#include "agents/ahrs/line_receiver.hpp"
#include "common/base/angles.hpp"
#include "tests/support/ahrs/sentences.hpp"

namespace lifeline::ahrs {
namespace {

using test::Checksum;
using test::with_checksum;

const VectorNavDecoder kVectorNav;

DecodedLine decode(std::string_view body) {
  return kVectorNav.decode(with_checksum(body, Checksum::exclusive_or));
}

/// Where the body's x axis points, and its z axis: our axes.
Eigen::Vector3d forward(const AhrsReading& reading) {
  return reading.R_world_body * Eigen::Vector3d::UnitX();
}

TEST(VectorNavDecoder, ReadsASentenceThatASensorSent) {
  const auto decoded = kVectorNav.decode(
      "$VNYMR,-132.410,-000.766,-000.587,+00.1850,+00.0403,+00.1417,+00.324,-00.406,-09.681,"
      "-00.007393,-00.001693,-00.249232*60");
  ASSERT_EQ(decoded.kind, LineKind::reading);
  // Heading 132.41 deg west of north: our yaw, from east and counter-clockwise, is 90 + 132.41.
  const Eigen::Vector3d ahead = forward(decoded.reading);
  EXPECT_NEAR(std::atan2(ahead.y(), ahead.x()), (222.41 - 360.0) * kDegree, 1e-9);
  EXPECT_NEAR(std::asin(ahead.z()), -0.766 * kDegree, 1e-9);
  // z down in the sensor: it turns to the left by 0.249 rad/s, which we count positive.
  EXPECT_NEAR(decoded.reading.rate_rad_s->z(), 0.249232, 1e-9);
  EXPECT_NEAR(decoded.reading.rate_rad_s->y(), 0.001693, 1e-9);
  EXPECT_FALSE(decoded.reading.device_time);
}

TEST(VectorNavDecoder, NoseUpLooksUpAndRightSideDownLeansRight) {
  const auto pitched = decode("VNYPR,+000.000,+020.000,+000.000");
  ASSERT_EQ(pitched.kind, LineKind::reading);
  EXPECT_NEAR(forward(pitched.reading).z(), std::sin(20.0 * kDegree), 1e-12);
  const auto rolled = decode("VNYPR,+000.000,+000.000,+020.000");
  const Eigen::Vector3d left = rolled.reading.R_world_body * Eigen::Vector3d::UnitY();
  EXPECT_NEAR(left.z(), std::sin(20.0 * kDegree), 1e-12);
}

TEST(VectorNavDecoder, EverySentenceWithAnAttitudeSaysTheSame) {
  const auto angles = decode("VNYPR,+030.000,-010.000,+020.000");
  ASSERT_EQ(angles.kind, LineKind::reading);
  for (const char* body :
       {"VNYMR,30,-10,20,0,0,0,0,0,-9.8,0.1,0.2,0.3", "VNYBA,30,-10,20,0,0,-9.8,0.1,0.2,0.3",
        "VNYIA,30,-10,20,0,0,-9.8,0.1,0.2,0.3",
        "VNQTN,0.189307857,-0.038134576,0.268535822,0.943714364",
        "VNQMR,0.189307857,-0.038134576,0.268535822,0.943714364,0,0,0,0,0,-9.8,0.1,0.2,0.3"}) {
    const auto decoded = decode(body);
    ASSERT_EQ(decoded.kind, LineKind::reading) << body << ": " << decoded.why;
    EXPECT_LT(decoded.reading.R_world_body.angularDistance(angles.reading.R_world_body), 1e-6)
        << body;
    EXPECT_EQ(decoded.reading.rate_rad_s.has_value(), std::string_view(body).substr(2, 3) != "QTN");
  }
}

TEST(VectorNavDecoder, TakesEitherChecksumAndAppendedStatusAndCounter) {
  const char* const body = "VNYPR,+010.071,+000.278,-002.026";
  EXPECT_EQ(kVectorNav.decode(with_checksum(body, Checksum::crc16)).kind, LineKind::reading);
  // The manual's examples.
  for (const char* line :
       {"$VNYPR,+010.071,+000.278,-002.026*60", "$VNYPR,+010.071,+000.278,-002.026,T1162704*2F",
        "$VNYPR,+010.071,+000.278,-002.026,S0000*1F"}) {
    EXPECT_EQ(kVectorNav.decode(line).kind, LineKind::reading) << line;
  }
}

TEST(VectorNavDecoder, ADamagedSentenceIsNamed) {
  const auto why = [](std::string_view line) {
    const auto decoded = kVectorNav.decode(line);
    EXPECT_EQ(decoded.kind, LineKind::damaged) << line;
    return decoded.why;
  };
  EXPECT_EQ(why("$VNYPR,+010.071,+000.278,-002.026*61"), "wrong checksum");
  EXPECT_EQ(why("$VNYPR,+010.071,+000.278,-002.026"), "wrong checksum");
  EXPECT_EQ(why("VNYPR,+010.071,+000.278,-002.026*60"), "wrong checksum");
  EXPECT_EQ(why("$VNYPR,+010.071,+000.278,-002.026*060"), "wrong checksum");
  EXPECT_EQ(why(""), "wrong checksum");
  EXPECT_EQ(why("$*01"), "wrong checksum");
  EXPECT_EQ(decode("VNYPR,1,2").why, "a number is missing or unreadable");
  EXPECT_EQ(decode("VNYPR,1,2,x").why, "a number is missing or unreadable");
  EXPECT_EQ(decode("VNYPR,1,2,nan").why, "a number is missing or unreadable");
  EXPECT_EQ(decode("VNYPR,1,2,+-3").why, "a number is missing or unreadable");
  EXPECT_EQ(decode("VNYPR,1,2,3,4").why, "more numbers than the sentence has");
  EXPECT_EQ(decode("VNYPR,1,2,400").why, "angles or quaternion out of range");
  EXPECT_EQ(decode("VNQTN,1,1,0,0").why, "angles or quaternion out of range");
}

TEST(VectorNavDecoder, OtherSentencesAreNoDamage) {
  EXPECT_EQ(decode("VNERR,03").kind, LineKind::other);
  EXPECT_EQ(decode("VNRRG,01,VN-100").kind, LineKind::other);
}

/// The recorded stream; empty where the data is not here.
std::vector<std::uint8_t> recorded_stream() {
  const std::string path = LIFELINE_SOURCE_DIR "/../shared/data/ahrs/vn100_circles_stream.bin.gz";
  std::vector<std::uint8_t> bytes;
  if (!std::filesystem::exists(path)) return bytes;
  const gzFile file = gzopen(path.c_str(), "rb");
  std::uint8_t part[4096];
  for (int size = 0; (size = gzread(file, part, sizeof part)) > 0;) {
    bytes.insert(bytes.end(), part, part + size);
  }
  gzclose(file);
  return bytes;
}

struct Received {
  std::vector<LineReceiver::Reading> readings;
  AttitudeWatch::Counts counts;
  RateUnit unit;
  std::string damage;
};

/// As from a sensor of 40 Hz, in pieces of 97 bytes.
Received receive(const std::vector<std::uint8_t>& stream) {
  LineReceiver receiver(make_decoder("vectornav"), 115200);
  SteadyTime now{std::chrono::hours(1)};
  receiver.start(now);
  Received received;
  constexpr double kBytesPerS = 40.0 * 122.0;
  for (std::size_t i = 0; i < stream.size(); i += 97) {
    const std::size_t size = std::min<std::size_t>(97, stream.size() - i);
    now += from_seconds(static_cast<double>(size) / kBytesPerS);
    receiver.push({stream.data() + i, size}, now, received.readings);
  }
  received.counts = receiver.watch().counts();
  received.unit = receiver.watch().rate_unit();
  received.damage = receiver.last_damage();
  return received;
}

TEST(RecordedVectorNav, EverySentenceIsReadAndItsRatesFitItsAttitude) {
  const auto stream = recorded_stream();
  if (stream.empty()) GTEST_SKIP() << "the recorded stream is not here";
  const Received received = receive(stream);
  EXPECT_EQ(received.counts.readings, 3788U);
  EXPECT_EQ(received.counts.damaged, 0U);
  EXPECT_EQ(received.counts.leaps, 0U);
  EXPECT_EQ(received.readings.size(), 3788U);
  EXPECT_EQ(received.unit, RateUnit::as_stated);
  for (const auto& each : received.readings) {
    // A car: level within a few degrees.
    EXPECT_GT((each.reading.R_world_body * Eigen::Vector3d::UnitZ()).z(), 0.99);
  }
}

TEST(RecordedVectorNav, ADamagedSentenceCostsItselfAlone) {
  auto stream = recorded_stream();
  if (stream.empty()) GTEST_SKIP() << "the recorded stream is not here";
  for (std::size_t i = 5000; i < stream.size(); i += 5000) stream[i] ^= 0x04;
  const Received received = receive(stream);
  const std::size_t harmed = (stream.size() - 1) / 5000;
  EXPECT_GE(received.counts.readings + harmed, 3788U);
  EXPECT_GT(received.counts.damaged, harmed / 2);
  EXPECT_EQ(received.damage, "wrong checksum");
}

}  // namespace
}  // namespace lifeline::ahrs
