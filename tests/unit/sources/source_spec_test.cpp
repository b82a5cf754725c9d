#include "agents/sources/source_spec.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lifeline::sources {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Pair;

SourceSpec parsed(std::string_view source) {
  const auto spec = parse_source_spec(source);
  return spec ? *spec : SourceSpec{};
}

std::string spec_refusal(std::string_view source) {
  const auto spec = parse_source_spec(source);
  if (spec) return "accepted";
  EXPECT_EQ(spec.error().code, ErrorCode::wrong_use);
  return spec.error().text;
}

TEST(SourceSpec, TakesKindTargetAndOptionsApart) {
  const SourceSpec spec = parsed("carmen:logs/intel.log.gz?from=10&prior=odom");
  EXPECT_EQ(spec.kind, "carmen");
  EXPECT_EQ(spec.target, "logs/intel.log.gz");
  EXPECT_THAT(spec.options, ElementsAre(Pair("from", "10"), Pair("prior", "odom")));
}

TEST(SourceSpec, NeedsNoOptions) {
  EXPECT_EQ(parsed("sim:office").target, "office");
  EXPECT_THAT(parsed("sim:office").options, IsEmpty());
  EXPECT_THAT(parsed("sim:office?").options, IsEmpty());
}

TEST(SourceSpec, KeepsColonsAndAllButTheLastQuestionMarkInTheTarget) {
  EXPECT_EQ(parsed("carmen:C:/a?b?from=1").target, "C:/a?b");
  EXPECT_EQ(parsed("carmen:odd?name?").target, "odd?name");
}

TEST(SourceSpec, LetsAnOptionHoldSlashesAndEqualsSigns) {
  EXPECT_THAT(parsed("rosbag2:d?scan=/front/scan&x=a=b").options,
              ElementsAre(Pair("scan", "/front/scan"), Pair("x", "a=b")));
}

TEST(SourceSpec, RefusesATextWithoutKindOrTarget) {
  EXPECT_THAT(spec_refusal("intel.log"), HasSubstr("does not begin with a kind"));
  EXPECT_THAT(spec_refusal(":intel.log"), HasSubstr("does not begin with a kind"));
  EXPECT_THAT(spec_refusal("Car men:intel.log"), HasSubstr("does not begin with a kind"));
  EXPECT_EQ(spec_refusal("carmen:"), "source 'carmen:' names nothing after 'carmen:'");
  EXPECT_EQ(spec_refusal("carmen:?from=1"),
            "source 'carmen:?from=1' names nothing after 'carmen:'");
}

TEST(SourceSpec, RefusesMalformedAndRepeatedOptions) {
  for (const std::string option : {"from", "from=", "=1"}) {
    EXPECT_EQ(spec_refusal("carmen:a?" + option), "source 'carmen:a?" + option + "': option '" +
                                                      option + "' is not of the form key=value");
  }
  EXPECT_THAT(spec_refusal("carmen:a?to=1&&from=2"), HasSubstr("option '' is not of the form"));
  EXPECT_EQ(spec_refusal("carmen:a?to=1&to=2"),
            "source 'carmen:a?to=1&to=2': option 'to' is given twice");
}

TEST(SourceSpec, NamesAnUnknownOptionAndThoseThatThereAre) {
  const SourceSpec spec = parsed("carmen:a?form=1");
  const auto allowed = spec.allow_options({"from", "to"});
  ASSERT_FALSE(allowed);
  EXPECT_EQ(allowed.error().code, ErrorCode::wrong_use);
  EXPECT_EQ(allowed.error().text, "carmen: has no option 'form'; there are: from, to, rate");
  EXPECT_TRUE(spec.allow_options({"form"}));
}

TEST(SourceSpec, ReadsTypedOptionsOrTheirFallback) {
  const SourceSpec spec = parsed("sim:a?seed=42&noise=0.25&prior=odom");
  EXPECT_EQ(spec.integer("seed", 1, 0, 100), 42);
  EXPECT_EQ(spec.integer("floors", 3, 0, 100), 3);
  EXPECT_EQ(spec.number("noise", 1.0, 0.0, 1.0), 0.25);
  EXPECT_EQ(spec.number("speed", 1.5, 0.0, 2.0), 1.5);
  EXPECT_EQ(spec.choice("prior", "none", {"none", "odom"}), "odom");
  EXPECT_EQ(spec.choice("shape", "round", {"round"}), "round");
  EXPECT_EQ(spec.text("prior", ""), "odom");
  EXPECT_EQ(spec.text("imu", "/imu"), "/imu");
}

TEST(SourceSpec, RefusesIntegersThatAreNoneOrOutOfRange) {
  for (const std::string value :
       {"x", "1.5", "5x", "-1", "101", "99999999999999999999", "+5", " 5"}) {
    const auto read = parsed("sim:a?seed=" + value).integer("seed", 1, 0, 100);
    ASSERT_FALSE(read) << value;
    EXPECT_EQ(read.error().text, "sim: option seed=" + value + " is not an integer from 0 to 100");
    EXPECT_EQ(read.error().code, ErrorCode::wrong_use);
  }
}

TEST(SourceSpec, RefusesNumbersThatAreNoneNotFiniteOrOutOfRange) {
  for (const std::string value : {"x", "nan", "inf", "-0.1", "1.01", "0.5m", "1e999"}) {
    const auto read = parsed("sim:a?noise=" + value).number("noise", 1, 0, 1);
    ASSERT_FALSE(read) << value;
    EXPECT_EQ(read.error().text, "sim: option noise=" + value + " is not a number from 0 to 1");
  }
}

TEST(SourceSpec, ListsTheChoicesWhenRefusingOne) {
  const auto read = parsed("carmen:a?prior=gps").choice("prior", "none", {"none", "odom"});
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().text, "carmen: option prior=gps is none of: none, odom");
}

}  // namespace
}  // namespace lifeline::sources
