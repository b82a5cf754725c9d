// A real helmet, by its button and its display: its mayday outlives its process, and it answers
// orders.

#include <fstream>
#include <functional>

#include <sys/stat.h>

#include "common/dds/open_channel.hpp"
#include "common/sharing/alert_exchange.hpp"
#include "tests/support/killed_fleet.hpp"

namespace lifeline::test {
namespace {

using std::chrono::milliseconds;
using wire::AlertState;

/// Whoever commands, in this process.
class Commander {
 public:
  Commander(const TestDomain& domain, const std::string& qos, const std::string& mission)
      : participant_(dds::Participant::create({domain.id(), qos, "vehicle"}).value()) {
    Result<void> all;
    std::unique_ptr<wire::Inbox<wire::Alert>> alerts;
    std::unique_ptr<wire::Outbox<wire::Alert>> alert;
    dds::open_inbox(*participant_, alerts, all);
    dds::open_outbox(*participant_, alert, all);
    EXPECT_TRUE(all) << all.error().text;
    exchange_ = std::make_unique<sharing::AlertExchange>(
        sharing::Speaker{AgentId::parse("vehicle").value(), mission, random_incarnation()},
        wire::Role::coordinator, std::move(alerts), std::move(alert), clock_);
  }
  sharing::AlertExchange& alerts() { return *exchange_; }
  /// Hears and says; false where it does not hold in time.
  bool until(const std::function<bool()>& holds) {
    const auto end = std::chrono::steady_clock::now() + kLong;
    while (std::chrono::steady_clock::now() < end) {
      exchange_->step({}, notes_);
      if (holds()) return true;
      participant_->wait_for_data(milliseconds(20));
    }
    return false;
  }
  /// alpha's mayday; nullptr where none was heard.
  const wire::Alert* mayday() {
    for (const auto& [key, entry] : exchange_->list().entries()) {
      if (key.first == "alpha" && entry.is_told) return &entry.alert;
    }
    return nullptr;
  }

 private:
  const SystemClock clock_;
  std::unique_ptr<dds::Participant> participant_;
  std::unique_ptr<sharing::AlertExchange> exchange_;
  sharing::HearingNotes notes_;
};

class HudOfARealHelmet : public KilledFleet {
 protected:
  HudOfARealHelmet() { EXPECT_EQ(::mkfifo(fifo().c_str(), 0600), 0); }
  [[nodiscard]] std::string fifo() const { return (folder_.path() / "button").string(); }
  [[nodiscard]] std::filesystem::path png() const { return folder_.path() / "hud.png"; }
  void start_alpha(const std::string& from) {
    start("alpha", {"lifeline-agent", "run", "--id", "alpha", "--source",
                    "sim:office?beams=400&seed=1&duration=60&from=" + from, "--button", fifo(),
                    "--hud-png", png().string(), "--hud-size", "400x240"});
  }
  void say(const std::string& octets) {
    std::ofstream(fifo(), std::ios::binary) << octets << std::flush;
  }
};

TEST_F(HudOfARealHelmet, AMaydayOutlivesTheProcessThatRaisedItAndIsTakenBack) {
  start_alpha("0");
  expect("alpha", "joined mission");
  say("1");
  {
    Commander before(domain_, qos(), mission());
    ASSERT_TRUE(before.until([&] { return before.mayday() != nullptr; }));
    say("0");
    ASSERT_TRUE(before.until([&] { return std::filesystem::exists(png()); }));
    ASSERT_TRUE(
        before.alerts().answer({"alpha", before.mayday()->alert_id}, AlertState::acknowledged));
    ASSERT_TRUE(before.until([&] {
      return before.alerts().list().find({"alpha", before.mayday()->alert_id})->is_gathered;
    }));
  }
  (void)stop("alpha");
  start_alpha("5");
  Commander after(domain_, qos(), mission());
  ASSERT_TRUE(after.until([&] { return after.mayday() != nullptr; })) << "said again";
  EXPECT_EQ(after.mayday()->state, AlertState::acknowledged);
  say("1");
  EXPECT_TRUE(after.until([&] { return after.mayday()->state == AlertState::cleared; }));
  say("0");
}

TEST_F(HudOfARealHelmet, AnEvacuationIsAnsweredWithAPress) {
  start_alpha("0");
  expect("alpha", "joined mission");
  Commander commander(domain_, qos(), mission());
  const auto order = commander.alerts().raise(wire::AlertKind::evacuate, "", "roof").value();
  auto press_at = std::chrono::steady_clock::now();
  EXPECT_TRUE(commander.until([&] {
    // A press that comes before the order changes the scale; so again.
    if (std::chrono::steady_clock::now() >= press_at) {
      press_at += milliseconds(500);
      say("10");
    }
    return sharing::has_answered(commander.alerts().list().find(order)->alert, "alpha");
  }));
}

}  // namespace
}  // namespace lifeline::test
