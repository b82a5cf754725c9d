#include "deploy/demo/options.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace lifeline::demo {
namespace {

std::variant<Options, int> parse(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "lifeline-demo");
  return parse_options(static_cast<int>(arguments.size()), arguments.data());
}

TEST(DemoOptions, without_any_is_three_helmets_in_an_office) {
  const auto options = parse({});
  ASSERT_TRUE(std::holds_alternative<Options>(options));
  EXPECT_EQ(std::get<Options>(options).helmets, 3U);
  EXPECT_TRUE(std::get<Options>(options).plan.empty());
  EXPECT_TRUE(std::get<Options>(options).log.empty());
  EXPECT_EQ(std::get<Options>(options).report, "demo-report");
}

TEST(DemoOptions, takes_a_log_to_cut) {
  const auto options = parse({"--log", "a.log.gz", "--helmets", "2", "--report", "out"});
  ASSERT_TRUE(std::holds_alternative<Options>(options));
  EXPECT_EQ(std::get<Options>(options).log, "a.log.gz");
  EXPECT_EQ(std::get<Options>(options).helmets, 2U);
  EXPECT_EQ(std::get<Options>(options).report, "out");
}

TEST(DemoOptions, that_make_no_sense_are_wrong_use) {
  for (const std::vector<const char*>& wrong :
       std::vector<std::vector<const char*>>{{"--helmets", "0"},
                                             {"--helmets", "17"},
                                             {"--helmets", "many"},
                                             {"--plan", "a.json", "--log", "b.log"},
                                             {"--time-limit", "-1"},
                                             {"--no-such-option"},
                                             {"argument"}}) {
    const auto status = parse(wrong);
    ASSERT_TRUE(std::holds_alternative<int>(status));
    EXPECT_EQ(std::get<int>(status), 2);
  }
}

TEST(DemoOptions, asking_for_help_is_no_failure) {
  const auto status = parse({"--help"});
  ASSERT_TRUE(std::holds_alternative<int>(status));
  EXPECT_EQ(std::get<int>(status), 0);
}

}  // namespace
}  // namespace lifeline::demo
