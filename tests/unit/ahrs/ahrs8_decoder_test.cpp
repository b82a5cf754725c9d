#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "agents/ahrs/ahrs_decoder.hpp"
#include "agents/ahrs/line_splitter.hpp"
#include "tests/support/ahrs/sentences.hpp"

namespace lifeline::ahrs {
namespace {

const Ahrs8Decoder kDecoder;

TEST(Ahrs8Decoder, SaysWhatTheHeadDoes) {
  // Nose down by 0.2, leaning right by 0.1, looking 0.7 to the left of east and turning left.
  const auto head = [](double t_s) { return sensing::Attitude{0.1, 0.2, 0.7 + 0.5 * t_s}; };
  const auto decoded = kDecoder.decode(test::ahrs8_line(test::ned_state(head, 0.0), 1234));
  ASSERT_EQ(decoded.kind, LineKind::reading) << decoded.why;
  const Eigen::Quaterniond expected = Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()) *
                                      Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitY()) *
                                      Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX());
  EXPECT_LT(decoded.reading.R_world_body.angularDistance(expected), 1e-5);
  // Turning about the vertical, seen from the leaning body.
  const Eigen::Vector3d rate = expected.conjugate() * Eigen::Vector3d(0.0, 0.0, 0.5);
  EXPECT_LT((*decoded.reading.rate_rad_s - rate).norm(), 1e-5);
  EXPECT_EQ(decoded.reading.device_time, std::chrono::milliseconds(1234));
}

TEST(Ahrs8Decoder, TagsMayComeInAnyOrderAndUnknownOnesArePassedOver) {
  for (const char* line :
       {"P:,878979,ap,-6.34,-22.46,1011.71,gp,0.00,0.00,-0.00,yt,342.53,q,0.98,"
        "-0.01,0.01,-0.15",
        "P:,878979,q,1.,0.,0.,0.,temp,21.5", "P:,q,1,0,0,0", "P: 5, q, 1.0, 0.0, 0.0, 0.0"}) {
    EXPECT_EQ(kDecoder.decode(line).kind, LineKind::reading) << line;
  }
}

TEST(Ahrs8Decoder, ADamagedLineIsNamed) {
  const auto why = [](std::string_view line) {
    const auto decoded = kDecoder.decode(line);
    EXPECT_EQ(decoded.kind, LineKind::damaged) << line;
    return decoded.why;
  };
  EXPECT_EQ(why("P:,1,gp,0,0,0"), "no quaternion");
  EXPECT_EQ(why("P:,1,q,1,0,0"), "a quaternion without four numbers");
  EXPECT_EQ(why("P:,1,q,0.5,0,0,0"), "a quaternion of wrong length");
  EXPECT_EQ(why("P:,1,q,1,0,0,0,0"), "a number is unreadable");
  EXPECT_EQ(why("P:,1,q,1,0,0;0"), "a number is unreadable");
  EXPECT_EQ(why("P:,1,gp,0,0,q,1,0,0,0"), "rates without three numbers");
  EXPECT_EQ(why("P:,1,2,q,1,0,0,0"), "no time where one belongs");
  EXPECT_EQ(why("P:,-5,q,1,0,0,0"), "no time where one belongs");
  EXPECT_EQ(why("P:"), "no quaternion");
}

TEST(Ahrs8Decoder, AnswersToCommandsAreNoDamage) {
  EXPECT_EQ(kDecoder.decode("OK").kind, LineKind::other);
  EXPECT_EQ(kDecoder.decode("printmodulus 1 set drop").kind, LineKind::other);
}

TEST(Ahrs8Decoder, ContentLeavesTheTimeOut) {
  const auto content = [](const char* line) { return kDecoder.decode(line).reading.content; };
  EXPECT_EQ(content("P:,1,ap,1,2,3,q,1,0,0,0"), content("P:,2,ap,1,2,3,q,1,0,0,0"));
  EXPECT_NE(content("P:,1,ap,1,2,3,q,1,0,0,0"), content("P:,1,ap,1,2,4,q,1,0,0,0"));
}

std::vector<std::string> split(LineSplitter& splitter, std::string_view text) {
  std::vector<std::string> lines;
  splitter.push({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()},
                [&](std::string_view line, std::size_t) { lines.emplace_back(line); });
  return lines;
}

TEST(LineSplitter, CutsWhereLinesEndHoweverTheBytesCome) {
  LineSplitter splitter;
  EXPECT_TRUE(split(splitter, "$A,1").empty());
  EXPECT_EQ(split(splitter, "2\r\n\r\n$B\n$C"), (std::vector<std::string>{"$A,12", "$B"}));
  EXPECT_EQ(split(splitter, "\n"), std::vector<std::string>{"$C"});
  EXPECT_EQ(splitter.lost_bytes(), 0U);
}

TEST(LineSplitter, ALostEndCostsTheLineAndNotTheNext) {
  LineSplitter splitter;
  EXPECT_EQ(split(splitter, "$A,1$B,2\nP:,1,qP:,2,q\n"),
            (std::vector<std::string>{"$B,2", "P:,2,q"}));
  EXPECT_EQ(splitter.lost_bytes(), 10U);
}

TEST(LineSplitter, HoldsNoMoreThanALine) {
  LineSplitter splitter;
  const std::string endless(10000, 'x');
  EXPECT_TRUE(split(splitter, endless).empty());
  const auto lines = split(splitter, "\n$A\n");
  EXPECT_EQ(lines.back(), "$A");
  EXPECT_GE(splitter.lost_bytes(), 9000U);
}

TEST(LineSplitter, TellsHowManyBytesCameBehind) {
  LineSplitter splitter;
  std::vector<std::size_t> behind;
  const std::string text = "$A\r\n$BB\r\n";
  splitter.push({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()},
                [&](std::string_view, std::size_t count) { behind.push_back(count); });
  EXPECT_EQ(behind, (std::vector<std::size_t>{6, 1}));
}

}  // namespace
}  // namespace lifeline::ahrs
