#include "tests/golden/hud/situations.hpp"

#include <cmath>

#include "tests/support/hud_rooms.hpp"
#include "tests/support/hud_samples.hpp"

namespace lifeline::test {
namespace {

using Eigen::Vector2d;
using hud::HudFacts;
using hud::HudPicture;
using std::chrono::milliseconds;
using std::chrono::seconds;
using wire::AlertKind;

const SteadyTime kStart{std::chrono::hours(1)};
const Vector2d kEntry_m{1.0, 7.0};

// Rooms of 6 x 6 m on either side of a corridor of 24 x 2 m, each with a door in the middle.
Occupancy office(const Vector2d& p_m) {
  constexpr double kHalfWall_m = 0.08, kHalfDoor_m = 0.5;
  if (p_m.x() < 0.0 || p_m.x() > 24.0 || p_m.y() < 0.0 || p_m.y() > 14.0) return Occupancy::unknown;
  const auto near = [&](double a, double b) { return std::abs(a - b) < kHalfWall_m; };
  const bool outer =
      near(p_m.x(), 0.0) || near(p_m.x(), 24.0) || near(p_m.y(), 0.0) || near(p_m.y(), 14.0);
  const double in_room = std::fmod(p_m.x(), 6.0);
  const bool between =
      (p_m.y() < 6.0 || p_m.y() > 8.0) && (in_room < kHalfWall_m || in_room > 6.0 - kHalfWall_m);
  const bool beside_corridor =
      (near(p_m.y(), 6.0) || near(p_m.y(), 8.0)) && std::abs(in_room - 3.0) > kHalfDoor_m;
  return outer || between || beside_corridor ? Occupancy::occupied : Occupancy::free;
}

/// What the wearer has seen: the corridor as far as the lamp reaches, and three rooms.
bool is_seen(const Vector2d& p_m) {
  const double x = p_m.x(), y = p_m.y();
  if (y > 5.9 && y < 8.1) return x < 19.0 + 0.4 * std::sin(5.0 * y);
  if (y <= 5.9) return x > 6.0 && x < 18.1;
  return x > 11.9 && x < 18.1 && y < 12.0 + 0.5 * std::sin(2.0 * x);
}

class Scene {
 public:
  Scene() {
    hud::Path walked;
    for (double x = kEntry_m.x(); x <= 13.0; x += 0.25) walked.push_back({x, 7.0});
    core_ = std::make_shared<hud::HudCore>(0.05, walked);
    facts_ = sound_facts(kStart);
    facts_.command_at = facts_.mate_at = facts_.shared_at = std::nullopt;
    facts_.state.T_map_head = {13.0, 7.0, 0.35};
    see([](const Vector2d& p_m) { return is_seen(p_m) ? office(p_m) : Occupancy::unknown; });
  }

  void see(const std::function<Occupancy(const Vector2d&)>& cell) {
    core_->put(drawn_tiles({-1.0, -1.0}, {25.0, 15.0}, cell));
  }
  /// Everybody's part of the building, and everybody is heard.
  void share() {
    see(office);
    facts_.shares = true;
    facts_.command_at = facts_.mate_at = facts_.shared_at = kStart;
  }
  void add_mate(const std::string& id, const Pose2& T_map_mate, Duration age = {}) {
    facts_.mates.push_back({id, T_map_mate, 90, kStart - age});
  }
  void press(Duration how_long) {
    core_->put(facts_, now_);
    core_->set_button(true, now_);
    step(how_long);
    core_->set_button(false, now_);
    step(milliseconds(200));
  }
  void hold(Duration how_long) {
    core_->put(facts_, now_);
    core_->set_button(true, now_);
    step(how_long);
  }
  void wait(Duration how_long) {
    core_->put(facts_, now_);
    step(how_long);
  }
  HudFacts& facts() { return facts_; }

  Situation end(const std::string& name) {
    core_->put(facts_, now_);
    return {name, core_, core_->step(now_)};
  }

 private:
  void step(Duration time) {
    for (Duration passed{}; passed < time; passed += milliseconds(20))
      core_->step(now_ += milliseconds(20));
  }

