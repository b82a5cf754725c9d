#pragma once

// All topics between machines of one process, over a network that loses, delays, doubles and cuts.
// Harsher than the middleware: nothing is repeated, late readers are told nothing. What the fleet
// holds alike over this network, it holds alike by its own protocol.

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/base/time.hpp"
#include "common/wire/channel.hpp"

namespace lifeline::test {

/// The same draws on every machine, which the distributions of <random> do not promise.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  /// In [0, bound).
  [[nodiscard]] std::uint64_t below(std::uint64_t bound) { return engine_() % bound; }
  [[nodiscard]] bool chance(double probability) {
    return static_cast<double>(engine_() >> 11) * 0x1.0p-53 < probability;
  }
  [[nodiscard]] Duration between(Duration least, Duration most) {
    return least + Duration(below(static_cast<std::uint64_t>((most - least).count()) + 1));
  }

 private:
  std::mt19937_64 engine_;
};

struct LinkConditions {
  double loss = 0.0;
  double doubled = 0.0;
  Duration least_delay = std::chrono::milliseconds(1);
  Duration most_delay = std::chrono::milliseconds(5);  ///< samples overtake one another
};

/// Machines are named by their ids. Everything happens in deliver(), in one thread.
class SimulatedNetwork {
 public:
  SimulatedNetwork(std::uint64_t seed, const Clock& clock) : dice_(seed), clock_(clock) {}

  void set_conditions(const LinkConditions& conditions) { conditions_ = conditions; }
  /// Only machines of one part hear one another; who stands in no part hears nobody.
  void part(std::vector<std::set<std::string>> parts) { parts_ = std::move(parts); }
  void heal() { parts_.clear(); }
  /// The machine is gone, and what was on its way to it.
  void remove(const std::string& machine) { inboxes_.erase(machine); }

  template <typename Message>
  [[nodiscard]] std::unique_ptr<wire::Outbox<Message>> writer(const std::string& machine) {
    return std::make_unique<Writer<Message>>(*this, machine);
  }
  template <typename Message>
  [[nodiscard]] std::unique_ptr<wire::Inbox<Message>> reader(const std::string& machine) {
    auto queue = std::make_shared<std::vector<Message>>();
    inboxes_[machine][kind<Message>()] = queue;
    return std::make_unique<Reader<Message>>(queue);
  }

  /// Hands over what is due by the clock.
  void deliver() {
    while (!under_way_.empty() && under_way_.begin()->first.first <= clock_.steady_now()) {
      const auto next = under_way_.extract(under_way_.begin());
      next.mapped()();
    }
  }

 private:
  template <typename Message>
  struct Writer final : wire::Outbox<Message> {
    Writer(SimulatedNetwork& of, std::string on) : network(of), machine(std::move(on)) {}
    [[nodiscard]] Result<void> put(const Message& message) override {
      network.send(machine, message);
      return {};
    }
    [[nodiscard]] bool has_reader() const override { return true; }
    SimulatedNetwork& network;
    std::string machine;
  };

  template <typename Message>
  struct Reader final : wire::Inbox<Message> {
    explicit Reader(std::shared_ptr<std::vector<Message>> of) : queue(std::move(of)) {}
    [[nodiscard]] std::vector<Message> take() override { return std::exchange(*queue, {}); }
    [[nodiscard]] std::uint64_t refused() const override { return 0; }
    std::shared_ptr<std::vector<Message>> queue;
  };

  /// One address for each kind of message.
  template <typename Message>
  static const void* kind() {
    static const char address = 0;
    return &address;
  }

  [[nodiscard]] bool connected(const std::string& a, const std::string& b) const {
    if (parts_.empty()) return true;
    return std::ranges::any_of(
        parts_, [&](const auto& part) { return part.contains(a) && part.contains(b); });
  }

  template <typename Message>
  void send(const std::string& from, const Message& message) {
    for (const auto& inbox : inboxes_) {
      const auto& [machine, queues] = inbox;
      const auto queue = queues.find(kind<Message>());
      if (machine == from || queue == queues.end()) continue;
      const int copies = dice_.chance(conditions_.doubled) ? 2 : 1;
      for (int copy = 0; copy < copies; ++copy) {
        const Duration delay = dice_.between(conditions_.least_delay, conditions_.most_delay);
        if (dice_.chance(conditions_.loss)) continue;
        const std::weak_ptr<void> to = queue->second;
        under_way_.emplace(
            std::pair(clock_.steady_now() + delay, ++sent_),
            [this, from, machine = inbox.first, to, message] {
              const auto alive = to.lock();
              if (alive == nullptr || !connected(from, machine)) return;
              std::static_pointer_cast<std::vector<Message>>(alive)->push_back(message);
            });
      }
    }
  }

  Dice dice_;
  const Clock& clock_;
  LinkConditions conditions_;
  std::vector<std::set<std::string>> parts_;
  std::map<std::string, std::map<const void*, std::shared_ptr<void>>> inboxes_;
  std::map<std::pair<SteadyTime, std::uint64_t>, std::function<void()>> under_way_;
  std::uint64_t sent_ = 0;
};

/// One machine's end of the network, in the manner of a LoopbackBus.
struct NetworkEnd {
  SimulatedNetwork& network;
  std::string machine;

  template <typename Message>
  [[nodiscard]] std::unique_ptr<wire::Outbox<Message>> writer() {
    return network.writer<Message>(machine);
  }
  template <typename Message>
  [[nodiscard]] std::unique_ptr<wire::Inbox<Message>> reader() {
    return network.reader<Message>(machine);
  }
};

}  // namespace lifeline::test
