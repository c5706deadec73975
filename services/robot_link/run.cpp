#include "services/robot_link/rmi/rmi_link.hpp"
#include "services/robot_link/robot_link_app.hpp"

namespace arcstart::robot_link {
namespace {

constexpr int kRmiPort = 16001;

std::unique_ptr<ControllerLink> make_link(const RobotLinkSettings& settings) {
  RmiLinkSettings rmi;
  rmi.address = settings.controller_address;
  rmi.port = settings.controller_port ? settings.controller_port : kRmiPort;
  rmi.first_number = settings.first_number;
  rmi.first_position = settings.first_position;
  rmi.user_frame = settings.user_frame;
  rmi.tool = settings.tool;
  rmi.frame_in_base = settings.frame_in_base;
  rmi.tool_in_flange = settings.tool_in_flange;
  return std::make_unique<RmiLink>(rmi);
}

}  // namespace

int run(int argc, char** argv) {
  const ServiceDescription description{
      "robot_link", "gives the robot's own program what it asks for: a scan's answer",
      /*of_robot=*/true};
  return run_service(argc, argv, description, [](ServiceContext& context) {
    const auto settings = context.settings<RobotLinkSettings>("robot_link");
    if (settings.controller_address.empty())
      throw InputError("robot_link.controller_address: the address of the controller is missing");
    return std::make_unique<RobotLinkApp>(context.bus, settings, context.instance, context.run_id,
                                          make_link(settings));
  });
}

}  // namespace arcstart::robot_link
