// arcstart-reconstruction: stripes and robot positions to points in the robot's base frame.
#include "services/reconstruction/reconstruction_app.hpp"

int main(int argc, char** argv) {
  using namespace arcstart;
  using namespace arcstart::reconstruction;
  return run_service(
      argc, argv, {"reconstruction", "carries laser stripes to points in the robot's base frame"},
      [](ServiceContext& context) -> std::unique_ptr<App> {
        const auto settings = context.settings<ReconstructionSettings>("reconstruction");
        return std::make_unique<ReconstructionApp>(context.bus, settings, context.instance);
      });
}
