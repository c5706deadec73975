// arcstart-reconstruction: stripes and robot positions to points in the robot's base frame.
#include "services/reconstruction/reconstruction_app.hpp"

namespace arcstart::reconstruction {

int run(int argc, char** argv) {
  return run_service(
      argc, argv, {"reconstruction", "carries laser stripes to points in the robot's base frame"},
      [](ServiceContext& context) -> std::unique_ptr<App> {
        const auto settings = context.settings<ReconstructionSettings>("reconstruction");
        return std::make_unique<ReconstructionApp>(context.bus, settings, context.instance);
      });
}

}  // namespace arcstart::reconstruction
