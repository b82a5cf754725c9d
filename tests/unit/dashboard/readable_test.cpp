#include "coordinator/dashboard/readable.hpp"

#include <gtest/gtest.h>

namespace lifeline::dashboard {
namespace {

TEST(ReadableText, ThatIsUtf8StaysAsItIs) {
  for (const char* text : {"", "alpha", "Süd", "出口", "🚒", "<b>&amp;"})
    EXPECT_EQ(readable(text), text);
}

TEST(ReadableText, ThatIsNoneKeepsWhatCanBeRead) {
  EXPECT_EQ(readable("a\xff\xfe z"), "a?? z");
  EXPECT_EQ(readable("\xc0\xaf"), "??") << "written longer than need be";
  EXPECT_EQ(readable("\xed\xa0\x80"), "???") << "half of a pair";
  EXPECT_EQ(readable("\xf4\x90\x80\x80"), "????") << "beyond the last character";
  EXPECT_EQ(readable("abc\xe2\x82"), "abc??") << "cut short";
}

}  // namespace
}  // namespace lifeline::dashboard
