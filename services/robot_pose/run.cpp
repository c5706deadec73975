#include "services/robot_pose/hspo_source.hpp"
#include "services/robot_pose/robot_pose_app.hpp"

namespace arcstart::robot_pose {

int run(int argc, char** argv) {
  const ServiceDescription description{
      "robot_pose", "listens to the robot's controller and puts its positions on the bus",
      /*of_robot=*/true};
  return run_service(argc, argv, description, [](ServiceContext& context) {
    const auto settings = context.settings<RobotPoseSettings>("robot_pose");
    auto source = std::make_unique<HspoSource>(settings, [&bus = context.bus] { bus.wake(); });
    return std::make_unique<RobotPoseApp>(context.bus, settings, context.instance, context.run_id,
                                          std::move(source));
  });
}

}  // namespace arcstart::robot_pose