  std::shared_ptr<hud::HudCore> core_;
  HudFacts facts_;
  SteadyTime now_ = kStart;
};

Situation own_map() {
  Scene scene;
  return scene.end("own_map");
}

Situation shared_with_mates() {
  Scene scene;
  scene.share();
  scene.add_mate("bravo", {17.0, 7.8, 2.0});
  scene.add_mate("ff12", {15.0, 4.0, -1.2});
  return scene.end("shared_with_mates");
}

Situation mates_at_edges() {
  Scene scene;
  scene.share();
  scene.add_mate("bravo", {35.0, 9.0, 0.0});
  scene.add_mate("charlie", {12.0, 21.0, 0.0});
  scene.add_mate("ff3", {8.0, -14.0, 0.0});
  return scene.end("mates_at_edges");
}

Situation stale_mate() {
  Scene scene;
  scene.share();
  scene.add_mate("bravo", {17.0, 7.8, 2.0}, seconds(35));
  scene.add_mate("delta", {12.0, -15.0, 0.0}, seconds(8));
  scene.facts().state.trust_percent = 60;
  scene.facts().pose_loss = 0.3;
  return scene.end("stale_mate");
}

Situation heading_unknown() {
  Scene scene;
  scene.facts().state.state = wire::AgentState::weak;
  scene.facts().state.attitude = wire::SensorHealth::silent;
  scene.facts().state.trust_percent = 30;
  return scene.end("heading_unknown");
}

Situation victims() {
  Scene scene;
  scene.share();
  scene.facts().finds = {{{16.5, 9.5}, wire::DetectionKind::victim, true},
                         {{16.0, 3.2}, wire::DetectionKind::victim, false},
                         {{20.0, -9.0}, wire::DetectionKind::victim, true}};
  return scene.end("victims");
}

Situation way_out_free() {
  Scene scene;
  scene.facts().state.T_map_head = {15.0, 3.0, -2.6};
  scene.press(milliseconds(150));
  return scene.end("way_out_free");
}

Situation way_out_own_trail() {
  Scene scene;
  scene.see([](const Vector2d& p_m) {
    const bool gap = p_m.x() > 5.0 && p_m.x() < 9.0;  // smoke: nothing came back
    return is_seen(p_m) && !gap ? office(p_m) : Occupancy::unknown;
  });
  scene.facts().state.T_map_head = {13.0, 7.0, 3.0};
  scene.press(milliseconds(150));
  return scene.end("way_out_own_trail");
}

Situation position_lost() {
  Scene scene;
  scene.share();
  scene.add_mate("bravo", {17.0, 7.8, 2.0});
  (void)scene.end("");
  scene.facts().state.state = wire::AgentState::lost;
  scene.facts().state.trust_percent = 0;
  scene.wait(seconds(12));
  scene.facts().mates[0].heard_at += seconds(12);
  return scene.end("position_lost");
}

Situation search_next() {
  Scene scene;
  scene.share();
  scene.add_mate("bravo", {17.0, 7.8, 2.0});
  scene.facts().search = hud::SearchFacts{{16.0, 9.6}, 5.2};
  return scene.end("search_next");
}

Situation search_beyond() {
  Scene scene;
  scene.facts().search = hud::SearchFacts{{19.0, -8.0}, 24.0};
  scene.facts().finds = {{{14.5, 4.0}, wire::DetectionKind::victim, true}};
  return scene.end("search_beyond");
}

Situation mayday() {
  Scene scene;
  scene.share();
  scene.add_mate("bravo", {22.0, 11.0, 2.0});
  scene.add_mate("ff12", {15.0, 4.0, -1.2});
  auto alert = open_alert(AlertKind::mayday, "bravo", "bravo");
  alert.text = "low air";
  scene.facts().alerts = {alert};
  return scene.end("mayday");
}

Situation evacuate() {
  Scene scene;
  scene.share();
  auto alert = open_alert(AlertKind::evacuate, "vehicle");
  alert.text = "roof is coming down";
  scene.facts().alerts = {alert};
  return scene.end("evacuate");
}

Situation roll_call() {
  Scene scene;
  scene.share();
  scene.facts().alerts = {open_alert(AlertKind::roll_call, "vehicle")};
  return scene.end("roll_call");
}

Situation hold_bar() {
  Scene scene;
  scene.share();
  scene.hold(milliseconds(1300));
  return scene.end("hold_bar");
}

Situation own_mayday_and_order() {
  Scene scene;
  scene.share();
  scene.add_mate("bravo", {17.0, 7.8, 2.0});
  auto own = open_alert(AlertKind::mayday, "alpha", "alpha");
  own.own = own.seen_by_command = true;
  scene.facts().alerts = {own, open_alert(AlertKind::evacuate, "vehicle"),
                          open_alert(AlertKind::roll_call, "vehicle")};
  return scene.end("own_mayday_and_order");
}

}  // namespace

std::vector<Situation> hud_situations() {
  return {own_map(),         shared_with_mates(), mates_at_edges(), stale_mate(),
          heading_unknown(), victims(),           way_out_free(),   way_out_own_trail(),
          search_next(),     search_beyond(),     position_lost(),  mayday(),
          evacuate(),        roll_call(),         hold_bar(),       own_mayday_and_order()};
}

}  // namespace lifeline::test
