// The simulated cell on the bus: it hears of scans and commands and tells the truth.
#pragma once

#include <cstdint>
#include <deque>
#include <set>
#include <string>

#include "common/service.hpp"
#include "services/cell_simulator/simulated_cell.hpp"

namespace arcstart::cell_simulator {

class CellSimulatorApp : public App {
 public:
  // Writes the true calibration where the settings ask for it. Throws what SimulatedCell and
  // write_calibration throw.
  CellSimulatorApp(Bus& bus, const CellSimulatorSettings& settings, const Instance& instance,
                   std::int64_t now);

  void tick(std::int64_t now) override;
  Health health() const override;

 private:
  void on_scan(const scan_t& scan);
  void on_command(const cell_command_t& command);
  void end_scan(std::int64_t now, const char* why);
  void carry_out(const cell_command_t& command, std::int64_t now);
  truth_t truth(std::int64_t now) const;
  void tell_truth(std::int64_t now);

  Bus& bus_;  // outlives this
  SimulatedCell cell_;

  std::int64_t scan_run_id_ = 0, scan_id_ = 0;  // of the last scan
  bool scanning_ = false;
  std::int64_t scan_heard_ = 0;  // when LASER0_SCAN came last

  std::set<std::int64_t> known_commands_;
  std::deque<cell_command_t> waiting_;  // for the end of a scan
  std::int64_t command_id_ = 0;         // carried out last
  std::string refusal_;

  truth_t told_{};
};

// The whole main of arcstart-cell-simulator.
int run(int argc, char** argv);

}  // namespace arcstart::cell_simulator
