// Any text as what a Foxglove client asks for, and as the list of protocols that it offers.

#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "coordinator/foxglove/protocol.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto request = lifeline::foxglove::read_request(text);
  // A subscription takes more than one octet to ask for.
  if (request && request->subscribe.size() + request->unsubscribe.size() > size) std::abort();
  if (!request && request.error().text.find('\n') != std::string::npos) std::abort();
  const auto chosen = lifeline::foxglove::choose_subprotocol(text);
  if (!chosen.empty() && text.find(chosen) == std::string_view::npos) std::abort();
  return 0;
}
