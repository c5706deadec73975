#include "services/robot_pose/hspo/hspo_source.hpp"
#include "services/robot_pose/j519/j519_source.hpp"
#include "services/robot_pose/robot_pose_app.hpp"
#include "services/robot_pose/rtde/rtde_source.hpp"

namespace arcstart::robot_pose {
namespace {

std::unique_ptr<PoseSource> make_source(const RobotPoseSettings& settings,
                                        std::function<void()> notify) {
  if (settings.protocol == "j519") return std::make_unique<J519Source>(settings, notify);
  if (settings.protocol == "rtde") return std::make_unique<RtdeSource>(settings, notify);
  return std::make_unique<HspoSource>(settings, notify);
}

}  // namespace

int run(int argc, char** argv) {
  const ServiceDescription description{
      "robot_pose", "listens to the robot's controller and puts its positions on the bus",
      /*of_robot=*/true};
  return run_service(argc, argv, description, [](ServiceContext& context) {
    const auto settings = context.settings<RobotPoseSettings>("robot_pose");
    auto source = make_source(settings, [&bus = context.bus] { bus.wake(); });
    return std::make_unique<RobotPoseApp>(context.bus, settings, context.instance, context.run_id,
                                          std::move(source));
  });
}

}  // namespace arcstart::robot_pose
