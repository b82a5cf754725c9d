// The HUD as its helmet uses it: its own thread, SDL's display without a screen, a PNG, a FIFO.

#include "agents/hud/hud.hpp"

#include <cstdlib>
#include <fstream>
#include <functional>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "agents/hud/draw_hud.hpp"
#include "tests/support/hud_rooms.hpp"
#include "tests/support/hud_samples.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline::hud {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class HudThread : public testing::Test {
 protected:
  HudThread() {
    ::setenv("SDL_VIDEODRIVER", "dummy", 1);
    EXPECT_EQ(::mkfifo(fifo_.c_str(), 0600), 0);
  }
  /// Polls, with a deadline that only a failure reaches.
  static bool until(const std::function<bool()>& holds) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (std::chrono::steady_clock::now() < end) {
      if (holds()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return false;
  }
  void say(const std::string& octets) {
    std::ofstream(fifo_, std::ios::binary) << octets << std::flush;
  }
  HudOptions options(bool display) {
    HudOptions options;
    options.display = display;
    options.size = Size{320, 240};
    options.png = png_;
    options.button = fifo_;
    return options;
  }

  support::TemporaryFolder folder_;
  std::filesystem::path png_ = folder_.path() / "hud.png", fifo_ = folder_.path() / "button";
};

TEST_F(HudThread, WritesItsPictureAndHearsTheButton) {
  for (const bool display : {false, true}) {
    auto hud = Hud::start(options(display), 0.05, {});
    ASSERT_TRUE(hud) << hud.error().text;
    (*hud)->put(test::sound_facts(std::chrono::steady_clock::now()));
    (*hud)->put(test::plan_tiles({"####", "#..#", "####"}));
    ASSERT_TRUE(until([&] { return std::filesystem::exists(png_); }));
    EXPECT_THAT(support::content_of(png_), StartsWith("\x89PNG"));
    say("garbage 1");
    std::vector<HudCommand> commands;
    ASSERT_TRUE(until([&] {
      commands = (*hud)->take_commands();
      return !commands.empty();
    }));
    EXPECT_EQ(commands[0].kind, HudCommand::Kind::mayday);
    say("0");
    hud->reset();
    std::filesystem::remove(png_);
  }
}

TEST_F(HudThread, GoesOnWithoutADisplay) {
  ::setenv("SDL_VIDEODRIVER", "there-is-none", 1);
  auto hud = Hud::start(options(true), 0.05, {});
  ASSERT_TRUE(hud) << hud.error().text;
  (*hud)->put(test::sound_facts(std::chrono::steady_clock::now()));
  EXPECT_TRUE(until([&] { return std::filesystem::exists(png_); }));
}

TEST_F(HudThread, WhatCanNeverWorkIsSaidAtOnce) {
  auto no_key = options(false), no_folder = options(false), no_button = options(false);
  no_key.key = "Whatever";
  no_folder.png = folder_.path() / "missing" / "hud.png";
  no_button.button = folder_.path() / "missing";
  EXPECT_THAT(Hud::start(no_key, 0.05, {}).error().text, HasSubstr("no key is called Whatever"));
  EXPECT_THAT(Hud::start(no_folder, 0.05, {}).error().text, HasSubstr("no such folder"));
  EXPECT_THAT(Hud::start(no_button, 0.05, {}).error().text, HasSubstr("give a FIFO"));
}

TEST_F(HudThread, TheDisplayIsGivenTheSamePixelsAsTheFile) {
  auto window = Window::open(Size{400, 240}, "Space");
  ASSERT_TRUE(window) << window.error().text;
  EXPECT_EQ((*window)->picture_size(), (Size{400, 240}));
  HudMap map(0.05);
  map.put(test::plan_tiles({"######", "#....#", "#....#", "######"}));
  map.refresh();
  HudPicture picture;
  picture.T_map_head = {1.5, 1.0, 0.3};
  picture.position_known = picture.heading_known = true;
  Pen pen(400, 240);
  draw_hud(picture, map, pen);
  const auto drawn = pen.pixels();
  ASSERT_TRUE((*window)->show(drawn));
  const auto shown = (*window)->read_back();
  ASSERT_TRUE(shown) << shown.error().text;
  std::size_t different = 0;
  for (std::size_t i = 0; i < drawn.size(); ++i)
    different += (drawn[i] & 0xffffffU) != ((*shown)[i] & 0xffffffU) ? 1U : 0U;
  EXPECT_EQ(different, 0U);
}

}  // namespace
}  // namespace lifeline::hud
