// arcstart-calibration: the cell's calibration, published for all.
#include "services/calibration/calibration_app.hpp"

namespace arcstart::calibration {

int run(int argc, char** argv) {
  return run_service(
      argc, argv, {"calibration", "publishes the cell's calibration, and makes one from a plate"},
      [](ServiceContext& context) -> std::unique_ptr<App> {
        const auto settings = context.settings<CalibrationSettings>("calibration");
        return std::make_unique<CalibrationApp>(context.bus, settings, context.instance,
                                                context.run_id);
      });
}

}  // namespace arcstart::calibration
