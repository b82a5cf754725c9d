#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "common/base/result.hpp"

namespace lifeline::bench {

/// Hosts that share a radio, on this machine alone: each a network namespace with one interface
/// (`w0`, 10.77.0.1 and on), their cables on a bridge that lives in a namespace of its own. Loss
/// falls on what arrives at a host, a rate holds for what it sends. Taken down when this object
/// goes.
class RadioNet {
 public:
  /// unavailable, with the reason, where namespaces may not be made or `ip`, `tc` or `nft` is
  /// missing.
  [[nodiscard]] static Result<RadioNet> make(int hosts);

  RadioNet(RadioNet&& other) noexcept;
  RadioNet& operator=(RadioNet&&) = delete;
  ~RadioNet();

  /// Of all packets that arrive at a host, in each host.
  [[nodiscard]] Result<void> set_loss(double share);
  /// What one host may send, 0 = no limit.
  [[nodiscard]] Result<void> set_rate(int host, std::uint32_t kbit_s);
  /// From here on `to` hears nothing of what `from` sends; the other way stays as it is. Undone by
  /// restore().
  [[nodiscard]] Result<void> cut(int from, int to);
  [[nodiscard]] Result<void> restore(int to);
  /// Moves these hosts onto a bridge of their own; heal() brings everybody together again.
  [[nodiscard]] Result<void> part(const std::set<int>& hosts);
  [[nodiscard]] Result<void> heal();

  /// What the host's interface has sent so far.
  [[nodiscard]] std::uint64_t octets_sent(int host) const;

  /// Puts before a program's arguments what starts it on a host.
  [[nodiscard]] std::vector<std::string> on(int host, std::vector<std::string> arguments) const;
  /// The namespace of the bridges: what comes in there has left a host and is not yet lost.
  [[nodiscard]] std::string air() const { return name_ + "air"; }
  [[nodiscard]] int hosts() const { return hosts_; }

 private:
  RadioNet(int hosts, std::string name) : hosts_(hosts), name_(std::move(name)) {}
  [[nodiscard]] std::string host_name(int host) const;
  [[nodiscard]] Result<void> set_up();

  int hosts_;
  std::string name_;  ///< begins every namespace's name; empty once moved from
};

}  // namespace lifeline::bench
