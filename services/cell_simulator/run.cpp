// arcstart-cell-simulator: a GigE Vision camera and a FANUC robot that are not there.
#include "services/cell_simulator/cell_simulator_app.hpp"

namespace arcstart::cell_simulator {

int run(int argc, char** argv) {
  const ServiceDescription description{"cell_simulator",
                                       "stands for the cell: a GigE Vision camera, a FANUC M-20iA "
                                       "that sends HSPO, and what they see"};
  return run_service(argc, argv, description, [](ServiceContext& context) -> std::unique_ptr<App> {
    const auto settings = context.settings<CellSimulatorSettings>("cell_simulator");
    return std::make_unique<CellSimulatorApp>(context.bus, settings, context.instance,
                                              context.run_id);
  });
}

}  // namespace arcstart::cell_simulator
