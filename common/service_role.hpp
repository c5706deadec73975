// One process alone does the work of a service for a sensor or robot: what keeps a second one from
// it, and what notices one.
#pragma once

#include <cstdint>
#include <string>

#include "common/bus/bus.hpp"

namespace arcstart {

std::string host_name();

// On this host: held as long as the process lives, whatever ends it. channel: the role's STATUS;
// whose: the sensor or robot it is for. Throws InputError where another process holds it.
void claim_role(const std::string& service, const std::string& whose, const std::string& channel,
                const BusSettings& bus);

// On any host: another process that does this one's work is heard on this one's own STATUS channel.
class TwinWatch {
 public:
  // service: its name; run_id: of this process. The bus outlives it.
  TwinWatch(Bus& bus, const std::string& channel, const std::string& service, std::int64_t run_id);
  // Which one, where, and what to do; empty where there is none.
  std::string trouble() const;

 private:
  std::string service_, host_ = host_name(), where_;
  std::int64_t heard_ = 0;  // steady; us
};

}  // namespace arcstart
