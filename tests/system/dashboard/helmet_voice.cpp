// A helmet that says what it is told, over the real DDS: lifeline-helmet-voice ID DOMAIN MISSION
// QOS. Reads lines: "mayday TEXT", "find", "status", "hostile"; prints "said ..." and what others
// answer.

#include <cstdio>
#include <iostream>
#include <string>
#include <thread>

#include "common/base/ids.hpp"
#include "common/base/time.hpp"
#include "common/dds/open_channel.hpp"

namespace lifeline {
namespace {

class Voice {
 public:
  Voice(std::string id, std::string mission) : id_(std::move(id)), mission_(std::move(mission)) {}

  [[nodiscard]] Result<void> open(std::uint32_t domain, const std::string& qos) {
    auto made = dds::Participant::create({domain, qos, id_});
    if (!made) return forward_error(made);
    participant_ = *std::move(made);
    Result<void> all;
    dds::open_outbox(*participant_, statuses_, all);
    dds::open_outbox(*participant_, alerts_, all);
    dds::open_outbox(*participant_, finds_, all);
    dds::open_inbox(*participant_, heard_alerts_, all);
    dds::open_inbox(*participant_, heard_finds_, all);
    return all;
  }

  void follow(const std::string& line) {
    if (line.starts_with("mayday ")) say_mayday(line.substr(7));
    if (line == "find") say_find();
    if (line == "status") say_status(id_);
    if (line == "hostile") say_hostile();
    print("said " + line);
  }

  void listen() {
    participant_->wait_for_data(std::chrono::milliseconds(50));
    for (const auto& alert : heard_alerts_->take()) {
      if (alert.envelope.sender_id == id_) continue;
      for (const auto& name : alert.acknowledged_by)
        print("alert " + alert.issuer_id + " answered by " + name);
    }
    for (const auto& find : heard_finds_->take()) {
      if (find.envelope.sender_id != id_ && find.agent_id == id_)
        print("find ruled " + std::to_string(static_cast<int>(find.state)));
    }
  }

 private:
  static void print(const std::string& line) {
    std::puts(line.c_str());
    std::fflush(stdout);
  }
  wire::Envelope envelope(const std::string& sender) {
    wire::Envelope envelope;
    envelope.mission_id = mission_;
    envelope.sender_id = sender;
    envelope.incarnation = incarnation_;
    envelope.sequence = ++sequence_;
    return envelope;
  }
  void say_mayday(const std::string& text) {
    wire::Alert alert;
    alert.envelope = envelope(id_);
    alert.issuer_id = id_;
    alert.alert_id = ++last_id_;
    alert.text = text;
    (void)alerts_->put(alert);
  }
  void say_find() {
    wire::Detection find;
    find.envelope = envelope(id_);
    find.agent_id = id_;
    find.detection_id = ++last_id_;
    find.revision = 1;
    find.map_id = 1;
    find.x_m = 1.0;
    find.y_m = 1.0;
    find.confidence = 0.7F;
    (void)finds_->put(find);
  }
  void say_status(const std::string& name) {
    wire::AgentStatus status;
    status.envelope = envelope(name);
    status.agent_id = name;
    status.map_id = 1;
    (void)statuses_->put(status);
  }
  // What a page must show as text, and no more.
  void say_hostile() {
    say_status("<img src=x onerror=pwned=1>");
    say_status("bad\xff\xfe utf8");
    say_mayday("<script>pwned=1</script>\xc3\x28");
  }

  std::string id_, mission_;
  std::unique_ptr<dds::Participant> participant_;
  std::unique_ptr<wire::Outbox<wire::AgentStatus>> statuses_;
  std::unique_ptr<wire::Outbox<wire::Alert>> alerts_;
  std::unique_ptr<wire::Outbox<wire::Detection>> finds_;
  std::unique_ptr<wire::Inbox<wire::Alert>> heard_alerts_;
  std::unique_ptr<wire::Inbox<wire::Detection>> heard_finds_;
  std::uint64_t incarnation_ = random_incarnation().value;
  std::uint64_t sequence_ = 0;
  std::uint32_t last_id_ = 0;
};

}  // namespace
}  // namespace lifeline

int main(int argc, char** argv) {
  if (argc != 5) return 2;
  lifeline::Voice voice(argv[1], argv[3]);
  if (auto opened = voice.open(static_cast<std::uint32_t>(std::stoul(argv[2])), argv[4]); !opened) {
    std::fprintf(stderr, "%s\n", opened.error().text.c_str());
    return 1;
  }
  std::jthread listener([&](const std::stop_token& stop) {
    while (!stop.stop_requested()) voice.listen();
  });
  for (std::string line; std::getline(std::cin, line);) voice.follow(line);
  return 0;
}
