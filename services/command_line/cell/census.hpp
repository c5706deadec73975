// Who is on the bus, and how the cell stands, as its states say it. Memory is bounded whatever is
// sent.
#pragma once

#include <arcstart/calibration_t.hpp>
#include <arcstart/scan_t.hpp>
#include <arcstart/service_status_t.hpp>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/service.hpp"
#include "services/command_line/cell/check_line.hpp"

namespace arcstart::command_line {

class Census {
 public:
  // Listens on the bus, which outlives it.
  Census(Bus& bus, const Instance& instance);

  // What was heard until now: clocks between hosts, calibration in force, versions, who is there.
  // own_version: this program's; cell: the cell's file, for commands.
  std::vector<CheckLine> lines(const std::string& own_version, const std::string& cell) const;

 private:
  // Of whom, and where: channel, host, process.
  using Speaker = std::tuple<std::string, std::string, int>;
  struct Speech {
    std::int64_t first = 0, last = 0;  // which of all STATUS heard, from 1
    service_status_t status;
  };
  static constexpr std::size_t kMostSpeakers = 500;

  void take_status(const Bus::Bytes& bytes, const std::string& channel);
  CheckLine clocks(const std::string& cell) const;
  CheckLine calibration() const;
  CheckLine versions(const std::string& own) const;
  void add_services(std::vector<CheckLine>& lines, const std::string& cell) const;

  Instance instance_;
  std::map<Speaker, Speech> speakers_;
  std::int64_t heard_ = 0;
  std::set<std::string> strange_;  // STATUS channels on which another version speaks
  std::optional<scan_t> scan_;
  std::map<std::string, calibration_t> calibrations_;  // by id
};

}  // namespace arcstart::command_line
